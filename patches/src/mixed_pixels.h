#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "fit_element.h"
#include "quadrille/patch_mesh.h"
#include "quadrille/raster.h"

namespace quadrille {

/// The least-squares equations of the pixels that a tear crosses, or the border of the mesh inside
/// the picture. The renderer mixes them from the patches that they show (see render()), so each is
/// one equation over the unknowns of several patches: sum over its patches of covered share *
/// colour at the share's centroid = the pixel's colour. Where the mesh covers only a part of the
/// pixel, that part has the pixel's colour.
///
/// The equations are kept as sparse rows over the wedges. A product with their normal matrix takes
/// two steps, evaluate() over all pixels and gather() for every wedge; both add up in a fixed
/// order.
class MixedPixels {
 public:
  using Vector = std::vector<WedgeUnknowns>;

  /// Finds the pixels. None when the mesh has no tears and fills the picture.
  MixedPixels(const PatchMesh& patches, const Raster& picture);

  bool empty() const { return values_.empty(); }
  /// True for the pixels that have an equation here, which leave none to point samples.
  bool contains(std::size_t pixel) const { return !is_mixed_.empty() && is_mixed_[pixel]; }

  /// Puts the difference of the picture from the patches' present colours in front of gather().
  void evaluate_residual();
  /// Calls visit(pixel, rest) with what `correction` leaves of the differences of the picture from
  /// the patches' present colours.
  template <class Visit>
  void for_each_rest(const Vector& correction, const Visit& visit) const {
    for (std::size_t r = 0; r < residual_.size(); ++r) {
      visit(pixels_[r], Color(residual_[r] - product(r, correction)));
    }
  }
  /// Puts the rows times x in front of gather().
  void evaluate(const Vector& x);
  /// Adds the wedge's part of the transposed rows times what was evaluated.
  void gather(int wedge, WedgeUnknowns& sum) const;
  /// How many pixels' worth of the patch's colour its mixtures leave open: the sum of w (1 - w)
  /// over its shares w.
  double open_area(int patch) const { return open_area_.empty() ? 0 : open_area_[patch]; }
  /// The wedge's own block of the normal matrix.
  Eigen::Matrix4d block(int wedge) const;

 private:
  /// How one wedge enters one pixel: factors of value, dx, dy, twist.
  struct Entry {
    int wedge;
    Eigen::Vector4f factors;
  };
  struct BlockRows;

  std::vector<std::size_t> pixels_;                 // #rows; y * width + x
  std::vector<char> is_mixed_;                      // #pixels of the picture; empty for none
  std::vector<double> open_area_;                   // #Q; empty for none
  std::vector<int> row_begin_;                      // #rows + 1
  std::vector<Entry> entries_;                      // by row, then by wedge
  std::vector<int> wedge_begin_;                    // #W + 1
  std::vector<std::array<int, 2>> wedge_entries_;   // row and entry, by wedge, then by row
  std::vector<Eigen::Vector4f> residual_, values_;  // #rows

  Eigen::Vector4f product(std::size_t row, const Vector& x) const {
    Eigen::Vector4f sum = Eigen::Vector4f::Zero();
    for (int i = row_begin_[row]; i < row_begin_[row + 1]; ++i) {
      sum += x[entries_[i].wedge] * entries_[i].factors;
    }
    return sum;
  }
  void sort_by_wedge(std::size_t wedge_count);
};

}  // namespace quadrille

#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <span>
#include <vector>

#include "quadrille/patch_mesh.h"

namespace quadrille {

/// A patch made ready for drawing at any scale. Its geometry is an affine map after
/// Q(s, t) = (s, t) + higher terms, with s = u - 1/2 and t = v - 1/2: "normalized" coordinates are
/// those of Q, so a straight parallelogram is the identity. With Adini's twists the patch is the
/// Coons patch of its sides, and no term has both powers above 1.
struct PatchProgram {
  /// Normalized coordinates of the mesh point p are to_normalized (p - center).
  Eigen::Vector2d center;
  Eigen::Matrix2d to_normalized;
  /// Per coordinate the weights of ss, sss, st, sst, ssst, tt, stt, ttt, sttt.
  float position[2][9];
  /// Estimated parameters (s, t) of a normalized point: 1, x, y, xx, xy, yy, by least squares.
  float start[2][6];
  /// 4 j + i weighs s^i t^j; red, green, blue premultiplied, alpha.
  float color[4][16];
  /// Newton's step of length n from a point whose Jacobian's inverse is of norm b arrives when
  /// b n <= 1 / newton_bound and b n^2 <= 1 / color_bound: by Kantorovich's theorem the root is
  /// then so near that no colour differs by more than 1/250 of an 8-bit step.
  float newton_bound, color_bound;
  /// Upper bound of the gradients of the channels for |s|, |t| <= 0.55.
  float steepest;
  /// False where the patch is degenerate or folded in its middle; Newton's method is not tried
  /// then.
  bool regular;
};

/// Sets up the patches `wanted`, one program for each in the same order. The same bits for every
/// instruction set and whatever patches are set up together.
void make_programs(const PatchMesh& patches, std::span<const int> wanted, PatchProgram* programs);

/// The programs of those patches of a mesh that were asked for so far.
class PatchPrograms {
 public:
  /// Makes those that are missing. `for_each(count, body)` calls body(0) ... body(count - 1).
  template <class ForEach>
  void add(const PatchMesh& patches, std::span<const int> wanted, const ForEach& for_each) {
    index_.resize(patches.patch_count(), -1);
    missing_.clear();
    for (const int q : wanted) {
      if (index_[q] >= 0) continue;
      index_[q] = static_cast<int>(programs_.size() + missing_.size());
      missing_.push_back(q);
    }
    if (missing_.empty()) return;
    const std::size_t before = programs_.size();
    programs_.resize(before + missing_.size());
    constexpr std::size_t kRange = 256;
    for_each((missing_.size() + kRange - 1) / kRange, [&](std::size_t r) {
      const std::size_t begin = r * kRange, end = std::min(begin + kRange, missing_.size());
      make_programs(patches, std::span(missing_).subspan(begin, end - begin),
                    programs_.data() + before + begin);
    });
  }

  const PatchProgram& of(int patch) const { return programs_[index_[patch]]; }

 private:
  std::vector<int> index_;  // #Q; -1 where not made
  std::vector<int> missing_;
  std::vector<PatchProgram> programs_;
};

}  // namespace quadrille

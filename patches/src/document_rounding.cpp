#include "document_rounding.h"

#include <cmath>

namespace quadrille {
namespace {

using Eigen::Array4d;
using Eigen::Matrix4d;
constexpr int kSweeps = 3;
constexpr double kLargest = 1 << 25;  // that document_colors.cpp codes

class Rounding {
 public:
  Rounding(const PatchMesh& patches, const PictureMetric& metric,
           const std::vector<LocalColors>& exact, const ColorSteps& steps)
      : patches_(patches),
        metric_(metric),
        exact_(exact),
        step_(exact.size()),
        errors_(exact.size()),
        patch_errors_(patches.patch_count()) {
    for (LocalColors& e : errors_) e.fill(Array4d::Zero());
    for (int w = 0; w < static_cast<int>(exact.size()); ++w) {
      for (int kind = 0; kind < 4; ++kind) {
        for (int c = 0; c < kChannels; ++c) {
          step_[w][kind][c] = steps(w, c, static_cast<WedgeKind>(kind));
        }
      }
    }
    for (auto& e : patch_errors_) e.fill(Array4d::Zero());
  }

  std::vector<WedgeCode> codes() {
    std::vector<WedgeCode> codes(exact_.size());
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (int w = 0; w < static_cast<int>(codes.size()); ++w) round(w, sweep == 0, codes[w]);
    }
    return codes;
  }

 private:
  const PatchMesh& patches_;
  const PictureMetric& metric_;
  const std::vector<LocalColors>& exact_;
  std::vector<LocalColors> step_;
  std::vector<LocalColors> errors_;
  std::vector<PatchColors> patch_errors_;

  /// Half the derivative of the squared error of the picture with respect to the wedge's kinds.
  LocalColors slope(int w) const {
    LocalColors slope;
    slope.fill(Array4d::Zero());
    for (const int h : metric_.corners()[w]) {
      metric_.add_product(h, patch_errors_[QuadMesh::quad_of(h)], slope);
    }
    return slope;
  }

  /// Works on all channels at once.
  void round(int w, bool first, WedgeCode& code) {
    const Matrix4d& root = metric_.root(w);
    const LocalColors slopes = slope(w);
    const LocalColors wish = metric_.solve_block(w, slopes);  // with the other sign
    LocalColors number, change;
    for (int i = 3; i >= 0; --i) {
      Array4d to = -wish[i];
      for (int j = i + 1; j < 4; ++j) to -= root(i, j) / root(i, i) * (wish[j] + change[j]);
      const Array4d at = exact_[w][i] + errors_[w][i];
      number[i] = ((at + to) / step_[w][i] + 0.5).floor().max(-kLargest).min(kLargest);
      change[i] = number[i] * step_[w][i] - at;
    }
    Array4d gain = Array4d::Zero();
    for (int i = 0; i < 4; ++i) {
      Array4d bent = Array4d::Zero();
      for (int j = 0; j < 4; ++j) bent += metric_.block(w)(i, j) * change[j];
      gain += (2 * slopes[i] + bent) * change[i];
    }
    for (int c = 0; c < kChannels; ++c) {
      if (!first && !(gain[c] < 0)) continue;
      for (int i = 0; i < 4; ++i) set(w, c, i, static_cast<int>(number[i][c]), code);
    }
    for (const int h : metric_.corners()[w]) {
      metric_.put(h, errors_[w], patch_errors_[QuadMesh::quad_of(h)]);
    }
  }

  void set(int w, int c, int kind, int number, WedgeCode& code) {
    code[c][kind] = number;
    errors_[w][kind][c] = number * step_[w][kind][c] - exact_[w][kind][c];
  }
};

}  // namespace

std::vector<WedgeCode> round_colors(const PatchMesh& patches, const PictureMetric& metric,
                                    const std::vector<LocalColors>& exact,
                                    const ColorSteps& steps) {
  return Rounding(patches, metric, exact, steps).codes();
}

}  // namespace quadrille

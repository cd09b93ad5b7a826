#include "document_quantizer.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "document_refit.h"
#include "document_rounding.h"
#include "document_shapes.h"

namespace quadrille {
namespace {

constexpr int kCoarsestExponent = 1, kUsualExponent = 3, kFinestExponent = 7;
/// Colour steps are 2^(n / 16) / 255.
constexpr int kPerOctave = 16, kCoarsestColor = 16, kUsualColor = 2, kFinestColor = -48;
/// What rounded vertices may cost, as a share of the wished error, before colours are fitted to
/// them; afterwards less than half is left. The two kinds of error add like squares, and vertices
/// are 2 of 14 numbers.
constexpr double kPositionShare = 1;

float color_step(int n) {
  constexpr double kPowers[kPerOctave] = {1.0,
                                          1.0442737824274138,
                                          1.0905077326652577,
                                          1.1387886347566916,
                                          1.189207115002721,
                                          1.241857812073484,
                                          1.2968395546510096,
                                          1.3542555469368927,
                                          1.4142135623730951,
                                          1.4768261459394993,
                                          1.5422108254079407,
                                          1.6104903319492543,
                                          1.681792830507429,
                                          1.7562521603732995,
                                          1.8340080864093424,
                                          1.9152065613971474};
  const int part = n & (kPerOctave - 1);
  return static_cast<float>(std::ldexp(kPowers[part], (n - part) / kPerOctave) / 255);
}

std::vector<int> exponents_of(const StepChoice& choice) {
  if (choice.position_exponent) return {*choice.position_exponent};
  std::vector<int> exponents;
  for (int e = kCoarsestExponent; e <= kFinestExponent; ++e) exponents.push_back(e);
  return exponents;
}

std::vector<float> colors_of(const StepChoice& choice) {
  if (choice.color) return {*choice.color};
  std::vector<float> steps;
  for (int n = kCoarsestColor; n >= kFinestColor; --n) steps.push_back(color_step(n));
  return steps;
}

/// A corner of each wedge.
std::vector<int> first_corners(const PatchMesh& patches) {
  std::vector<int> corner(patches.wedges.size(), 0);
  for (std::size_t h = patches.wedge_of_corner.size(); h-- > 0;) {
    corner[patches.wedge_of_corner[h]] = static_cast<int>(h);
  }
  return corner;
}

/// Patches with vertices and tangents on a grid, and no colours.
struct Placed {
  PositionGrid grid;
  QuantizedPatches patches;
  int folded = 0;  ///< patches that were certified free of folds and are no more
};

Placed on_grid(const PatchMesh& patches, const PositionGrid& grid) {
  Placed placed{grid, {}};
  QuantizedPatches& out = placed.patches;
  out.mesh = patches.mesh;
  out.opaque = patches.opaque;
  out.points.resize(patches.mesh.vertices.size());
  for (std::size_t v = 0; v < out.points.size(); ++v) {
    for (int axis = 0; axis < 2; ++axis) {
      out.points[v][axis] = grid.nearest(axis, patches.mesh.vertices[v][axis]);
    }
    out.mesh.vertices[v] = grid.at(out.points[v]);
  }
  out.wedge_of_corner = patches.wedge_of_corner;
  out.wedges.resize(patches.wedges.size());
  placed.folded = quantize_tangents(patches, grid.step(), out);
  return placed;
}

std::vector<LocalColors> colors_in(const PatchMesh& patches, const PatchMesh& moved,
                                   const std::vector<ColorFrame>& frames) {
  const std::vector<int> corners = first_corners(patches);
  std::vector<LocalColors> colors;
  colors.reserve(patches.wedges.size());
  for (std::size_t w = 0; w < patches.wedges.size(); ++w) {
    const int v = moved.mesh.origin(corners[w]);
    colors.push_back(local_colors(patches.wedges[w], frames[v],
                                  moved.mesh.vertices[v] - patches.mesh.vertices[v]));
    if (patches.opaque) {
      for (Eigen::Array4d& kind : colors.back()) kind[kAlpha] = 0;
    }
  }
  return colors;
}

/// Calls visit(wedge, channel, kind, number in steps) until it returns false; then this does, too.
template <class Visit>
bool for_each_number(const std::vector<LocalColors>& colors, const ColorSteps& steps,
                     const Visit& visit) {
  for (int w = 0; w < static_cast<int>(colors.size()); ++w) {
    for (int kind = 0; kind < 4; ++kind) {
      for (int c = 0; c < kChannels; ++c) {
        const double number = colors[w][kind][c] / steps(w, c, static_cast<WedgeKind>(kind));
        if (!visit(w, c, kind, number)) return false;
      }
    }
  }
  return true;
}

double nearest(double number) { return std::floor(number + 0.5); }

/// The integers that the colours are, if they are so but for `tolerance`.
std::optional<std::vector<WedgeCode>> exact_codes(const std::vector<LocalColors>& colors,
                                                  const ColorSteps& steps, double tolerance) {
  const bool exact = for_each_number(colors, steps, [&](int, int, int, double number) {
    return std::abs(number - nearest(number)) <= tolerance;
  });
  if (!exact) return std::nullopt;
  std::vector<WedgeCode> codes(colors.size());
  for_each_number(colors, steps, [&](int w, int c, int kind, double number) {
    codes[w][c][kind] = static_cast<int>(nearest(number));
    return true;
  });
  return codes;
}

/// Share of a step by which colours may miss multiples of it: what one number misses changes the
/// picture by less than kMostChange steps, so the picture keeps to the wished error.
double tolerance_of(const StepChoice& choice, double step) {
  constexpr double kTolerance = 1 / 32.0, kMostChange = 8;
  return choice.color ? kTolerance : std::min(kTolerance, choice.error / (kMostChange * step));
}

/// Patches that a document held: the coarsest of the steps that they are multiples of.
std::optional<SteppedPatches> as_stored(const PatchMesh& patches, double width, double height,
                                        const StepChoice& choice) {
  for (const int exponent : exponents_of(choice)) {
    const PositionGrid grid(exponent, width, height);
    const auto is_point = [&](const Eigen::Vector2d& v) {
      return grid.at({grid.nearest(0, v.x()), grid.nearest(1, v.y())}) == v;
    };
    const auto& vertices = patches.mesh.vertices;
    if (!std::all_of(vertices.begin(), vertices.end(), is_point)) continue;
    const std::vector<ColorFrame> frames = color_frames(patches.mesh, grid.step());
    const std::vector<LocalColors> colors = colors_in(patches, patches, frames);
    ColorSteps steps(patches.mesh, patches.wedge_of_corner, patches.wedges.size(), 1);
    for (const float step : colors_of(choice)) {
      steps.set_step(step);
      auto codes = exact_codes(colors, steps, tolerance_of(choice, step));
      if (!codes) continue;
      SteppedPatches stored{on_grid(patches, grid).patches, {exponent, step}};
      if (!are_same_tangents(stored.patches.tangents, patches.edge_tangents, grid.step())) break;
      stored.patches.wedges = *std::move(codes);
      return stored;
    }
  }
  return std::nullopt;
}

/// Patches with their vertices rounded.
class Rounded {
 public:
  Rounded(const PatchMesh& before, Placed placed)
      : folded_(placed.folded),
        patches_(std::move(placed.patches)),
        moved_(geometry_of(patches_)),
        frames_(color_frames(moved_.mesh, placed.grid.step())),
        metric_(moved_, frames_),
        picture_(before, moved_, metric_),
        colors_(colors_in(before, moved_, frames_)) {}

  int folded() const { return folded_; }
  double error() const { return picture_.error(colors_); }
  void fit_colors() { colors_ = picture_.fit(std::move(colors_)); }

  /// Rounds the colours as well. Returns the error of the picture.
  double round_colors(float step) {
    const ColorSteps steps(moved_.mesh, moved_.wedge_of_corner, moved_.wedges.size(), step);
    patches_.wedges = quadrille::round_colors(moved_, metric_, colors_, steps);
    std::vector<LocalColors> colors = colors_;
    for (int w = 0; w < static_cast<int>(colors.size()); ++w) {
      for (int kind = 0; kind < 4; ++kind) {
        for (int c = 0; c < kChannels; ++c) {
          colors[w][kind][c] =
              patches_.wedges[w][c][kind] * steps(w, c, static_cast<WedgeKind>(kind));
        }
      }
    }
    return picture_.error(colors);
  }
  QuantizedPatches take() { return std::move(patches_); }

 private:
  int folded_;
  QuantizedPatches patches_;
  PatchMesh moved_;
  std::vector<ColorFrame> frames_;
  PictureMetric metric_;
  MovedPicture picture_;
  std::vector<LocalColors> colors_;
};

/// How many exponents finer the vertices must be; the error is proportional to their steps.
int finer_exponents(double error, double wished) {
  return error > 0 ? static_cast<int>(std::ceil(std::log2(error / wished))) : -kUsualExponent;
}

/// The coarsest exponent from `exponent` on that folds the fewest patches.
Placed place_without_folds(const PatchMesh& patches, double width, double height, int& exponent) {
  Placed best = on_grid(patches, PositionGrid(exponent, width, height));
  for (int finer = exponent + 1; finer <= kFinestExponent && best.folded > 0; ++finer) {
    Placed placed = on_grid(patches, PositionGrid(finer, width, height));
    if (placed.folded >= best.folded) continue;
    best = std::move(placed);
    exponent = finer;
  }
  return best;
}

std::unique_ptr<Rounded> round_positions(const PatchMesh& patches, double width, double height,
                                         const StepChoice& choice, int& exponent) {
  exponent = choice.position_exponent.value_or(kUsualExponent);
  auto result =
      std::make_unique<Rounded>(patches, on_grid(patches, PositionGrid(exponent, width, height)));
  if (choice.position_exponent) return result;
  const int best =
      std::clamp(exponent + finer_exponents(result->error(), kPositionShare * choice.error),
                 kCoarsestExponent, kFinestExponent);
  if (best == exponent && result->folded() == 0) return result;
  exponent = best;
  result.reset();
  return std::make_unique<Rounded>(patches, place_without_folds(patches, width, height, exponent));
}

double squared(double x) { return x * x; }

/// Rounds to the coarsest steps of colours that keep to the error. Returns them.
float round_colors(Rounded& patches, double wished) {
  const double from_positions = squared(patches.error()), may = squared(wished) - from_positions;
  int n = kUsualColor, coarsest = kCoarsestColor;
  for (;;) {
    const double error = patches.round_colors(color_step(n));
    const bool good = error <= wished;
    if (n == (good ? coarsest : kFinestColor)) break;
    if (!good) coarsest = n - 1;
    // Errors are proportional to the steps.
    const double from_colors = squared(error) - from_positions;
    double octaves = good ? 1 : -1;
    if (from_colors > 0 && may > 0) octaves = std::log2(may / from_colors) / 2;
    const int next =
        std::clamp(n + static_cast<int>(std::floor(kPerOctave * octaves)), kFinestColor, coarsest);
    if (good && next <= n) break;
    n = next;
  }
  return color_step(n);
}

SteppedPatches rounded(const PatchMesh& patches, double width, double height,
                       const StepChoice& choice) {
  QuantizationSteps steps;
  const auto result = round_positions(patches, width, height, choice, steps.position_exponent);
  result->fit_colors();
  if (choice.color) {
    steps.color = *choice.color;
    result->round_colors(steps.color);
  } else {
    steps.color = round_colors(*result, choice.error);
  }
  return {result->take(), steps};
}

}  // namespace

QuantizationSteps StepChoice::finest() const {
  return {position_exponent.value_or(kFinestExponent), color.value_or(color_step(kFinestColor))};
}

SteppedPatches quantize(const PatchMesh& patches, double width, double height,
                        const StepChoice& choice) {
  if (auto stored = as_stored(patches, width, height, choice)) return *std::move(stored);
  SteppedPatches result = rounded(patches, width, height, choice);
  // All integers may be even; a document says so in the way in which it will be saved again.
  for (;;) {
    const PositionGrid grid(result.steps.position_exponent, width, height);
    auto again =
        as_stored(dequantize(result.patches, grid, result.steps.color), width, height, choice);
    if (!again || again->steps == result.steps) return result;
    result = *std::move(again);
  }
}

}  // namespace quadrille

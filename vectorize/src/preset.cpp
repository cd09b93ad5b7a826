#include "quadrille/preset.h"

#include <algorithm>
#include <cmath>

#include "quadrille/error.h"

namespace quadrille {
namespace {

constexpr int kIconSide = 512;
constexpr double kIconTransparency = 0.05;
constexpr double kGraphicFlatness = 0.4;
constexpr int kGraphicColors = 128;
constexpr double kGraphicSharpness = 0.8, kGraphicChainShare = 0.6;
// Edges are drawn sharper where the colours beside them bend less.
constexpr double kGraphicSmoothness = 0.25;
constexpr double kGraphicOvershoot = 0.005;
constexpr double kLeastPixelsPerQuad = 2.5;

double rounded_to_two_digits(double value) {
  const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(value)) - 1));
  return std::round(value / unit) * unit;
}

}  // namespace

const std::vector<Preset>& presets() {
  // photo gives 481 x 321 pixels 3,000 quads; graphic gives a drawing of 640 x 360 7,900 and icon
  // one of 256 x 256 3,000, which is what such pictures take to look like themselves.
  static const std::vector<Preset> all = {
      {"draft", "a quick look", 200, 100, 10'000},
      {"photo", "photographs and soft shading", 51.5, 500, 50'000},
      {"fine", "more detail, larger files", 20, 1'000, 200'000},
      {"graphic", "drawings with flat colours", 29, 3'000, 30'000, true},
      {"icon", "small pictures with transparency", 22, 1'500, 8'000, true},
  };
  return all;
}

const Preset& preset_named(std::string_view name) {
  const auto found = std::ranges::find(presets(), name, &Preset::name);
  if (found != presets().end()) return *found;
  std::string names;
  for (const Preset& preset : presets()) names += (names.empty() ? "" : ", ") + preset.name;
  throw Error(ErrorCode::invalid_argument,
              "there is no preset '" + std::string(name) + "'; use one of " + names);
}

const Preset& choose_preset(const Content& content) {
  if (std::max(content.width, content.height) <= kIconSide &&
      content.transparent_share >= kIconTransparency) {
    return preset_named("icon");
  }
  const bool flat = content.flat_share >= kGraphicFlatness && content.main_colors <= kGraphicColors;
  return preset_named(flat ? "graphic" : "photo");
}

const Preset& choose_preset(const Raster& picture) {
  return choose_preset(classify_content(picture));
}

int preset_quads(const Preset& preset, int width, int height) {
  const double pixels = static_cast<double>(width) * height;
  const double wished =
      std::clamp<double>(pixels / preset.pixels_per_quad, preset.min_quads, preset.max_quads);
  const double possible = std::max(1.0, pixels / kLeastPixelsPerQuad);
  return static_cast<int>(rounded_to_two_digits(std::min(wished, possible)));
}

void apply(const Preset& preset, const Raster& picture, VectorizeOptions& options) {
  options.quads = preset_quads(preset, picture.width, picture.height);
  if (!preset.strong_tears) return;
  options.tears.mode = TearOptions::Mode::strong;
  options.chains.sharpness = kGraphicSharpness;
  options.chain_share = kGraphicChainShare;
  options.least_chain_gain = 0;
  options.fit.smoothness = kGraphicSmoothness;
  options.fit.max_overshoot = kGraphicOvershoot;
}

}  // namespace quadrille

#include "color_profile.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace quadrille {
namespace {

/// By the embedded profile or, for CMYK without a usable one, by that of libvips.
VipsImagePtr by_profile(VipsImage* colors) {
  return vips_result([&](VipsImage** out) {
    return vips_icc_transform(colors, out, "srgb", "embedded", TRUE, "intent", VIPS_INTENT_RELATIVE,
                              "black_point_compensation", TRUE, "depth", 16, nullptr);
  });
}

/// Every combination of kLevels levels per band, as one row of 8-bit pixels.
std::vector<std::uint8_t> color_lattice(int bands) {
  constexpr int kLevels = 16;
  int count = 1;
  for (int b = 0; b < bands; ++b) count *= kLevels;
  std::vector<std::uint8_t> lattice;
  for (int i = 0; i < count; ++i) {
    for (int b = 0, rest = i; b < bands; ++b, rest /= kLevels) {
      lattice.push_back(static_cast<std::uint8_t>(rest % kLevels * 255 / (kLevels - 1)));
    }
  }
  return lattice;
}

/// Many files carry one of the dozens of profiles that describe sRGB with small deviations.
/// Whether one does is decided by what it makes of a lattice of colours, not by its name.
bool embeds_srgb_itself(VipsImage* colors) {
  constexpr int kTolerance = 2 * 257;  // two 8-bit steps
  const int bands = vips_image_get_bands(colors);
  if (bands != 1 && bands != 3) return false;
  std::vector<std::uint8_t> lattice = color_lattice(bands);
  const int count = static_cast<int>(lattice.size()) / bands;
  const VipsImagePtr raw(vips_image_new_from_memory(lattice.data(), lattice.size(), count, 1, bands,
                                                    VIPS_FORMAT_UCHAR));
  if (!raw) return false;
  const VipsImagePtr tagged = vips_result([&](VipsImage** out) {
    return vips_copy(raw.get(), out, "interpretation",
                     bands == 1 ? VIPS_INTERPRETATION_B_W : VIPS_INTERPRETATION_sRGB, nullptr);
  });
  const void* profile = nullptr;
  std::size_t profile_size = 0;
  if (!tagged || vips_image_get_blob(colors, VIPS_META_ICC_NAME, &profile, &profile_size) != 0) {
    return false;
  }
  vips_image_set_blob_copy(tagged.get(), VIPS_META_ICC_NAME, profile, profile_size);
  const VipsImagePtr converted = by_profile(tagged.get());
  if (!converted || vips_image_get_bands(converted.get()) != 3) return false;
  std::size_t size = 0;
  void* const memory = vips_image_write_to_memory(converted.get(), &size);
  if (!memory) return false;
  const auto* values = static_cast<const std::uint16_t*>(memory);
  int largest = 0;
  for (int i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c) {
      const int before = 257 * lattice[static_cast<std::size_t>(i) * bands + c % bands];
      largest = std::max(largest, std::abs(values[3 * i + c] - before));
    }
  }
  g_free(memory);
  return largest <= kTolerance;
}

}  // namespace

VipsImagePtr to_srgb(VipsImage* colors) {
  const bool is_cmyk = vips_image_get_interpretation(colors) == VIPS_INTERPRETATION_CMYK;
  const bool has_profile = vips_image_get_typeof(colors, VIPS_META_ICC_NAME) != 0;
  if (is_cmyk || (has_profile && !embeds_srgb_itself(colors))) {
    if (VipsImagePtr converted = by_profile(colors)) return converted;
  }
  vips_error_clear();
  const VipsInterpretation target = vips_image_get_format(colors) == VIPS_FORMAT_UCHAR
                                        ? VIPS_INTERPRETATION_sRGB
                                        : VIPS_INTERPRETATION_RGB16;
  return vips_result(
      [&](VipsImage** out) { return vips_colourspace(colors, out, target, nullptr); });
}

}  // namespace quadrille

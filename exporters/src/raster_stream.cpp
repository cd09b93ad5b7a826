#include "raster_stream.h"

#include <vips/vips.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "companion_folder.h"
#include "ending.h"
#include "quadrille/atomic_file.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

struct VipsUnref {
  void operator()(VipsImage* image) const { g_object_unref(image); }
};
using VipsImagePtr = std::unique_ptr<VipsImage, VipsUnref>;

using Save = int (*)(VipsImage*, const char* path, const RasterFileOptions&);

/// What a file format can hold, and how libvips writes it.
struct RasterFormat {
  const char* endings[2];
  const char* name;
  bool has_alpha;
  bool has_16_bits;
  int largest_side;
  Save save;
};

int save_png(VipsImage* image, const char* path, const RasterFileOptions&) {
  return vips_pngsave(image, path, "compression", 6, "filter", VIPS_FOREIGN_PNG_FILTER_ALL,
                      nullptr);
}

int save_jpeg(VipsImage* image, const char* path, const RasterFileOptions& options) {
  // Optimal codes take two passes, between which libjpeg keeps the whole picture in memory.
  constexpr double kLargestInMemory = 50e6;
  const bool optimize =
      1.0 * vips_image_get_width(image) * vips_image_get_height(image) <= kLargestInMemory;
  return vips_jpegsave(image, path, "Q", options.quality, "optimize_coding", optimize, nullptr);
}

int save_webp(VipsImage* image, const char* path, const RasterFileOptions& options) {
  return vips_webpsave(image, path, "Q", options.quality, nullptr);
}

int save_tiff(VipsImage* image, const char* path, const RasterFileOptions&) {
  // Classic TIFF ends at 4 GiB; deflate may grow incompressible data a little.
  const bool big = VIPS_IMAGE_SIZEOF_IMAGE(image) > (3ull << 30);
  // Tiles let viewers of large pictures read what they show.
  constexpr double kLargestInStrips = 64e6;
  const bool tile =
      1.0 * vips_image_get_width(image) * vips_image_get_height(image) > kLargestInStrips;
  return vips_tiffsave(image, path, "compression", VIPS_FOREIGN_TIFF_COMPRESSION_DEFLATE,
                       "predictor", VIPS_FOREIGN_TIFF_PREDICTOR_HORIZONTAL, "bigtiff", big, "tile",
                       tile, "tile_width", 256, "tile_height", 256, nullptr);
}

int save_dzi(VipsImage* image, const char* path, const RasterFileOptions& options) {
  const std::string base = std::filesystem::path(path).replace_extension().string();
  const bool alpha = vips_image_hasalpha(image);
  const std::string suffix = alpha ? ".png" : ".jpg[Q=" + std::to_string(options.quality) + "]";
  return vips_dzsave(image, base.c_str(), "suffix", suffix.c_str(), "tile_size", 254, "overlap", 1,
                     nullptr);
}

void keep_tiles(const CompanionFolder& tiles) {
  std::error_code ignored;
  // Holds the date, which no two runs share.
  std::filesystem::remove(tiles.temporary() / "vips-properties.xml", ignored);
  tiles.keep();
}

/// Of libvips' pictures.
constexpr int kLargestSide = 10'000'000;

constexpr RasterFormat kFormats[] = {
    {{".png", ".png"}, "PNG", true, true, kLargestSide, save_png},
    {{".jpg", ".jpeg"}, "JPEG", false, false, 65'500, save_jpeg},
    {{".webp", ".webp"}, "WebP", true, false, 16'383, save_webp},
    {{".tif", ".tiff"}, "TIFF", true, true, kLargestSide, save_tiff},
    {{".dzi", ".dzi"}, "deep-zoom", true, false, kLargestSide, save_dzi},
};

const RasterFormat* find_format(const std::string& ending) {
  for (const RasterFormat& format : kFormats) {
    if (ending == format.endings[0] || ending == format.endings[1]) return &format;
  }
  return nullptr;
}

void check_options(const RasterFormat& format, const RasterStream& stream,
                   const std::filesystem::path& path, const RasterFileOptions& options) {
  if (options.bits != 8 && (options.bits != 16 || !format.has_16_bits)) {
    throw Error(ErrorCode::invalid_argument,
                "cannot write '" + path.string() + "': " + format.name + " files with " +
                    std::to_string(options.bits) + " bits a channel are not supported; use 8" +
                    (format.has_16_bits ? " or 16" : ", or 16 with PNG or TIFF"));
  }
  if (options.quality < 1 || options.quality > 100) {
    throw Error(ErrorCode::invalid_argument, "a quality of " + std::to_string(options.quality) +
                                                 " is out of range; use 1 to 100");
  }
  if (std::max(stream.width, stream.height) > format.largest_side) {
    throw Error(ErrorCode::limit_exceeded,
                "cannot write '" + path.string() + "': a picture of " +
                    std::to_string(stream.width) + " x " + std::to_string(stream.height) +
                    " pixels does not fit into a " + format.name + " file, whose sides end at " +
                    std::to_string(format.largest_side) + "; use a smaller scale" +
                    (format.largest_side < kLargestSide ? " or write PNG or TIFF" : ""));
  }
}

void start_vips() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (VIPS_INIT("quadrille") != 0) {
      const std::string reason = vips_error_buffer();
      vips_error_clear();
      throw Error(ErrorCode::io_failure,
                  "libvips does not start (" + reason + "); check its installation");
    }
    // No operation is repeated; the cache would only keep pictures in memory.
    vips_cache_set_max(0);
    g_log_set_handler(
        "VIPS", G_LOG_LEVEL_WARNING, [](const gchar*, GLogLevelFlags, const gchar*, gpointer) {},
        nullptr);
  });
}

/// Draws for libvips; keeps what draw() throws, since no exception may pass through C code.
struct Drawing {
  const RasterStream& stream;
  PixelLayout layout;
  std::exception_ptr failure;
};

int generate(VipsRegion* region, void*, void*, void* user_data, gboolean*) {
  auto& drawing = *static_cast<Drawing*>(user_data);
  const VipsRect& r = region->valid;
  try {
    // The cache below asks for whole rows.
    drawing.stream.draw(r.top, r.height, drawing.layout,
                        {VIPS_REGION_ADDR(region, r.left, r.top), VIPS_REGION_LSKIP(region)});
    return 0;
  } catch (...) {
    if (!drawing.failure) drawing.failure = std::current_exception();
    return -1;
  }
}

bool tag_as_srgb(VipsImage* image) {
  VipsBlob* profile = nullptr;
  if (vips_profile_load("srgb", &profile, nullptr) != 0 || !profile) return false;
  std::size_t size = 0;
  const void* data = vips_blob_get(profile, &size);
  vips_image_set_blob_copy(image, VIPS_META_ICC_NAME, data, size);
  vips_area_unref(VIPS_AREA(profile));
  return true;
}

int strip_height(const RasterStream& stream) {
  constexpr long long kFewest = 16;
  return static_cast<int>(std::clamp(stream.strip_pixels / stream.width, kFewest,
                                     std::max<long long>(kFewest, stream.height)));
}

/// The picture as libvips sees it; null when libvips failed. Nothing is drawn yet.
VipsImagePtr as_vips_image(Drawing& drawing) {
  const RasterStream& stream = drawing.stream;
  const VipsImagePtr drawn(vips_image_new());
  const bool narrow = drawing.layout.type == SampleType::uint8;
  vips_image_init_fields(drawn.get(), stream.width, stream.height, drawing.layout.channels,
                         narrow ? VIPS_FORMAT_UCHAR : VIPS_FORMAT_USHORT, VIPS_CODING_NONE,
                         narrow ? VIPS_INTERPRETATION_sRGB : VIPS_INTERPRETATION_RGB16, 1.0, 1.0);
  if (!tag_as_srgb(drawn.get()) ||
      vips_image_pipelinev(drawn.get(), VIPS_DEMAND_STYLE_THINSTRIP, nullptr) != 0 ||
      vips_image_generate(drawn.get(), nullptr, generate, nullptr, nullptr, &drawing) != 0) {
    return nullptr;
  }
  // The savers ask for small pieces from several threads; the cache makes whole strips of them.
  VipsImage* cached = nullptr;
  if (vips_linecache(drawn.get(), &cached, "tile_height", strip_height(stream), "access",
                     VIPS_ACCESS_SEQUENTIAL, nullptr) != 0) {
    return nullptr;
  }
  return VipsImagePtr(cached);
}

/// Says why libvips could not write `path`, whose unfinished `temporary` is still there.
[[noreturn]] void throw_failure(const std::filesystem::path& path,
                                const std::filesystem::path& temporary) {
  char* const text = vips_error_buffer_copy();
  std::string reason(text);
  g_free(text);
  // Not every saver tells that the disk is full.
  constexpr std::uintmax_t kTooLittle = 1u << 18;
  const std::filesystem::path folder = std::filesystem::absolute(temporary).parent_path();
  std::error_code error;
  const auto space = std::filesystem::space(folder, error);
  if (!error && space.available < kTooLittle) {
    throw Error(ErrorCode::io_failure, "cannot write '" + path.string() +
                                           "': no space is left on the disk of '" +
                                           folder.string() + "'; free some or choose another path");
  }
  reason.erase(reason.find_last_not_of('\n') + 1);
  reason.erase(0, reason.rfind('\n') + 1);
  if (reason.find(temporary.string()) != std::string::npos) reason = "not all bytes arrived";
  throw Error(ErrorCode::io_failure, "cannot write '" + path.string() + "': " + reason +
                                         "; check the free space or choose another path");
}

}  // namespace

void write_stream(const RasterStream& stream, const std::filesystem::path& path,
                  const RasterFileOptions& options) {
  const RasterFormat* format = find_format(lower_case_ending(path));
  if (!format) {
    throw Error(ErrorCode::unsupported_format,
                "cannot write '" + path.string() +
                    "': raster files end in .png, .jpg, .jpeg, .webp, .tif, .tiff or .dzi; use one "
                    "of these");
  }
  check_options(*format, stream, path, options);
  start_vips();
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    Drawing drawing{stream,
                    {options.bits == 8 ? SampleType::uint8 : SampleType::uint16,
                     stream.has_alpha && format->has_alpha ? 4 : 3},
                    nullptr};
    std::optional<CompanionFolder> tiles;
    if (format->save == save_dzi) tiles.emplace(temporary, path, "_files");
    const VipsImagePtr image = as_vips_image(drawing);
    const bool saved = image && format->save(image.get(), temporary.c_str(), options) == 0;
    if (drawing.failure) std::rethrow_exception(drawing.failure);
    if (saved) {
      if (tiles) keep_tiles(*tiles);
      return;
    }
    throw_failure(path, temporary);
  });
}

}  // namespace quadrille

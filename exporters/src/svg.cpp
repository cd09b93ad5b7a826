#include <cmath>
#include <ostream>
#include <string>

#include "ending.h"
#include "gzip_stream.h"
#include "inkscape_svg.h"
#include "quadrille/atomic_file.h"
#include "quadrille/error.h"
#include "quadrille/export.h"
#include "svg_hybrid.h"
#include "svg_size.h"
#include "svg_writer.h"

namespace quadrille {
namespace {

/// The tolerance of which a size limit makes the most use, and the rounds of the search for the one
/// that fits.
constexpr double kCoarsestTolerance = 128;
constexpr int kSearchRounds = 9;

struct LevelDetail {
  double tolerance;
  int units_per_pixel;
};

LevelDetail detail_of(SvgLevel level) {
  switch (level) {
    case SvgLevel::compact:
      return {3.5, 2};
    case SvgLevel::faithful:
      return {0.42, 8};
    case SvgLevel::balanced:
    case SvgLevel::hybrid:
    case SvgLevel::inkscape:
      break;
  }
  return {1.25, 2};
}

class SvgFile {
 public:
  SvgFile(const VectorImage& image, const std::filesystem::path& path, const SvgOptions& options,
          const RunContext& context)
      : image_(image),
        path_(path),
        options_(options),
        context_(context),
        compressed_(lower_case_ending(path) == ".svgz") {}

  void write(double tolerance, std::ostream& out) const {
    if (!compressed_) return write_text(tolerance, out);
    GzipBuffer gzip(out);
    std::ostream text(&gzip);
    text.exceptions(std::ios::badbit);
    write_text(tolerance, text);
    gzip.finish();
  }

  /// The level's tolerance, or about the least one above it that keeps the file within the limit.
  double tolerance() const {
    double fine = detail_of(options_.level).tolerance;
    if (options_.size_limit == 0 || size(fine) <= options_.size_limit) return fine;
    double coarse = kCoarsestTolerance;
    const std::uint64_t least = size(coarse);
    if (least > options_.size_limit) {
      throw Error(ErrorCode::limit_exceeded,
                  "cannot write '" + path_.string() + "': it takes at least " +
                      std::to_string((least + 999) / 1000) + " KB, above the limit of " +
                      std::to_string(options_.size_limit / 1000) +
                      " KB; allow more, or use fewer quads");
    }
    for (int round = 0; round < kSearchRounds; ++round) {
      const double middle = std::sqrt(fine * coarse);
      (size(middle) <= options_.size_limit ? coarse : fine) = middle;
    }
    return coarse;
  }

 private:
  void write_text(double tolerance, std::ostream& out) const {
    if (options_.level == SvgLevel::inkscape) {
      return write_inkscape_svg(out, image_, options_.title, context_);
    }
    if (options_.level == SvgLevel::hybrid) {
      return write_hybrid_svg(out, image_, options_.title, context_);
    }
    const SvgDetail detail{tolerance * tolerance, detail_of(options_.level).units_per_pixel};
    write_svg_text(image_, options_.title, detail, context_, out);
  }
  std::uint64_t size(double tolerance) const {
    CountingBuffer counter;
    std::ostream out(&counter);
    write(tolerance, out);
    return counter.count();
  }

  const VectorImage& image_;
  const std::filesystem::path& path_;
  const SvgOptions& options_;
  const RunContext& context_;
  bool compressed_;
};

}  // namespace

void write_svg(const VectorImage& image, const std::filesystem::path& path,
               const SvgOptions& options, const RunContext& context) {
  const bool has_tolerance =
      options.level != SvgLevel::hybrid && options.level != SvgLevel::inkscape;
  if (!has_tolerance && options.size_limit != 0) {
    throw Error(ErrorCode::invalid_argument,
                "cannot write '" + path.string() +
                    "': the SVG levels hybrid and inkscape have no tolerance to search for a size "
                    "limit; leave the limit out, or choose another level");
  }
  const SvgFile svg(image, path, options, context);
  write_stream_atomically(path, [&](std::ostream& file) { svg.write(svg.tolerance(), file); });
}

}  // namespace quadrille

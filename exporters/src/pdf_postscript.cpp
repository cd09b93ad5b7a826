#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <span>

#include "ending.h"
#include "pdf_layer.h"
#include "pdf_page.h"
#include "quadrille/atomic_file.h"
#include "quadrille/export.h"
#include "svg_text.h"

namespace quadrille {
namespace {

/// Writes bytes in ASCII base 85, in lines, with the end mark (PostScript Language Reference,
/// 3.13.3).
class Ascii85 {
 public:
  explicit Ascii85(std::ostream& out) : out_(out) {}

  void add(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) {
      word_ = word_ << 8 | byte;
      if (++count_ == 4) end_word();
    }
  }
  void finish() {
    if (const int bytes = count_; bytes > 0) {
      word_ <<= 8 * (4 - bytes);
      put_digits(bytes + 1);
    }
    out_ << "~>\n";
  }

 private:
  void end_word() {
    word_ == 0 ? put('z') : put_digits(5);
    word_ = 0, count_ = 0;
  }
  void put_digits(int count) {
    char digits[5];
    for (int k = 4; k >= 0; --k, word_ /= 85) digits[k] = static_cast<char>('!' + word_ % 85);
    for (int k = 0; k < count; ++k) put(digits[k]);
  }
  void put(char c) {
    constexpr int kPerLine = 75;
    out_ << c;
    if (++column_ == kPerLine) out_ << '\n', column_ = 0;
  }

  std::ostream& out_;
  std::uint32_t word_ = 0;
  int count_ = 0, column_ = 0;
};

/// As a comment's text in parentheses: printable ASCII only.
std::string comment_text(const std::string& title) {
  std::string text = "(";
  for (const char c : title) {
    if (c == '(' || c == ')' || c == '\\') text += '\\';
    text += c >= ' ' && c <= '~' ? c : '?';
  }
  return text + ')';
}

class PostScriptWriter {
 public:
  PostScriptWriter(const VectorImage& image, const PdfOptions& options,
                   const std::filesystem::path& path, const RunContext& context, std::ostream& out)
      : image_(image),
        options_(options),
        encapsulated_(lower_case_ending(path) == ".eps"),
        context_(context),
        size_(page_size(image, options)),
        scratch_(path),
        out_(out) {}

  void write() {
    write_head();
    const std::string page = "0 0 " + fixed(size_.width) + ' ' + fixed(size_.height);
    out_ << "gsave\n" << page << " rectclip\n";
    if (!image_.opaque()) out_ << "1 setgray " << page << " rectfill\n";
    out_ << "[" << fixed(size_.scale) << " 0 0 -" << fixed(size_.scale) << " 0 "
         << fixed(size_.height) << "] concat\n";
    for (std::size_t l = 0; l < image_.layers.size(); ++l) {
      const PaintedLayer layer =
          paint_layer(image_.layers[l], fills_page(image_, l), Transparency::over_white,
                      options_.tolerance, scratch_, context_, [&](double part) {
                        context_.progress("write PostScript", (l + part) / image_.layers.size());
                      });
      for (const PaintedPart& part : layer.parts) write_part(part, layer.grid);
    }
    out_ << "grestore\nshowpage\nend\n%%EOF\n";
  }

 private:
  void write_head() {
    const auto whole = [](double length) {
      return to_text(static_cast<long long>(std::ceil(length)));
    };
    out_ << "%!PS-Adobe-3.0" << (encapsulated_ ? " EPSF-3.0" : "") << "\n%%Creator: Quadrille\n"
         << "%%Title: " << comment_text(options_.title) << "\n%%LanguageLevel: 3\n%%Pages: 1\n"
         << "%%BoundingBox: 0 0 " << whole(size_.width) << ' ' << whole(size_.height)
         << "\n%%HiResBoundingBox: 0 0 " << fixed(size_.width) << ' ' << fixed(size_.height)
         << "\n%%EndComments\n%%BeginProlog\n"
         << "/quadrille 8 dict def quadrille begin\n"  // leaves an including file's names alone
         << "/m {moveto} bind def /l {lineto} bind def\n"
         << "/c {curveto} bind def /h {closepath} bind def\nend\n%%EndProlog\n%%Page: 1 1\n"
         << "quadrille begin\n";
    if (!encapsulated_) {
      out_ << "<< /PageSize [" << fixed(size_.width) << ' ' << fixed(size_.height)
           << "] >> setpagedevice\n";
    }
  }

  void write_part(const PaintedPart& part, const CoordinateGrid& grid) {
    out_ << "gsave\n";
    clip(part.region);
    if (!part.underlay.empty()) write_underlay(part.underlay);
    for (const PaintStep& step : part.color) write_step(step, grid);
    out_ << "grestore\n";
  }

  /// The data follow the procedure that reads them.
  void write_step(const PaintStep& step, const CoordinateGrid& grid) {
    out_ << "gsave\n";
    clip(step.region);
    out_ << "{ /data currentfile /ASCII85Decode filter def\n<< "
         << shading_entries(step.shading, grid) << "\n/DataSource data " << predictor(step.shading)
         << " /FlateDecode filter >> shfill data flushfile } exec\n";
    Ascii85 text(out_);
    scratch_.read(step.shading.data, [&](ScratchFile::Bytes part) { text.add(part); });
    text.finish();
    out_ << "grestore\n";
  }

  void write_underlay(const Underlay& image) {
    const std::string width = to_text(static_cast<long long>(image.width)),
                      height = to_text(static_cast<long long>(image.height));
    out_ << "gsave\n[" << image_matrix(image) << "] concat\n"
         << "{ /data currentfile /ASCII85Decode filter def " << width << ' ' << height << " 8 ["
         << width << " 0 0 -" << height << " 0 " << height
         << "] data false 3 colorimage data flushfile } exec\n";
    Ascii85 text(out_);
    text.add({reinterpret_cast<const std::uint8_t*>(image.rgb.data()), image.rgb.size()});
    text.finish();
    out_ << "grestore\n";
  }

  /// Cuts off what is painted until grestore.
  void clip(const std::string& region) {
    if (region.empty()) return;
    const std::string scale = fixed(1.0 / PaintedLayer::kPathUnits);
    out_ << "matrix currentmatrix " << scale << " dup scale newpath\n"
         << region << "setmatrix clip newpath\n";
  }

  const VectorImage& image_;
  const PdfOptions& options_;
  bool encapsulated_;
  const RunContext& context_;
  PageSize size_;
  ScratchFile scratch_;
  std::ostream& out_;
};

}  // namespace

void write_postscript(const VectorImage& image, const std::filesystem::path& path,
                      const PdfOptions& options, const RunContext& context) {
  check_page_options(options);
  write_stream_atomically(path, [&](std::ostream& file) {
    PostScriptWriter(image, options, path, context, file).write();
  });
}

}  // namespace quadrille

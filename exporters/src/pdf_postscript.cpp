#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ostream>

#include "ending.h"
#include "pdf_layer.h"
#include "pdf_page.h"
#include "quadrille/atomic_file.h"
#include "quadrille/export.h"
#include "svg_text.h"

namespace quadrille {
namespace {

/// The bytes in ASCII base 85, in lines, with the end mark (PostScript Language Reference, 3.13.3).
std::string ascii85(const std::string& bytes) {
  constexpr std::size_t kPerLine = 75;
  std::string text;
  std::size_t line = 0;
  const auto put = [&](char c) {
    text += c;
    if (++line == kPerLine) text += '\n', line = 0;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    const std::size_t count = std::min<std::size_t>(4, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      word = word << 8 | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0);
    }
    if (word == 0 && count == 4) {
      put('z');
      continue;
    }
    char digits[5];
    for (int k = 4; k >= 0; --k, word /= 85) digits[k] = static_cast<char>('!' + word % 85);
    for (std::size_t k = 0; k <= count; ++k) put(digits[k]);
  }
  return text + "~>\n";
}

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
  PostScriptWriter(const VectorImage& image, const PdfOptions& options, bool encapsulated,
                   const RunContext& context, std::ostream& out)
      : image_(image),
        options_(options),
        encapsulated_(encapsulated),
        context_(context),
        size_(page_size(image, options)),
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
                      options_.tolerance, context_, [&](double part) {
                        context_.progress("write PostScript", (l + part) / image_.layers.size());
                      });
      for (const PaintStep& step : layer.color) write_step(step, layer.grid);
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

  /// The data follow the procedure that reads them.
  void write_step(const PaintStep& step, const CoordinateGrid& grid) {
    if (step.shading.empty()) return;
    out_ << "gsave\n";
    if (!step.region.empty()) {
      const std::string scale = fixed(1.0 / PaintedLayer::kPathUnits);
      out_ << "matrix currentmatrix " << scale << " dup scale newpath\n"
           << step.region << "setmatrix clip newpath\n";
    }
    out_ << "{ /data currentfile /ASCII85Decode filter def\n<< "
         << shading_entries(step.shading, grid) << "\n/DataSource data " << predictor(step.shading)
         << " /FlateDecode filter >> shfill data flushfile } exec\n"
         << ascii85(step.shading.data) << "grestore\n";
  }

  const VectorImage& image_;
  const PdfOptions& options_;
  bool encapsulated_;
  const RunContext& context_;
  PageSize size_;
  std::ostream& out_;
};

}  // namespace

void write_postscript(const VectorImage& image, const std::filesystem::path& path,
                      const PdfOptions& options, const RunContext& context) {
  check_page_options(options);
  const bool encapsulated = lower_case_ending(path) == ".eps";
  write_stream_atomically(path, [&](std::ostream& file) {
    PostScriptWriter(image, options, encapsulated, context, file).write();
  });
}

}  // namespace quadrille

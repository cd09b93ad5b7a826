#include <cmath>
#include <exception>
#include <memory>
#include <new>
#include <ostream>

// Chooses std::shared_ptr in the headers of libqpdf 11, which warn otherwise.
#define POINTERHOLDER_TRANSITION 4
#include <qpdf/Pl_OStream.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFPageObjectHelper.hh>
#include <qpdf/QPDFWriter.hh>

#include "pdf_layer.h"
#include "pdf_page.h"
#include "quadrille/atomic_file.h"
#include "quadrille/error.h"
#include "quadrille/export.h"
#include "quadrille/utf8_text.h"
#include "svg_text.h"

namespace quadrille {
namespace {

using Object = QPDFObjectHandle;

constexpr char kColors[] = "/DeviceRGB", kGrays[] = "/DeviceGray";

/// The share of the work that is done when the file is being put together.
constexpr double kPainting = 0.95;

/// The data of a stream, from the scratch file when they are written. Keeps what reading throws in
/// `failure`, since libqpdf only passes on its text.
class ScratchData : public Object::StreamDataProvider {
 public:
  ScratchData(ScratchFile& scratch, const ScratchRange& range, std::exception_ptr& failure)
      : scratch_(scratch), range_(range), failure_(failure) {}
  void provideStreamData(const QPDFObjGen&, Pipeline* pipeline) override {
    try {
      scratch_.read(range_,
                    [&](ScratchFile::Bytes part) { pipeline->write(part.data(), part.size()); });
      pipeline->finish();
    } catch (...) {
      if (!failure_) failure_ = std::current_exception();
      throw;
    }
  }

 private:
  ScratchFile& scratch_;
  ScratchRange range_;
  std::exception_ptr& failure_;
};

/// Builds the one page of the document.
class PdfBuilder {
 public:
  /// Needs room for temporary data beside `path`.
  PdfBuilder(const VectorImage& image, const std::filesystem::path& path, const PdfOptions& options,
             const RunContext& context)
      : scratch_(path), image_(image), options_(options), context_(context) {
    pdf_.emptyPDF();
  }

  void write(std::ostream& file) {
    add_page();
    add_metadata();
    Pl_OStream out("PDF", file);
    QPDFWriter writer(pdf_);
    writer.setOutputPipeline(&out);
    const auto report = [&](int percent) {
      context_.progress("write PDF", kPainting + (1 - kPainting) * percent / 100);
    };
    writer.registerProgressReporter(std::make_shared<QPDFWriter::FunctionProgressReporter>(report));
    writer.setObjectStreamMode(qpdf_o_generate);
    writer.setCompressStreams(true);
    writer.setRecompressFlate(false);
    writer.setDecodeLevel(qpdf_dl_none);
    writer.setDeterministicID(true);
    try {
      writer.write();
    } catch (...) {
      if (failure_) std::rethrow_exception(failure_);
      throw;
    }
  }

 private:
  Object indirect(const Object& object) { return pdf_.makeIndirectObject(object); }

  void add_page() {
    const PageSize size = page_size(image_, options_);
    const std::string scale = fixed(size.scale);
    std::string content = scale + " 0 0 -" + scale + " 0 " + fixed(size.height) + " cm\n";
    for (std::size_t l = 0; l < image_.layers.size(); ++l) {
      const PaintedLayer layer = paint_layer(
          image_.layers[l], fills_page(image_, l), Transparency::soft_mask, options_.tolerance,
          scratch_, context_, [&](double part) {
            context_.progress("write PDF", kPainting * (l + part) / image_.layers.size());
          });
      for (const PaintedPart& part : layer.parts) content += painted(part, layer.grid, resources_);
    }
    Object page = indirect(Object::newDictionary());
    page.replaceKey("/Type", Object::newName("/Page"));
    page.replaceKey("/MediaBox",
                    Object::parse("[0 0 " + fixed(size.width) + ' ' + fixed(size.height) + ']'));
    page.replaceKey("/Resources", resources_.dictionary);
    page.replaceKey("/Contents", Object::newStream(&pdf_, content));
    QPDFPageDocumentHelper(pdf_).addPage(QPDFPageObjectHelper(page), false);
  }

  /// Shadings and graphics states under the names that a content stream calls them by.
  struct Resources {
    Object dictionary = Object::parse("<< /Shading << >> /ExtGState << >> /XObject << >> >>");
    int shadings = 0, states = 0, forms = 0;

    std::string add_shading(const Object& shading) {
      const std::string name = "/S" + to_text(static_cast<long long>(shadings++));
      dictionary.getKey("/Shading").replaceKey(name, shading);
      return name;
    }
    std::string add_state(const Object& state) {
      const std::string name = "/G" + to_text(static_cast<long long>(states++));
      dictionary.getKey("/ExtGState").replaceKey(name, state);
      return name;
    }
    std::string add_form(const Object& form) {
      const std::string name = "/F" + to_text(static_cast<long long>(forms++));
      dictionary.getKey("/XObject").replaceKey(name, form);
      return name;
    }
  };

  std::string painted(const PaintedPart& part, const CoordinateGrid& grid, Resources& resources) {
    const bool masked = !part.alpha.empty() || !part.region.empty();
    Resources group;
    Resources& used = masked ? group : resources;
    const std::string colors =
        beneath(part.underlay, used) + painted(part.color, grid, used, kColors);
    if (!masked) return colors;
    Resources inner;
    const std::string mask = part.alpha.empty() ? "1 g\n" + filled(part.region)
                                                : painted(part.alpha, grid, inner, kGrays);
    return through_mask(soft_mask(mask, inner), colors, group, kColors, resources);
  }

  std::string beneath(const Underlay& underlay, Resources& resources) {
    if (underlay.empty()) return {};
    const std::string name = resources.add_form(picture(underlay));
    return "q\n" + image_matrix(underlay) + " cm\n" + name + " Do\nQ\n";
  }

  Object picture(const Underlay& underlay) {
    Object image = Object::newStream(&pdf_, underlay.rgb);
    Object dictionary = image.getDict();
    dictionary.replaceKey("/Type", Object::newName("/XObject"));
    dictionary.replaceKey("/Subtype", Object::newName("/Image"));
    dictionary.replaceKey("/Width", Object::newInteger(underlay.width));
    dictionary.replaceKey("/Height", Object::newInteger(underlay.height));
    dictionary.replaceKey("/ColorSpace", Object::newName(kColors));
    dictionary.replaceKey("/BitsPerComponent", Object::newInteger(8));
    return image;
  }

  std::string painted(const std::vector<PaintStep>& steps, const CoordinateGrid& grid,
                      Resources& resources, const char* color_space) {
    std::string content;
    for (const PaintStep& step : steps) {
      const bool cut_off = !step.region.empty();
      Resources inner;
      const std::string name =
          (cut_off ? inner : resources).add_shading(stream(step.shading, grid));
      const std::string paint = name + " sh\n";
      if (!cut_off) {
        content += paint;
        continue;
      }
      const std::string region = "1 g\n" + filled(step.region) + hairlines(step.growing, "1") +
                                 hairlines(step.shrinking, "0");
      const Object mask = soft_mask(region, Resources{});
      content += through_mask(mask, paint, inner, color_space, resources);
    }
    return content;
  }

  /// The content as a group: the mask then cuts off each pixel once, however often the content
  /// paints it, and takes the place of none inside of it.
  std::string through_mask(const Object& mask, const std::string& content, const Resources& inner,
                           const char* color_space, Resources& resources) {
    const std::string form = resources.add_form(group(content, inner, color_space));
    return "q\n" + resources.add_state(mask) + " gs\n" + form + " Do\nQ\n";
  }

  static std::string filled(const std::string& path) { return drawn(path, "f"); }

  /// A line of width 0 is as thin as the device has them. MuPDF covers a quarter of its pixels then
  /// and Ghostscript half of them, more where it is drawn again.
  static std::string hairlines(const std::string& path, const std::string& gray) {
    if (path.empty()) return path;
    const std::string line = drawn(path, "S");
    return gray + " G 0 w\n" + line + line + line;
  }

  static std::string drawn(const std::string& path, const std::string& operation) {
    const std::string scale = fixed(1.0 / PaintedLayer::kPathUnits);
    return "q\n" + scale + " 0 0 " + scale + " 0 0 cm\n" + path + operation + "\nQ\n";
  }

  std::string page_rectangle() const {
    return "0 0 " + fixed(image_.width) + ' ' + fixed(image_.height);
  }

  /// A transparency group over the page.
  Object group(const std::string& content, const Resources& resources, const char* color_space) {
    Object form = Object::newStream(&pdf_, content);
    Object dictionary = form.getDict();
    dictionary.replaceKey("/Type", Object::newName("/XObject"));
    dictionary.replaceKey("/Subtype", Object::newName("/Form"));
    dictionary.replaceKey("/BBox", Object::parse('[' + page_rectangle() + ']'));
    dictionary.replaceKey("/Group", Object::parse(std::string("<< /S /Transparency /I true /CS ") +
                                                  color_space + " >>"));
    dictionary.replaceKey("/Resources", resources.dictionary);
    return form;
  }

  /// Shows the page through the luminosity of the content, painted on black.
  Object soft_mask(const std::string& content, const Resources& resources) {
    const std::string black = "0 g\n" + page_rectangle() + " re f\n";
    Object mask = Object::parse("<< /Type /Mask /S /Luminosity >>");
    mask.replaceKey("/G", group(black + content, resources, kGrays));
    Object state = Object::parse("<< /Type /ExtGState >>");
    state.replaceKey("/SMask", mask);
    return indirect(state);
  }

  Object stream(const CoonsShading& shading, const CoordinateGrid& grid) {
    Object object = Object::newStream(&pdf_);
    object.replaceDict(Object::parse("<< " + shading_entries(shading, grid) + " >>"));
    object.replaceStreamData(std::make_shared<ScratchData>(scratch_, shading.data, failure_),
                             Object::newName("/FlateDecode"), Object::parse(predictor(shading)));
    return object;
  }

  void add_metadata() {
    Object info = indirect(Object::newDictionary());
    info.replaceKey("/Title", Object::newUnicodeString(valid_utf8(options_.title)));
    info.replaceKey("/Producer", Object::newUnicodeString("Quadrille"));
    pdf_.getTrailer().replaceKey("/Info", info);
    Object xmp = Object::newStream(&pdf_, xmp_packet(options_.title));
    xmp.getDict().replaceKey("/Type", Object::newName("/Metadata"));
    xmp.getDict().replaceKey("/Subtype", Object::newName("/XML"));
    pdf_.getRoot().replaceKey("/Metadata", xmp);
  }

  static std::string xmp_packet(const std::string& title) {
    return "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
           "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
           "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
           "<rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\""
           " xmlns:pdf=\"http://ns.adobe.com/pdf/1.3/\">\n"
           "<dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">" +
           xml_escaped(title) +
           "</rdf:li></rdf:Alt></dc:title>\n"
           "<pdf:Producer>Quadrille</pdf:Producer>\n"
           "</rdf:Description>\n</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"r\"?>\n";
  }

  ScratchFile scratch_;  // outlives the streams that read from it, as does the next
  std::exception_ptr failure_;
  QPDF pdf_;
  const VectorImage& image_;
  const PdfOptions& options_;
  const RunContext& context_;
  Resources resources_;
};

}  // namespace

void write_pdf(const VectorImage& image, const std::filesystem::path& path,
               const PdfOptions& options, const RunContext& context) {
  check_page_options(options);
  write_stream_atomically(path, [&](std::ostream& file) {
    try {
      PdfBuilder(image, path, options, context).write(file);
    } catch (const Error&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw Error(ErrorCode::numerical_failure, "cannot write '" + path.string() +
                                                    "': the PDF cannot be put together (" +
                                                    error.what() + "); report the picture");
    }
  });
}

}  // namespace quadrille

#include <cmath>
#include <memory>
#include <ostream>

// Chooses std::shared_ptr in the headers of libqpdf 11, which warn otherwise.
#define POINTERHOLDER_TRANSITION 4
#include <qpdf/Buffer.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFWriter.hh>

#include "pdf_mesh.h"
#include "quadrille/atomic_file.h"
#include "quadrille/error.h"
#include "quadrille/export.h"

namespace quadrille {
namespace {

/// The drawn PDF with its streams compressed, and without anything that changes from run to run.
/// Made in memory, since QPDFWriter does not notice a full disk.
std::shared_ptr<Buffer> compressed(const std::vector<unsigned char>& drawn,
                                   const std::string& title) {
  QPDF pdf;
  pdf.setSuppressWarnings(true);
  pdf.processMemoryFile("picture", reinterpret_cast<const char*>(drawn.data()), drawn.size());
  QPDFObjectHandle info = pdf.makeIndirectObject(QPDFObjectHandle::newDictionary());
  info.replaceKey("/Title", QPDFObjectHandle::newUnicodeString(title));
  info.replaceKey("/Producer", QPDFObjectHandle::newUnicodeString("Quadrille"));
  pdf.getTrailer().replaceKey("/Info", info);

  QPDFWriter writer(pdf);
  writer.setOutputMemory();
  writer.setObjectStreamMode(qpdf_o_generate);
  writer.setCompressStreams(true);
  writer.setDeterministicID(true);
  writer.write();
  return writer.getBufferSharedPointer();
}

}  // namespace

void write_pdf(const VectorImage& image, const std::filesystem::path& path,
               const PdfOptions& options, const RunContext& context) {
  if (!(options.dpi > 0) || !std::isfinite(options.dpi) || !(options.tolerance > 0)) {
    throw Error(ErrorCode::invalid_argument,
                "the PDF options dpi = " + std::to_string(options.dpi) + " and tolerance = " +
                    std::to_string(options.tolerance) + " must be positive; use 96 and 4");
  }
  const std::vector<unsigned char> drawn = draw_pdf(image, options, context);
  std::shared_ptr<Buffer> bytes;
  try {
    bytes = compressed(drawn, options.title);
  } catch (const std::exception& error) {
    throw Error(ErrorCode::numerical_failure, std::string("the drawn PDF cannot be compressed (") +
                                                  error.what() + "); report the picture");
  }
  write_stream_atomically(path, [&](std::ostream& file) {
    file.write(reinterpret_cast<const char*>(bytes->getBuffer()),
               static_cast<std::streamsize>(bytes->getSize()));
  });
}

}  // namespace quadrille

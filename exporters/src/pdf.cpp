#include <cmath>

// Chooses std::shared_ptr in the headers of libqpdf 11, which warn otherwise.
#define POINTERHOLDER_TRANSITION 4
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFWriter.hh>

#include "pdf_mesh.h"
#include "quadrille/atomic_file.h"
#include "quadrille/error.h"
#include "quadrille/export.h"

namespace quadrille {
namespace {

/// The drawn PDF with its streams compressed, and without anything that changes from run to run.
void write_compressed(const std::vector<unsigned char>& drawn, const std::string& title,
                      const std::filesystem::path& path) {
  QPDF pdf;
  pdf.setSuppressWarnings(true);
  pdf.processMemoryFile("picture", reinterpret_cast<const char*>(drawn.data()), drawn.size());
  QPDFObjectHandle info = pdf.makeIndirectObject(QPDFObjectHandle::newDictionary());
  info.replaceKey("/Title", QPDFObjectHandle::newUnicodeString(title));
  info.replaceKey("/Producer", QPDFObjectHandle::newUnicodeString("Quadrille"));
  pdf.getTrailer().replaceKey("/Info", info);

  QPDFWriter writer(pdf, path.c_str());
  writer.setObjectStreamMode(qpdf_o_generate);
  writer.setCompressStreams(true);
  writer.setDeterministicID(true);
  writer.write();
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
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    try {
      write_compressed(drawn, options.title, temporary);
    } catch (const std::exception& error) {
      throw Error(ErrorCode::io_failure, "cannot write '" + path.string() + "': " + error.what() +
                                             "; check that the disk is not full");
    }
  });
}

}  // namespace quadrille

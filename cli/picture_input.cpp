#include "picture_input.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "command.h"
#include "output_files.h"
#include "quadrille/error.h"
#include "quadrille/image_file.h"
#include "quadrille/render.h"
#include "quadrille/utf8_text.h"

namespace quadrille::cli {

namespace fs = std::filesystem;

namespace {

void note_source(VectorImage& image, const fs::path& source) {
  image.metadata["title"] = printable_name(source.stem());
  image.metadata["source"] = printable_name(source);
}

}  // namespace

bool is_document(const fs::path& path) {
  constexpr std::array<std::string_view, 3> kEndings = {".quad", ".vtu", ".vtm"};
  return std::ranges::find(kEndings, ending_of(path)) != kEndings.end();
}

void check_mesh_options(const fs::path& path, const MeshOptions& mesh) {
  if (!is_document(path) || mesh == MeshOptions{}) return;
  throw UsageError("'" + path.string() +
                   "' holds patches already; leave out --quads and other options of the mesh, "
                   "which are for vectorizing a picture");
}

Raster read_picture(const fs::path& path, Observer& observer) {
  if (is_document(path)) {
    throw Error(
        ErrorCode::unsupported_format,
        "'" + path.string() +
            "' holds patches already; write them in other formats by `quadrille export`, or "
            "draw them as a picture by `quadrille render` first");
  }
  return observer.stage("read", [&] { return load_image(path); });
}

Raster read_raster(const fs::path& path, Observer& observer) {
  return observer.stage("read", [&] {
    return is_document(path) ? render(import_image(path), {}, observer.context())
                             : load_image(path);
  });
}

VectorImage read_vector_image(const fs::path& path, const MeshOptions& mesh, Observer& observer) {
  if (is_document(path)) return observer.stage("read", [&] { return import_image(path); });
  const Raster picture = read_raster(path, observer);
  const ChosenOptions chosen = choose_options(mesh, picture, observer);
  return vectorize_picture(picture, path, chosen.vectorize, observer).image;
}

std::shared_ptr<const Raster> read_source(const fs::path& document, const fs::path& source,
                                          const VectorImage& image, Observer& observer) {
  std::optional<Raster> picture;
  if (!source.empty()) {
    picture = read_raster(source, observer);
  } else {
    picture = observer.stage("read", [&] { return import_source(document); });
  }
  if (!picture) return nullptr;
  if (image.width != picture->width || image.height != picture->height) {
    throw Error(ErrorCode::invalid_argument,
                fmt::format("'{}' of {} x {} pixels is not the source of '{}' of {} x {}; give the "
                            "picture that it was made of",
                            (source.empty() ? document : source).string(), picture->width,
                            picture->height, document.string(), image.width, image.height));
  }
  return std::make_shared<const Raster>(std::move(*picture));
}

Vectorization vectorize_picture(const Raster& picture, const fs::path& source,
                                const VectorizeOptions& options, Observer& observer) {
  Vectorization result =
      with_name_of(source, [&] { return vectorize(picture, options, observer.context()); });
  note_source(result.image, source);
  return result;
}

StagedVectorization vectorize_in_stages(const Raster& picture, const fs::path& source,
                                        const VectorizeOptions& options, Observer& observer) {
  StagedVectorization staged;
  staged.result = with_name_of(
      source, [&] { return vectorize(picture, options, observer.context(), &staged.stages); });
  note_source(staged.result.image, source);
  return staged;
}

BoundedVectorization vectorize_picture_to_error(const Raster& picture, const fs::path& source,
                                                const ErrorBound& bound,
                                                const VectorizeOptions& options,
                                                Observer& observer) {
  BoundedVectorization bounded = with_name_of(
      source, [&] { return vectorize_to_error(picture, bound, options, observer.context()); });
  note_source(bounded.result.image, source);
  return bounded;
}

std::string printable_name(const fs::path& path) {
  std::string name = valid_utf8(path.filename().string());
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return name;
}

}  // namespace quadrille::cli

#include <expat.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "quadrille/error.h"
#include "quadrille/export.h"
#include "vtk_array_file.h"
#include "vtk_whole_file.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestIndex = 1 << 26;  // bytes; a layer takes about a hundred
constexpr std::size_t kMostPixels = 300'000'000;   // as load_image() takes

/// Where the index of a multi-block data set says that its pieces lie.
class MultiblockIndex {
 public:
  explicit MultiblockIndex(const fs::path& path) : path_(path) {
    const std::string text = read_whole(path, kLargestIndex);
    const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
        XML_ParserCreate(nullptr), XML_ParserFree);
    XML_SetUserData(parser.get(), this);
    XML_SetElementHandler(parser.get(), start, end);
    const bool well_formed =
        XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), 1) == XML_STATUS_OK;
    if (type_ != "vtkMultiBlockDataSet") {
      throw Error(ErrorCode::unsupported_format,
                  "'" + path.string() + "' is no .vtm file; give one that Quadrille wrote");
    }
    if (!well_formed) {
      throw Error(ErrorCode::io_failure,
                  "'" + path.string() + "' is damaged: it is no XML; export it again");
    }
  }

  /// A layer's file; empty when there is no such layer. Throws Error{unsupported_format} when the
  /// index names a file that is not below its own folder.
  fs::path piece(const std::string& group, const std::string& layer) const {
    const auto found = pieces_.find({group, layer});
    if (found == pieces_.end()) return {};
    const fs::path name = found->second;
    if (name.is_absolute() || std::ranges::find(name, fs::path("..")) != name.end()) {
      throw Error(ErrorCode::unsupported_format, "'" + path_.string() + "' names a part '" +
                                                     name.string() +
                                                     "' outside of its folder; give a file that "
                                                     "Quadrille wrote");
    }
    return path_.parent_path() / name;
  }

 private:
  using Attributes = std::map<std::string, std::string>;

  // No exception may pass through C code.
  static void start(void* self, const XML_Char* name, const XML_Char** attributes) {
    auto& index = *static_cast<MultiblockIndex*>(self);
    Attributes map;
    for (; *attributes; attributes += 2) map[attributes[0]] = attributes[1];
    index.open(name, map);
    ++index.depth_;
  }
  static void end(void* self, const XML_Char*) { --static_cast<MultiblockIndex*>(self)->depth_; }

  void open(const std::string& element, Attributes& attributes) {
    constexpr int kBlockDepth = 2, kPieceDepth = 3;  // within VTKFile and vtkMultiBlockDataSet
    if (depth_ == 0) type_ = attributes["type"];
    if (depth_ == kBlockDepth) group_ = attributes["name"];
    if (depth_ == kPieceDepth && element == "DataSet") {
      pieces_[{group_, attributes["name"]}] = attributes["file"];
    }
  }

  fs::path path_;
  int depth_ = 0;
  std::string type_, group_;
  std::map<std::pair<std::string, std::string>, std::string> pieces_;
};

constexpr char kGroup[] = "picture";  // see picture_group()

/// read(), with a word about the index in front of what it says of a piece that cannot be reached.
template <class Read>
auto read_piece(const fs::path& index, const fs::path& piece, const Read& read) {
  std::error_code error;
  const fs::file_status status = fs::status(piece, error);
  if (!fs::exists(status)) {
    throw Error(ErrorCode::io_failure,
                "cannot read '" + index.string() + "': its part '" + piece.string() + "' " +
                    (fs::status_known(status) ? "is missing"
                                              : "cannot be reached (" + error.message() + ")") +
                    "; keep that folder beside the file");
  }
  return read(piece);
}

template <int channels>
Raster raster_of(const VtkArrayFile& file, const char* name) {
  const auto pixels = file.elements<std::uint8_t, std::array<std::uint8_t, channels>>(
      VtkArrayFile::Part::cell, name);
  const auto [width, height] = file.pixels();
  if (pixels.empty() || pixels.size() != width * height) file.refuse("its pixels are missing");
  Raster picture(static_cast<int>(width), static_cast<int>(height), channels);
  auto pixel = pixels.begin();
  for (int y = picture.height - 1; y >= 0; --y) {  // VTK's rows begin at the bottom
    for (int x = 0; x < picture.width; ++x, ++pixel) {
      for (int c = 0; c < channels; ++c) picture.pixel(x, y)[c] = (*pixel)[c] / 255.0f;
    }
  }
  return picture;
}

Raster read_picture(const fs::path& path) {
  const VtkArrayFile file(path, VtkArrayFile::Kind::image);
  const auto [width, height] = file.pixels();
  if (width * height > kMostPixels) {  // both below 2^31
    throw Error(ErrorCode::limit_exceeded,
                "'" + path.string() + "' has " + std::to_string(width) + " x " +
                    std::to_string(height) + " pixels, more than the limit of " +
                    std::to_string(kMostPixels) + "; use a smaller picture");
  }
  return file.has(VtkArrayFile::Part::cell, "rgba") ? raster_of<4>(file, "rgba")
                                                    : raster_of<3>(file, "rgb");
}

}  // namespace

VectorImage read_vtm(const fs::path& path) {
  const fs::path piece = MultiblockIndex(path).piece(kGroup, "patches");
  if (piece.empty()) {
    throw Error(ErrorCode::unsupported_format,
                "'" + path.string() + "' holds no patches of Quadrille; give a file that it wrote");
  }
  return read_piece(path, piece, read_vtu);
}

std::optional<Raster> read_vtm_source(const fs::path& path) {
  const fs::path piece = MultiblockIndex(path).piece(kGroup, "picture");
  if (piece.empty()) return std::nullopt;
  return read_piece(path, piece, read_picture);
}

}  // namespace quadrille

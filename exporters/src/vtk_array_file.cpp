#include "vtk_array_file.h"

#include <expat.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <memory>
#include <sstream>

#include "quadrille/error.h"
#include "vtk_whole_file.h"

namespace quadrille {
namespace {

/// zlib shrinks to no less than 1/1032.
constexpr unsigned long long kMostGrowth = 1032;
constexpr unsigned long long kLargestArray = 1ull << 32;  // bytes; ten million patches take less

constexpr const char* name_of(VtkArrayFile::Kind kind) {
  return kind == VtkArrayFile::Kind::image ? "ImageData" : "UnstructuredGrid";
}

constexpr const char* ending_of(VtkArrayFile::Kind kind) {
  return kind == VtkArrayFile::Kind::image ? ".vti" : ".vtu";
}

}  // namespace

/// Collects what the XML part of the file says.
class VtkArrayFile::HeaderParser {
 public:
  explicit HeaderParser(VtkArrayFile& file) : file_(file) {}

  void parse(std::string_view header) {
    const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
        XML_ParserCreate(nullptr), XML_ParserFree);
    XML_SetUserData(parser.get(), this);
    XML_SetElementHandler(parser.get(), start, end);
    constexpr std::string_view kEnd = "</VTKFile>";  // instead of the data, which are no XML
    const bool well_formed =
        XML_Parse(parser.get(), header.data(), static_cast<int>(header.size()), 0) ==
            XML_STATUS_OK &&
        XML_Parse(parser.get(), kEnd.data(), static_cast<int>(kEnd.size()), 1) == XML_STATUS_OK;
    if (!failure_.empty()) file_.refuse(failure_);
    if (!well_formed) file_.refuse("its header is no XML");
    if (pieces_ != 1) file_.refuse("it has " + std::to_string(pieces_) + " pieces instead of 1");
  }

  std::string file_type, byte_order, compressor, header_type;

 private:
  using Attributes = std::map<std::string, std::string>;

  // No exception may pass through C code.
  static void start(void* self, const XML_Char* name, const XML_Char** attributes) {
    auto& parser = *static_cast<HeaderParser*>(self);
    Attributes map;
    for (; *attributes; attributes += 2) map[attributes[0]] = attributes[1];
    parser.open(name, map);
    parser.path_.emplace_back(name);
  }
  static void end(void* self, const XML_Char*) {
    static_cast<HeaderParser*>(self)->path_.pop_back();
  }

  void open(const std::string& name, Attributes& attributes) {
    if (path_.empty()) {
      file_type = attributes["type"];
      byte_order = attributes["byte_order"];
      compressor = attributes["compressor"];
      header_type = attributes["header_type"];
    } else if (name == "Piece") {
      ++pieces_;
      if (file_.kind_ == Kind::image) return set_extent(attributes["Extent"]);
      file_.point_count_ = number(attributes["NumberOfPoints"]);
      file_.cell_count_ = number(attributes["NumberOfCells"]);
    } else if (name == "DataArray" || name == "Array") {
      add_array(attributes);
    }
  }

  void add_array(Attributes& attributes) {
    const std::string& parent = path_.back();
    Part part = Part::field;
    Array array{attributes["type"], attributes["format"]};
    if (parent == "FieldData") {
      array.tuples = number(attributes["NumberOfTuples"]);
    } else if (parent == "CellData") {
      part = Part::cell;
      array.tuples = file_.cell_count_;
    } else if (parent == "Points") {
      part = Part::point;
      attributes["Name"] = kCoordinates;
      array.tuples = file_.point_count_;
    } else {
      return;  // colours and connectivity follow from the patches
    }
    if (attributes.contains("NumberOfComponents")) {
      array.components = number(attributes["NumberOfComponents"]);
    }
    if (array.format == "appended") array.offset = number(attributes["offset"]);
    file_.arrays_[{part, attributes["Name"]}] = array;
  }

  /// "0 W 0 H 0 0": a pixel is a cell.
  void set_extent(const std::string& text) {
    std::istringstream stream(text);
    std::array<std::string, 6> bounds;
    for (std::string& bound : bounds) stream >> bound;
    if (bounds[0] != "0" || bounds[2] != "0" || bounds[4] != "0" || bounds[5] != "0") {
      failure_ = "its extent is not that of a picture";
      return;
    }
    constexpr unsigned long long kMostSide = 1ull << 30;
    file_.pixels_ = {number(bounds[1]), number(bounds[3])};
    if (std::ranges::max(file_.pixels_) > kMostSide) failure_ = "its extent is impossible";
    file_.cell_count_ = file_.pixels_[0] * file_.pixels_[1];
  }

  unsigned long long number(const std::string& text) {
    unsigned long long value = 0;
    const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || last != text.data() + text.size() ||
        value > kMostGrowth * file_.file_.size()) {
      failure_ = "a number in its header is impossible";
      return 0;
    }
    return value;
  }

  VtkArrayFile& file_;
  std::vector<std::string> path_;
  std::string failure_;
  int pieces_ = 0;
};

VtkArrayFile::VtkArrayFile(const std::filesystem::path& path, Kind kind)
    : name_(path.string()), file_(read_whole(path)), kind_(kind) {
  constexpr std::size_t kStart = 4096;  // where a file tells what it is
  const std::string_view start = std::string_view(file_).substr(0, kStart);
  if (start.find("<VTKFile") == start.npos || start.find(name_of(kind)) == start.npos) {
    throw Error(ErrorCode::unsupported_format, "'" + name_ + "' is no " + ending_of(kind) +
                                                   " file; give one that Quadrille wrote");
  }
  if (file_.rfind("</VTKFile>") == file_.npos) refuse("it is cut off");
  const std::size_t appended = file_.find("<AppendedData");
  if (appended == file_.npos) {
    refuse_form("it has no appended data");
  }
  constexpr std::size_t kLongestHeader = std::numeric_limits<int>::max();  // for the parser
  if (appended > kLongestHeader) refuse_form("its header has more than 2 GiB");
  HeaderParser parser(*this);
  parser.parse(std::string_view(file_).substr(0, appended));
  if (parser.file_type != name_of(kind)) refuse_form(std::string("it is no ") + name_of(kind));
  if (parser.byte_order != "LittleEndian") refuse_form("its bytes are in another order");
  if (!parser.compressor.empty() && parser.compressor != "vtkZLibDataCompressor") {
    refuse_form("it is not compressed by zlib");
  }
  compressed_ = !parser.compressor.empty();
  word_bytes_ = parser.header_type == "UInt64" ? 8 : 4;
  const std::size_t tag_end = file_.find('>', appended);
  if (tag_end == file_.npos) refuse("it is cut off");
  if (file_.substr(appended, tag_end - appended).find("\"raw\"") == std::string::npos) {
    refuse_form("its appended data are encoded");
  }
  const std::size_t mark = file_.find('_', tag_end);
  if (mark == file_.npos) refuse("it is cut off");
  data_begin_ = mark + 1;
}

void VtkArrayFile::refuse(const std::string& why) const {
  throw Error(ErrorCode::io_failure, "'" + name_ + "' is damaged: " + why + "; export it again");
}

void VtkArrayFile::refuse_content(const std::string& holds) const {
  throw Error(ErrorCode::unsupported_format,
              "'" + name_ + "' holds " + holds + "; give a file that it wrote");
}

void VtkArrayFile::refuse_form(const std::string& why) const {
  throw Error(ErrorCode::unsupported_format,
              "'" + name_ + "' cannot be read: " + why +
                  "; store it with raw appended data, plain or compressed by zlib");
}

std::vector<std::string> VtkArrayFile::texts(const std::string& name) const {
  const auto found = arrays_.find({Part::field, name});
  if (found == arrays_.end() || found->second.tuples == 0) return {};
  if (found->second.type != "String") refuse("the array '" + name + "' holds no texts");
  const std::vector<std::byte> bytes = content_of(found->second);
  std::vector<std::string> list(1);
  for (const std::byte b : bytes) {
    if (b == std::byte{0}) {
      list.emplace_back();
    } else {
      list.back() += static_cast<char>(b);
    }
  }
  if (!list.back().empty() || list.size() != found->second.tuples + 1) {
    refuse("the array '" + name + "' has a wrong size");
  }
  list.pop_back();
  return list;
}

std::vector<std::byte> VtkArrayFile::numbers(Part part, const std::string& name, const char* type,
                                             std::size_t components,
                                             std::size_t tuple_bytes) const {
  const auto found = arrays_.find({part, name});
  if (found == arrays_.end() || found->second.tuples == 0) return {};
  const Array& array = found->second;
  if (array.type != type || array.components != components) {
    refuse("the array '" + name + "' has a wrong type");
  }
  if (size_of(array) != array.tuples * tuple_bytes) {  // before memory is taken for it
    refuse("the array '" + name + "' has a wrong size");
  }
  return content_of(array);
}

unsigned long long VtkArrayFile::word(std::size_t at) const {
  if (at > file_.size() || file_.size() - at < word_bytes_) refuse("it is cut off");
  std::uint64_t wide = 0;
  std::memcpy(&wide, file_.data() + at, word_bytes_);  // little endian, as the machine
  return wide;
}

/// Words for the number of blocks, the bytes of each and of a last partial one; then follow their
/// compressed sizes and the blocks.
struct VtkArrayFile::Blocks {
  unsigned long long count = 0, size = 0, last = 0;

  unsigned long long total() const { return count > 0 ? size * (count - (last > 0)) + last : 0; }
};

std::size_t VtkArrayFile::begin_of(const Array& array) const {
  if (array.format != "appended") refuse_form("an array is not appended");
  return data_begin_ + array.offset;  // both below 2^60
}

/// Bytes of the content, as far as what stands in front of it can be believed.
unsigned long long VtkArrayFile::size_of(const Array& array) const {
  const std::size_t at = begin_of(array);
  return compressed_ ? blocks_at(at).total() : word(at);
}

std::vector<std::byte> VtkArrayFile::content_of(const Array& array) const {
  const std::size_t at = begin_of(array);
  if (compressed_) return inflated(at);
  const unsigned long long size = word(at);
  if (size > file_.size() - at - word_bytes_) refuse("it is cut off");
  const auto* first = reinterpret_cast<const std::byte*>(file_.data()) + at + word_bytes_;
  return {first, first + size};
}

VtkArrayFile::Blocks VtkArrayFile::blocks_at(std::size_t at) const {
  const unsigned long long count = word(at);
  if (count == 0) return {};
  const Blocks blocks = {count, word(at + word_bytes_), word(at + 2 * word_bytes_)};
  const unsigned long long most = std::min(kMostGrowth * file_.size(), kLargestArray);
  if (count > file_.size() / word_bytes_ || blocks.size > most / count ||
      blocks.last > blocks.size) {
    refuse("a block's size is impossible");
  }
  return blocks;
}

std::vector<std::byte> VtkArrayFile::inflated(std::size_t at) const {
  const Blocks blocks = blocks_at(at);
  std::vector<std::byte> bytes(blocks.total());
  std::size_t from = at + (3 + blocks.count) * word_bytes_, to = 0;
  for (unsigned long long b = 0; b < blocks.count; ++b) {
    const unsigned long long packed = word(at + (3 + b) * word_bytes_);
    if (from > file_.size() || packed > file_.size() - from) refuse("it is cut off");
    const bool is_partial = b + 1 == blocks.count && blocks.last > 0;
    const unsigned long long wanted = is_partial ? blocks.last : blocks.size;
    uLongf length = wanted;
    if (uncompress(reinterpret_cast<Bytef*>(bytes.data()) + to, &length,
                   reinterpret_cast<const Bytef*>(file_.data()) + from, packed) != Z_OK ||
        length != wanted) {
      refuse("a compressed block is broken");
    }
    from += packed;
    to += wanted;
  }
  return bytes;
}

}  // namespace quadrille

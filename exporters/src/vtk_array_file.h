#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quadrille {

/// The arrays of an unstructured grid or an image in VTK's XML format with raw appended data, plain
/// or compressed by zlib. VTK's own reader believes what a file says of its sizes and crashes on
/// damaged ones; here everything is checked, and an array takes at most 1032 times the
/// file's size and 4 GiB, one of numbers also no more than its tuples.
class VtkArrayFile {
 public:
  enum class Part { field, cell, point };
  enum class Kind { unstructured_grid, image };

  /// Throws Error{unsupported_format} for a foreign file or one with data in another form, and
  /// Error{io_failure}, as all members do, for a missing or damaged one.
  explicit VtkArrayFile(const std::filesystem::path& path, Kind kind = Kind::unstructured_grid);

  std::size_t point_count() const { return point_count_; }
  std::size_t cell_count() const { return cell_count_; }
  /// Width and height of an image whose pixels are its cells.
  const std::array<std::size_t, 2>& pixels() const { return pixels_; }
  bool has(Part part, const std::string& name) const { return arrays_.contains({part, name}); }

  /// The tuples of an array of numbers; empty when there is no such array.
  template <class Number, class Element>
  std::vector<Element> elements(Part part, const std::string& name) const {
    static_assert(sizeof(Element) % sizeof(Number) == 0);
    const std::vector<std::byte> bytes =
        numbers(part, name, type_name(Number()), sizeof(Element) / sizeof(Number), sizeof(Element));
    std::vector<Element> list(bytes.size() / sizeof(Element));
    if (!list.empty()) std::memcpy(static_cast<void*>(list.data()), bytes.data(), bytes.size());
    return list;
  }
  /// The coordinates of the points, as elements of three numbers.
  template <class Element>
  std::vector<Element> points() const {
    return elements<double, Element>(Part::point, kCoordinates);
  }
  /// The texts of a field array; empty when there is no such array.
  std::vector<std::string> texts(const std::string& name) const;

  [[noreturn]] void refuse(const std::string& why) const;
  /// For what the file `holds`, which is none of ours.
  [[noreturn]] void refuse_content(const std::string& holds) const;

 private:
  [[noreturn]] void refuse_form(const std::string& why) const;

  struct Array {
    std::string type, format;
    unsigned long long components = 1, tuples = 0, offset = 0;
  };
  static constexpr char kCoordinates[] = "points";
  class HeaderParser;

  static const char* type_name(double) { return "Float64"; }
  static const char* type_name(float) { return "Float32"; }
  static const char* type_name(int) { return "Int32"; }
  static const char* type_name(unsigned char) { return "UInt8"; }

  std::vector<std::byte> numbers(Part part, const std::string& name, const char* type,
                                 std::size_t components, std::size_t tuple_bytes) const;
  struct Blocks;
  std::size_t begin_of(const Array& array) const;
  unsigned long long size_of(const Array& array) const;
  std::vector<std::byte> content_of(const Array& array) const;
  Blocks blocks_at(std::size_t at) const;
  std::vector<std::byte> inflated(std::size_t at) const;
  unsigned long long word(std::size_t at) const;

  std::string name_, file_;
  Kind kind_;
  std::size_t data_begin_ = 0;  ///< of the appended data in the file
  std::size_t word_bytes_ = 4;
  bool compressed_ = false;
  std::size_t point_count_ = 0, cell_count_ = 0;
  std::array<std::size_t, 2> pixels_ = {0, 0};
  std::map<std::pair<Part, std::string>, Array> arrays_;
};

}  // namespace quadrille

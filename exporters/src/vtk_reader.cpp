#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <charconv>
#include <exception>
#include <fstream>
#include <iterator>
#include <string_view>

#include "quadrille/error.h"
#include "quadrille/export.h"
#include "vtk_points.h"
#include "vtk_silence.h"
#include "vtk_state.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw Error(ErrorCode::io_failure,
              "'" + path.string() + "' is damaged: " + why + "; export it again");
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad() || fs::is_directory(path)) {
    throw Error(ErrorCode::io_failure, "cannot read '" + path.string() +
                                           "': there is no such file, or it may not be read; check "
                                           "the path");
  }
  return content;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// VTK's reader believes every number and makes room for it, so those that no file of this size can
/// hold are refused before: zlib shrinks to no less than 1/1032.
void check_claims(std::string_view content, const fs::path& path) {
  const std::string_view header = content.substr(0, content.find("<AppendedData"));
  const unsigned long long most = 1032ull * content.size();
  for (auto equals = header.find("=\""); equals != header.npos;
       equals = header.find("=\"", equals + 1)) {
    auto begin = equals;
    while (begin > 0 && is_letter(header[begin - 1])) --begin;
    const std::string_view name = header.substr(begin, equals - begin);
    if (!name.starts_with("Number") && name != "offset") continue;
    const auto close = header.find('"', equals + 2);
    if (close == header.npos) refuse(path, "its header is cut off");
    unsigned long long count = 0;
    const char *const first = header.data() + equals + 2, *const last = header.data() + close;
    const auto [end, error] = std::from_chars(first, last, count);
    if (error != std::errc() || end != last || count > most) {
      refuse(path, "a number in its header is impossible");
    }
  }
}

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const std::string& content, const fs::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  vtkNew<SilentObserver> silent;
  reader->AddObserver(vtkCommand::ErrorEvent, silent);
  reader->AddObserver(vtkCommand::WarningEvent, silent);
  reader->ReadFromInputStringOn();
  reader->SetInputString(content);
  try {
    reader->Update();
  } catch (const std::exception&) {
    refuse(path, "VTK cannot read it");
  }
  if (silent->errors > 0 || reader->GetErrorCode() != 0) refuse(path, "VTK cannot read it");
  return reader->GetOutput();
}

/// The cells must be the patches that the state describes, or another program changed them.
void check_points(const VectorImage& image, vtkUnstructuredGrid* grid, const fs::path& path) {
  vtkIdType point = 0;
  for (const Layer& layer : image.layers) {
    for (const Eigen::Vector2d& p : control_points(layer, image.height).position) {
      if (point >= grid->GetNumberOfPoints()) refuse(path, "it lacks points");
      const double* const stored = grid->GetPoint(point++);
      if (stored[0] != p.x() || stored[1] != p.y()) {
        refuse(path, "its points were changed, and its patches not");
      }
    }
  }
  if (point != grid->GetNumberOfPoints()) refuse(path, "it has points that no patch has");
}

}  // namespace

VectorImage read_vtu(const fs::path& path) {
  const std::string content = content_of(path);
  if (content.find("<VTKFile") > 4096 || content.find("UnstructuredGrid") > 4096) {
    throw Error(ErrorCode::unsupported_format,
                "'" + path.string() + "' is no .vtu file; give one that Quadrille wrote");
  }
  check_claims(content, path);
  const auto grid = grid_of(content, path);
  VectorImage image = restore_state(grid, path.string());
  check_points(image, grid, path);
  return image;
}

}  // namespace quadrille

#include "vtk_whole_file.h"

#include <fstream>
#include <iterator>

#include "quadrille/error.h"

namespace quadrille {

std::string read_whole(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorCode::io_failure, "cannot read '" + path.string() + "': " + why);
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) refuse("there is no such file; check the path");
  if (std::filesystem::is_directory(status)) refuse("it is a folder; name a file in it");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse("it cannot be opened; check its permissions");
  std::string content{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) refuse("it ends too early; try again");
  return content;
}

}  // namespace quadrille

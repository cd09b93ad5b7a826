#include "vtk_whole_file.h"

#include <fstream>
#include <iterator>

#include "quadrille/error.h"

namespace quadrille {

std::string read_whole(const std::filesystem::path& path, std::uintmax_t most_bytes) {
  const auto refuse = [&](const std::string& why, ErrorCode code = ErrorCode::io_failure) {
    throw Error(code, "cannot read '" + path.string() + "': " + why);
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::status_known(status)) refuse(error.message() + "; check the path");
  if (!std::filesystem::exists(status)) refuse("there is no such file; check the path");
  if (std::filesystem::is_directory(status)) refuse("it is a folder; name a file in it");
  // Pipes and devices may keep us waiting, or never end.
  if (!std::filesystem::is_regular_file(status)) refuse("it is no regular file; name one");
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (!error && bytes > most_bytes) {
    refuse("it has " + std::to_string(bytes) + " bytes, more than " + std::to_string(most_bytes) +
               "; use an intact copy",
           ErrorCode::limit_exceeded);
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse("it cannot be opened; check its permissions");
  std::string content{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) refuse("it ends too early; try again");
  return content;
}

}  // namespace quadrille

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quadrille::bench {

/// Which pictures of a folder to run.
struct PictureChoice {
  std::string only;  ///< part of the file's name
  int limit = 0;     ///< at most this many of a folder; 0 for all
};

/// The PNG and JPEG files of the folder, by name.
std::vector<std::filesystem::path> pictures_in(const std::filesystem::path& folder,
                                               const PictureChoice& choice);

/// The folders named, or else the samples and the research pictures, which the environment variable
/// QUADRILLE_RESEARCH or the folder shared beside the sources holds. Those that do not exist are
/// left out with a line on standard output.
std::vector<std::filesystem::path> picture_folders(const std::vector<std::string>& named);

}  // namespace quadrille::bench

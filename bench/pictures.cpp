#include "pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

namespace quadrille::bench {

namespace fs = std::filesystem;

std::vector<fs::path> pictures_in(const fs::path& folder, const PictureChoice& choice) {
  std::vector<fs::path> pictures;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".png" && ending != ".jpg") continue;
    if (entry.path().filename().string().find(choice.only) == std::string::npos) continue;
    pictures.push_back(entry.path());
  }
  std::ranges::sort(pictures);
  if (choice.limit > 0 && pictures.size() > static_cast<std::size_t>(choice.limit)) {
    pictures.resize(choice.limit);
  }
  return pictures;
}

std::vector<fs::path> picture_folders(const std::vector<std::string>& named) {
  std::vector<fs::path> folders(named.begin(), named.end());
  if (folders.empty()) {
    const fs::path root = QUADRILLE_SOURCE_DIR;
    const char* elsewhere = std::getenv("QUADRILLE_RESEARCH");
    const fs::path research = elsewhere ? fs::path(elsewhere) : root / "../shared/research";
    folders = {root / "samples/pictures", (research / "bsds500").lexically_normal()};
  }
  std::erase_if(folders, [](const fs::path& folder) {
    if (fs::is_directory(folder)) return false;
    fmt::print(
        "{}: no such folder, skipped; QUADRILLE_RESEARCH names the folder that holds bsds500\n",
        folder.string());
    return true;
  });
  return folders;
}

}  // namespace quadrille::bench

#include "quadrille/export.h"
#include "vtk_array_file.h"
#include "vtk_points.h"
#include "vtk_state.h"

namespace quadrille {
namespace {

/// The cells must be the patches that the state describes, or another program changed them.
void check_points(const VectorImage& image, const VtkArrayFile& file) {
  const auto stored = file.points<std::array<double, 3>>();
  std::size_t point = 0;
  for (const Layer& layer : image.layers) {
    for (const Eigen::Vector2d& p : control_points(layer, image.height).position) {
      if (point >= stored.size()) file.refuse("it lacks points");
      const auto& at = stored[point++];
      if (at[0] != p.x() || at[1] != p.y()) {
        file.refuse("its points were changed, and its patches not");
      }
    }
  }
  if (point != stored.size()) file.refuse("it has points that no patch has");
}

}  // namespace

VectorImage read_vtu(const std::filesystem::path& path) {
  const VtkArrayFile file(path);
  VectorImage image = restore_state(file);
  check_points(image, file);
  return image;
}

}  // namespace quadrille

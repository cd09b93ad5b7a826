// The steps of vectorize() one by one: the mesh, then its colours by each way of estimating them,
// and how far each is from the picture.
//   stage_by_stage picture.jpg
#include <cstdio>
#include <utility>

#include "quadrille/error.h"
#include "quadrille/fit.h"
#include "quadrille/image_file.h"
#include "quadrille/metrics.h"
#include "quadrille/preset.h"
#include "quadrille/render.h"

namespace {

/// A picture of one layer that shows the patches.
quadrille::VectorImage image_of(const quadrille::Raster& picture, quadrille::PatchMesh patches) {
  quadrille::VectorImage image;
  image.width = picture.width;
  image.height = picture.height;
  image.layers.emplace_back().patches = std::move(patches);
  return image;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: stage_by_stage PICTURE\n");
    return 2;
  }
  try {
    const quadrille::Raster picture = quadrille::load_image(argv[1]);

    quadrille::VectorizeOptions options;
    const quadrille::Preset& preset = quadrille::choose_preset(picture);
    quadrille::apply(preset, picture, options);
    std::printf("preset %s: %d quads wished\n", preset.name.c_str(), options.quads);

    quadrille::Quadrangulation quads = quadrille::quadrangulate(picture, options);
    std::printf("%d quads, %zu singularities\n", quads.mesh.quad_count(),
                quadrille::singularities(quads.cross).size());

    // Geometry and first colours in one step; fit_colors() estimates them anew on the same patches.
    quadrille::PatchMesh patches = quadrille::fit_patches(std::move(quads.mesh), picture);
    for (const auto& [name, method] : {std::pair{"bessel", quadrille::FitMethod::bessel},
                                       std::pair{"hermite", quadrille::FitMethod::hermite}}) {
      const quadrille::FitReport fit = quadrille::fit_colors(patches, picture, {.method = method});
      const quadrille::VectorImage image = image_of(picture, patches);
      const quadrille::ImageDifference difference =
          quadrille::compare(picture, quadrille::render(image));
      std::printf("%-8s MAE %5.2f, PSNR %5.2f dB after %d iterations\n", name, difference.mae,
                  difference.psnr, fit.iterations);
    }
  } catch (const quadrille::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

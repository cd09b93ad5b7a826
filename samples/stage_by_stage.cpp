// The main steps of vectorize() one by one: a mesh, its colours by each way of estimating them, the
// mesh once more where they err, tears and moved vertices, and how far each is from the picture.
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

/// Draws the patches, prints how far they are from the picture, and returns the drawing.
quadrille::Raster judge(const char* step, const quadrille::Raster& picture,
                        const quadrille::PatchMesh& patches) {
  const quadrille::Raster drawn =
      quadrille::render(quadrille::single_layer(patches, picture.width, picture.height));
  const quadrille::ImageDifference difference = quadrille::compare(picture, drawn);
  std::printf("%-10s %5d quads, MAE %5.2f, PSNR %5.2f dB\n", step, patches.patch_count(),
              difference.mae, difference.psnr);
  return drawn;
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
    quadrille::PatchMesh patches = quadrille::fit_patches(quads.mesh, picture);
    quadrille::Raster drawn;
    for (const auto& [name, method] : {std::pair{"bessel", quadrille::FitMethod::bessel},
                                       std::pair{"bessel-ls", quadrille::FitMethod::bessel_ls},
                                       std::pair{"hermite", quadrille::FitMethod::hermite}}) {
      quadrille::fit_colors(patches, picture, {.method = method});
      drawn = judge(name, picture, patches);
    }

    // The mesh once more, where the fit errs, along the picture's sharp edges.
    quadrille::refine_by_error(quads, picture, drawn, options);
    const auto chains = quadrille::feature_edge_chains(quads.mesh);
    const auto torn =
        quadrille::judge_tears(quads.mesh, chains, picture, options.fit, options.tears);
    for (std::size_t c = 0; c < chains.size(); ++c) {
      for (const int edge : chains[c]) {
        if (torn[c]) quads.mesh.edge_flags[edge] |= quadrille::kTearEdge;
      }
    }
    patches = quadrille::fit_patches(quads.mesh, picture);
    judge("refined", picture, patches);
    quadrille::optimize_vertices(patches, picture);
    judge("optimised", picture, patches);
  } catch (const quadrille::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

// Finds the number of quads that a picture takes for a wished error, and saves the document.
//   vectorize_to_error picture.jpg 6 picture.quad
#include <cstdio>
#include <cstdlib>

#include "quadrille/document.h"
#include "quadrille/error.h"
#include "quadrille/error_bound.h"
#include "quadrille/image_file.h"

int main(int argc, char** argv) {
  char* end = nullptr;
  const double wished = argc == 4 ? std::strtod(argv[2], &end) : 0;
  if (argc != 4 || end == argv[2] || *end != '\0') {
    std::fprintf(stderr, "usage: vectorize_to_error PICTURE ERROR OUT.quad\n");
    return 2;
  }
  try {
    const quadrille::Raster picture = quadrille::load_image(argv[1]);

    quadrille::ErrorBound bound;
    bound.mae = wished;
    bound.max_quads = 20'000;
    const quadrille::BoundedVectorization bounded = quadrille::vectorize_to_error(picture, bound);
    for (const quadrille::ErrorBoundRound& round : bounded.rounds) {
      std::printf("%6d quads: MAE %.4g\n", round.quads, round.mae);
    }
    if (!bounded.met) std::printf("the bound is out of reach with %d quads\n", bound.max_quads);
    quadrille::save_document(bounded.result.image, argv[3],
                             {.error = quadrille::document_error(bounded.mae)});
  } catch (const quadrille::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

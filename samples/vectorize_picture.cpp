// Turns a picture into patches, draws it at four times the size, and writes a second format.
//   vectorize_picture picture.jpg large.png picture.svg
#include <cstdio>

#include "quadrille/error.h"
#include "quadrille/export.h"
#include "quadrille/image_file.h"
#include "quadrille/raster_file.h"
#include "quadrille/render.h"
#include "quadrille/vectorize.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: vectorize_picture PICTURE LARGE.png OUT.svg\n");
    return 2;
  }
  try {
    const quadrille::Raster picture = quadrille::load_image(argv[1]);

    quadrille::VectorizeOptions options;
    options.quads = 1000;
    const auto [image, report] = quadrille::vectorize(picture, options);
    std::printf("%d quads, %d irregular vertices\n", report.quads, report.irregular_vertices);

    quadrille::RenderOptions four_times;
    four_times.scale = 4;
    quadrille::save_raster(quadrille::render(image, four_times), argv[2]);
    quadrille::export_image(image, argv[3]);
  } catch (const quadrille::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

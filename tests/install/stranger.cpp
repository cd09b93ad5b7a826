#include <cstdio>

#include "quadrille/export.h"
#include "quadrille/render.h"
#include "quadrille/vectorize.h"

// A ramp from black to red comes back as the ramp.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  quadrille::Raster ramp(64, 48, 3);
  for (int y = 0; y < ramp.height; ++y) {
    for (int x = 0; x < ramp.width; ++x) ramp.pixel(x, y)[0] = (x + 0.5f) / ramp.width;
  }
  quadrille::VectorizeOptions options;
  options.quads = 48;
  const auto [image, report] = quadrille::vectorize(ramp, options);
  quadrille::export_image(image, argv[1]);
  const float middle = quadrille::render(image).pixel(32, 24)[0];
  std::printf("%d quads, middle %.3f\n", report.quads, middle);
  return middle > 0.49f && middle < 0.53f ? 0 : 1;
}

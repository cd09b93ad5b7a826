#pragma once

#include <cairo.h>

#include <memory>

#include "quadrille/render.h"

namespace quadrille::bench {

/// The picture's patches as a Cairo mesh pattern, which interpolates corner colours bilinearly, and
/// a surface of 8-bit pixels to paint it on.
class CairoMesh {
 public:
  /// Every patch is split into divisions x divisions parts. `scale` is output over picture pixels;
  /// the region is in output pixels.
  CairoMesh(const VectorImage& image, double scale, const PixelRegion& region, int divisions);

  void paint();

 private:
  template <auto destroy>
  struct Destroyer {
    template <class T>
    void operator()(T* object) const {
      destroy(object);
    }
  };
  std::unique_ptr<cairo_pattern_t, Destroyer<cairo_pattern_destroy>> pattern_;
  std::unique_ptr<cairo_surface_t, Destroyer<cairo_surface_destroy>> surface_;
};

}  // namespace quadrille::bench

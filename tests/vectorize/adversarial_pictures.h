#pragma once

#include <random>
#include <span>
#include <string>

#include "quadrille/raster.h"

namespace quadrille::test {

/// Draws a picture of about the size asked for; the same for the same state of the generator.
using PictureDrawer = Raster (*)(std::mt19937& random, int width, int height);

struct PictureFamily {
  std::string name;
  PictureDrawer draw;
};

/// Pictures that a quadrangulation may stumble over: textures near the pixel grid's limits, fields
/// full of singularities, degenerate sizes, contrast from none to all, every kind of alpha.
std::span<const PictureFamily> adversarial_families();

/// A number in [low, high] whose logarithm is uniform.
int log_uniform(std::mt19937& random, int low, int high);

}  // namespace quadrille::test

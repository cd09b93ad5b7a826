#pragma once

#include "quadrille/raster.h"

class vtkRenderWindow;

namespace quadrille::viewer {

/// What a window shows after Render(), RGB.
Raster window_pixels(vtkRenderWindow* window);

}  // namespace quadrille::viewer

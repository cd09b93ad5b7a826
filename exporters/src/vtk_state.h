#pragma once

#include <string>

#include "quadrille/vector_image.h"

class vtkUnstructuredGrid;

namespace quadrille {

/// Adds what takes the patches back bit for bit, as documented at read_vtu(). Throws
/// Error{invalid_argument} for texts with zero bytes.
void store_state(const VectorImage& image, vtkUnstructuredGrid* grid);

/// The image whose state the grid holds. Throws Error{unsupported_format} for a grid without it and
/// Error{io_failure}, naming the file, for one that contradicts itself.
VectorImage restore_state(vtkUnstructuredGrid* grid, const std::string& name);

}  // namespace quadrille

#pragma once

#include "quadrille/vector_image.h"
#include "vtk_array_file.h"

class vtkUnstructuredGrid;

namespace quadrille {

/// Adds what takes the patches back bit for bit, as documented at read_vtu(). Throws
/// Error{invalid_argument} for texts with zero bytes.
void store_state(const VectorImage& image, vtkUnstructuredGrid* grid);

/// The image whose state the file holds. Throws Error{unsupported_format} for a file without it and
/// Error{io_failure} for one that contradicts itself.
VectorImage restore_state(const VtkArrayFile& file);

}  // namespace quadrille

#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <vector>

#include "quadrille/run_context.h"
#include "quadrille/vector_image.h"

namespace quadrille {

/// The patches as VTK's Bezier quadrilaterals with the arrays that write_vtu() documents.
/// `errors` is empty or has a value per patch, layer after layer; throws Error{invalid_argument}
/// for another number of them.
vtkSmartPointer<vtkUnstructuredGrid> patch_grid(const VectorImage& image,
                                                const std::vector<float>& errors,
                                                const RunContext& context);

}  // namespace quadrille

#pragma once

#include <vtkDataSet.h>
#include <vtkSmartPointer.h>

#include "quadrille/run_context.h"
#include "quadrille/scene_layer.h"

namespace quadrille {

/// A layer as VTK's data: points, lines and polygons as poly data, grids as image data with values
/// per cell, patches as an unstructured grid. y up, the picture's bottom left corner at the origin.
/// Field data: "summary" and, of all but patches, "style" as "key value" lines.
vtkSmartPointer<vtkDataSet> scene_data(const SceneLayer& layer, double picture_height,
                                       const RunContext& context);

}  // namespace quadrille

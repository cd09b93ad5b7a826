#pragma once

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include "quadrille/scene_layer.h"
#include "view.h"

namespace quadrille::viewer {

/// The actor that shows a layer of shapes as its style says, at the frame's place: world
/// coordinates are window pixels, y up. What lies more than `margin` pixels outside of the window
/// is left out.
vtkSmartPointer<vtkActor> make_shape_actor(const SceneShapes& shapes, const SceneStyle& style,
                                           const Frame& frame, int margin);

}  // namespace quadrille::viewer

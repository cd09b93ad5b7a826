#pragma once

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <string>

#include "panel_layout.h"
#include "session.h"
#include "subject.h"

namespace quadrille::viewer {

/// The list of layers with their keys, states and what they lack; one line each.
std::string layer_table(const Session& session, const SubjectLayers& layers);

/// Zoom and point of view, one line.
std::string view_line(const Session& session);

/// The texts over the scene.
class Panels {
 public:
  explicit Panels(vtkRenderer* renderer);

  using Texts = ForEachPanel<std::string>;
  /// Shows the texts that are not empty, around the sliders' box (window pixels, y up; may be
  /// empty); see lay_out_panels().
  void update(const Texts& texts, const Eigen::Array2i& window, const Eigen::AlignedBox2d& sliders);

 private:
  vtkRenderer* renderer_;
  ForEachPanel<vtkSmartPointer<vtkTextActor>> actors_;
};

}  // namespace quadrille::viewer

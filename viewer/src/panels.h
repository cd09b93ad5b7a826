#pragma once

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <string>

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

  struct Texts {
    std::string layers, numbers, status, help;  ///< empty ones are not shown
  };
  void update(const Texts& texts, const Eigen::Array2i& window);

 private:
  vtkSmartPointer<vtkTextActor> layers_, numbers_, status_, help_;
};

}  // namespace quadrille::viewer

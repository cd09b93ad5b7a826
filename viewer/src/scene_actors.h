#pragma once

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "pixel_actor.h"
#include "quadrille/renderer.h"
#include "session.h"
#include "subject.h"

namespace quadrille::viewer {

/// Shows a session in a renderer: every layer of the scene as actors, made when first shown and
/// again when the view has moved on. World coordinates are window pixels, y up, so that single
/// precision suffices at any zoom.
class SceneActors {
 public:
  explicit SceneActors(vtkRenderer* renderer, RunContext context = {});
  ~SceneActors();

  /// Another subject, or null; what was made for the one before is dropped.
  void set_subject(SubjectLayers* layers);
  /// Brings the renderer's actors up to date.
  void update(const Session& session);

 private:
  struct ShapeActors {
    std::vector<vtkSmartPointer<vtkActor>> actors;
    Frame frame;  ///< they were made for
  };

  /// The actors of a session in drawing order.
  void collect(const Session& session);
  void aim_camera(const Frame& frame);
  void add_paper(const Session& session, const Frame& frame);
  void add_layer(LayerId id, const Session& session, const Frame& frame);
  void add_pixels(LayerId id, const SceneLayer& layer, const Session& session, const Frame& frame);
  void add_shapes(std::optional<ShapeActors>& made, const std::vector<SceneLayer>& layers,
                  const Frame& frame, double opacity);
  void add_picked(const Session& session, const Frame& frame);
  void add_divider(const Session& session, const Frame& frame);
  RegionCache::Draw drawer(const SceneLayer& layer, const Frame& frame);

  vtkSmartPointer<vtkRenderer> renderer_;
  RunContext context_;
  SubjectLayers* layers_ = nullptr;
  std::optional<Renderer> picture_;
  std::vector<vtkSmartPointer<vtkProp>> wanted_, shown_;
  PixelActor paper_;
  std::array<PixelActor, kLayerCount> pixels_;
  std::array<std::optional<ShapeActors>, kLayerCount> shapes_;
};

}  // namespace quadrille::viewer

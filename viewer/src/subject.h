#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "layer_list.h"
#include "quadrille/raster.h"
#include "quadrille/run_context.h"
#include "quadrille/scene_layer.h"
#include "quadrille/vectorize.h"
#include "view.h"

namespace quadrille::viewer {

/// What is looked at; any of them may be missing, but not both the image and the source.
struct Subject {
  std::shared_ptr<const VectorImage> image;
  std::shared_ptr<const Raster> source;
  std::shared_ptr<const Quadrangulation> stages;

  /// Pixels.
  Eigen::Array2d size() const;
};

/// The layers of a subject, made when first asked for. Those that depend on the view (curves as
/// polylines, crosses at a readable distance) are made anew when it changes.
class SubjectLayers {
 public:
  explicit SubjectLayers(Subject subject, RunContext context = {});

  const Subject& subject() const { return subject_; }

  /// What a layer lacks, a few words; empty when it can be shown.
  std::string missing(LayerId id) const;
  /// True when only the stages are lacking, which a source can be given.
  bool awaits_stages(LayerId id) const;

  /// The layers to draw, empty when something is missing. What lies more than `margin` pixels
  /// outside of the window may be left out. "picture" gives the patches themselves.
  const std::vector<SceneLayer>& layers(LayerId id, const Frame& frame, int margin);
  /// Fitting errors per patch; empty without a source.
  const std::vector<float>& errors();

 private:
  std::vector<SceneLayer> make(LayerId id, const Frame& frame, int margin);
  std::vector<SceneLayer> stage(const char* name, const Frame& frame) const;

  struct Made {
    std::vector<SceneLayer> layers;
    std::optional<Frame> frame;  ///< it was made for; absent when it serves any
  };
  Subject subject_;
  RunContext context_;
  std::array<std::optional<Made>, kLayerCount> made_;
  std::optional<std::vector<float>> errors_;
};

}  // namespace quadrille::viewer

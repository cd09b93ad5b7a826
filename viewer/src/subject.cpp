#include "subject.h"

#include <algorithm>
#include <utility>

#include "quadrille/picture_layers.h"
#include "quadrille/render.h"
#include "quadrille/stage_layers.h"

namespace quadrille::viewer {
namespace {

constexpr double kCurveTolerance = 0.2;  // window pixels

bool needs_image(LayerId id) {
  return id != LayerId::source && id != LayerId::scales && id != LayerId::cross_field &&
         id != LayerId::singularities;
}

bool needs_source(LayerId id) { return id == LayerId::source || id == LayerId::error; }

const char* stage_of(LayerId id) {
  switch (id) {
    case LayerId::scales:
      return "scale";
    case LayerId::cross_field:
    case LayerId::singularities:
      return "cross-field";
    default:
      return nullptr;
  }
}

const SceneStage& stage_named(const std::string& name) {
  return *std::ranges::find_if(scene_stages(),
                               [&](const SceneStage& stage) { return stage.name == name; });
}

bool depends_on_view(LayerId id) {
  return id == LayerId::patches || id == LayerId::tears || stage_of(id) != nullptr;
}

/// A picture in another frame of the same scale that shows nothing new.
bool serves(const Frame& made, const Frame& frame, int margin, bool whole_picture) {
  if ((made.scale != frame.scale).any()) return false;
  return whole_picture || ((made.window == frame.window).all() &&
                           (made.origin - frame.origin).abs().maxCoeff() <= margin / 2);
}

}  // namespace

Eigen::Array2d Subject::size() const {
  if (image) return {image->width, image->height};
  return {source->width, source->height};
}

SubjectLayers::SubjectLayers(Subject subject, RunContext context)
    : subject_(std::move(subject)), context_(std::move(context)) {}

std::string SubjectLayers::missing(LayerId id) const {
  if (needs_source(id) && !subject_.source) return "needs a source";
  if (needs_image(id)) return subject_.image ? "" : "not vectorized yet";
  const char* stage = stage_of(id);
  if (!stage) return "";
  if (!subject_.stages) return subject_.source ? "computed when shown" : "needs a source";
  return can_show(stage_named(stage), *subject_.stages) ? "" : "a plain lattice has none";
}

bool SubjectLayers::awaits_stages(LayerId id) const {
  return stage_of(id) && subject_.source && !subject_.stages;
}

const std::vector<SceneLayer>& SubjectLayers::layers(LayerId id, const Frame& frame, int margin) {
  std::optional<Made>& made = made_[static_cast<int>(id)];
  if (!made || (made->frame && !serves(*made->frame, frame, margin, stage_of(id) != nullptr))) {
    made = {make(id, frame, margin), std::nullopt};
    if (depends_on_view(id)) made->frame = frame;
  }
  return made->layers;
}

const std::vector<float>& SubjectLayers::errors() {
  if (!errors_) {
    errors_.emplace();
    if (missing(LayerId::error).empty()) {
      const auto& layers = this->layers(LayerId::error, {}, 0);
      *errors_ = patch_errors(*subject_.image, std::get<SceneGrid>(layers.front().content));
    }
  }
  return *errors_;
}

std::vector<SceneLayer> SubjectLayers::stage(const char* name, const Frame& frame) const {
  return stage_named(name).layers(*subject_.stages, 1 / frame.zoom);
}

std::vector<SceneLayer> SubjectLayers::make(LayerId id, const Frame& frame, int margin) {
  if (!missing(id).empty()) return {};
  const SceneWindow window{frame.visible_box(margin), kCurveTolerance / frame.scale.maxCoeff()};
  switch (id) {
    case LayerId::source:
      return {raster_layer(*subject_.source)};
    case LayerId::picture:
      return {patch_layer(subject_.image)};
    case LayerId::error:
      return {error_layer(*subject_.source, render(*subject_.image, {}, context_))};
    case LayerId::control_net:
      return {control_net_layer(*subject_.image)};
    case LayerId::patches:
      return {edge_layer(*subject_.image, window)};
    case LayerId::tears:
      return {tear_layer(*subject_.image, window)};
    case LayerId::irregular_vertices:
      return {irregular_vertex_layer(*subject_.image)};
    case LayerId::scales:
      return stage("scale", frame);
    case LayerId::cross_field:
    case LayerId::singularities: {
      std::vector<SceneLayer> layers = stage("cross-field", frame);
      std::erase_if(layers, [&](const SceneLayer& layer) {
        return (layer.name == "cross-field") != (id == LayerId::cross_field);
      });
      return layers;
    }
  }
  return {};
}

}  // namespace quadrille::viewer

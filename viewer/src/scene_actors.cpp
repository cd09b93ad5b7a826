#include "scene_actors.h"

#include <vtkCamera.h>
#include <vtkProperty.h>

#include <algorithm>
#include <utility>

#include "grid_pixels.h"
#include "shape_actor.h"

namespace quadrille::viewer {
namespace {

constexpr int kMargin = 256;    // window pixels around the window that shapes are made for
constexpr double kDesk = 0.25;  // gray around the picture

/// White, or a checkerboard behind pictures with transparency; squares keep to the output's pixels.
RegionCache::Draw draw_paper(bool checkered) {
  return [checkered](const PixelRegion& region, std::uint8_t* pixels, std::ptrdiff_t row_bytes) {
    constexpr int kSquare = 8;
    for (int y = 0; y < region.height; ++y) {
      std::uint8_t* out = pixels + y * row_bytes;
      for (int x = 0; x < region.width; ++x, out += 4) {
        const bool dark = checkered && ((region.x + x) / kSquare + (region.y + y) / kSquare) % 2;
        std::fill_n(out, 3, static_cast<std::uint8_t>(dark ? 204 : 255));
        out[3] = 255;
      }
    }
  };
}

SceneShapes vertical_line(double x, double height) {
  SceneShapes shapes;
  shapes.cell = SceneShapes::Cell::line;
  shapes.points = {{x, 0}, {x, height}};
  shapes.cell_points = {0, 1};
  shapes.end_cell();
  return shapes;
}

bool is_opaque(const Subject& subject) {
  return subject.image ? subject.image->opaque() : !subject.source->has_alpha();
}

/// The compare slider shows the source on its left and the picture on its right.
bool is_compared(LayerId id) { return id == LayerId::source || id == LayerId::picture; }

/// Nothing else to see without these.
bool shown(LayerId id, const Session& session, const Subject& subject) {
  if (session.layers.shown(id)) return true;
  if (session.comparing && subject.source && is_compared(id)) return true;
  return id == LayerId::source && !subject.image;
}

}  // namespace

SceneActors::SceneActors(vtkRenderer* renderer, RunContext context)
    : renderer_(renderer), context_(std::move(context)) {
  renderer_->SetBackground(kDesk, kDesk, kDesk);
  renderer_->GetActiveCamera()->ParallelProjectionOn();
}

SceneActors::~SceneActors() = default;

void SceneActors::set_subject(SubjectLayers* layers) {
  layers_ = layers;
  picture_.reset();
  paper_.forget();
  for (PixelActor& pixels : pixels_) pixels.forget();
  shapes_.fill(std::nullopt);
  if (layers && layers->subject().image) picture_.emplace(*layers->subject().image);
}

void SceneActors::update(const Session& session) {
  wanted_.clear();
  if (layers_) collect(session);
  if (wanted_ == shown_) return;
  // Only then, because this frees what the graphics card holds of them.
  renderer_->RemoveAllViewProps();
  for (const auto& prop : wanted_) renderer_->AddViewProp(prop);
  shown_ = wanted_;
}

void SceneActors::collect(const Session& session) {
  const Frame frame = session.view.frame();
  aim_camera(frame);
  add_paper(session, frame);
  for (const LayerInfo& info : layer_infos()) {
    if (shown(info.id, session, layers_->subject())) add_layer(info.id, session, frame);
  }
  add_picked(session, frame);
  if (session.comparing) add_divider(session, frame);
}

void SceneActors::aim_camera(const Frame& frame) {
  vtkCamera* camera = renderer_->GetActiveCamera();
  const double x = frame.window.x() / 2.0, y = frame.window.y() / 2.0;
  camera->SetFocalPoint(x, y, 0);
  camera->SetPosition(x, y, 1);
  camera->SetViewUp(0, 1, 0);
  camera->SetParallelScale(y);
  camera->SetClippingRange(0.5, 1.5);
}

void SceneActors::add_paper(const Session& session, const Frame& frame) {
  const bool opaque = is_opaque(layers_->subject());
  const bool hidden = opaque && layers_->subject().image &&
                      session.layers.shown(LayerId::picture) &&
                      session.layers.opacity(LayerId::picture) == 1 && !session.comparing;
  if (hidden || !paper_.place(frame, draw_paper(!opaque), 0, frame.window.x())) return;
  wanted_.emplace_back(paper_.actor());
}

void SceneActors::add_layer(LayerId id, const Session& session, const Frame& frame) {
  const std::vector<SceneLayer>& layers = layers_->layers(id, frame, kMargin);
  for (const SceneLayer& layer : layers) {
    if (!std::holds_alternative<SceneShapes>(layer.content)) add_pixels(id, layer, session, frame);
  }
  add_shapes(shapes_[static_cast<int>(id)], layers, frame, session.layers.opacity(id));
}

void SceneActors::add_pixels(LayerId id, const SceneLayer& layer, const Session& session,
                             const Frame& frame) {
  int first = 0, last = frame.window.x();
  if (session.comparing && layers_->subject().source && is_compared(id)) {
    (id == LayerId::source ? last : first) = session.divider_column();
  }
  PixelActor& pixels = pixels_[static_cast<int>(id)];
  if (!pixels.place(frame, drawer(layer, frame), first, last)) return;
  pixels.set_opacity(session.layers.opacity(id));
  wanted_.emplace_back(pixels.actor());
}

RegionCache::Draw SceneActors::drawer(const SceneLayer& layer, const Frame& frame) {
  if (const auto* grid = std::get_if<SceneGrid>(&layer.content)) {
    return [&style = layer.style, grid, scale = frame.scale](
               const PixelRegion& region, std::uint8_t* pixels, std::ptrdiff_t row_bytes) {
      draw_grid(*grid, style, scale, region, pixels, row_bytes);
    };
  }
  return [this, zoom = frame.zoom](const PixelRegion& region, std::uint8_t* pixels,
                                   std::ptrdiff_t row_bytes) {
    RenderOptions options;
    options.scale = zoom;
    options.region = region;
    picture_->draw(options, {}, {pixels, row_bytes}, context_);
  };
}

void SceneActors::add_shapes(std::optional<ShapeActors>& made,
                             const std::vector<SceneLayer>& layers, const Frame& frame,
                             double opacity) {
  const auto moved = [&] { return Eigen::Array2i(frame.origin - made->frame.origin); };
  const bool serves = made && (made->frame.scale == frame.scale).all() &&
                      (made->frame.window == frame.window).all() &&
                      moved().abs().maxCoeff() <= kMargin / 2;
  if (!serves) {
    made = {{}, frame};
    for (const SceneLayer& layer : layers) {
      const auto* shapes = std::get_if<SceneShapes>(&layer.content);
      if (shapes) made->actors.push_back(make_shape_actor(*shapes, layer.style, frame, kMargin));
    }
  }
  for (const auto& actor : made->actors) {
    actor->SetPosition(moved().x(), -moved().y(), 0);
    actor->GetProperty()->SetOpacity(opacity);
    wanted_.emplace_back(actor);
  }
}

void SceneActors::add_picked(const Session& session, const Frame& frame) {
  const auto& image = layers_->subject().image;
  if (!session.picked || !image) return;
  const SceneWindow window{frame.visible_box(kMargin), 0.1 / frame.scale.maxCoeff()};
  std::optional<ShapeActors> actors;
  add_shapes(actors, {picked_layer(*image, *session.picked, window)}, frame, 1);
}

void SceneActors::add_divider(const Session& session, const Frame& frame) {
  const double x = session.divider_column();
  Frame window_pixels;
  window_pixels.window = frame.window;
  for (const auto& [ink, width] : {std::pair<Ink, double>{kDark, 3}, {{255, 255, 255}, 1}}) {
    SceneStyle style;
    style.ink = ink;
    style.width = width;
    wanted_.emplace_back(
        make_shape_actor(vertical_line(x, frame.window.y()), style, window_pixels, 0));
  }
}

}  // namespace quadrille::viewer

#include "panels.h"

#include <fmt/core.h>
#include <vtkTextProperty.h>

namespace quadrille::viewer {
namespace {

constexpr int kFontSize = 14, kGap = 10;  // window pixels

enum class Anchor { top, middle, bottom };

vtkSmartPointer<vtkTextActor> text_actor(Anchor anchor) {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  vtkTextProperty* style = actor->GetTextProperty();
  style->SetFontFamilyToCourier();
  style->SetFontSize(kFontSize);
  style->SetBold(true);
  style->SetColor(1, 1, 1);
  style->SetBackgroundColor(0, 0, 0);
  style->SetBackgroundOpacity(0.65);
  switch (anchor) {
    case Anchor::top:
      style->SetVerticalJustificationToTop();
      break;
    case Anchor::middle:
      style->SetVerticalJustificationToCentered();
      break;
    case Anchor::bottom:
      style->SetVerticalJustificationToBottom();
      break;
  }
  return actor;
}

void set(vtkTextActor* actor, const std::string& text, const Eigen::Array2d& place) {
  actor->SetVisibility(!text.empty());
  actor->SetInput(text.c_str());
  actor->SetPosition(place.x(), place.y());
}

}  // namespace

std::string layer_table(const Session& session, const SubjectLayers& layers) {
  std::string text = "layers (h: help)";
  for (const LayerInfo& info : layer_infos()) {
    const bool selected = session.layers.selected() == info.id;
    text += fmt::format("\n{} {} [{}] {:<19}{:>4.0f} %", selected ? '>' : ' ', info.key,
                        session.layers.shown(info.id) ? 'x' : ' ', info.title,
                        100 * session.layers.opacity(info.id));
    if (const std::string lacking = layers.missing(info.id); !lacking.empty()) {
      text += " (" + lacking + ")";
    }
  }
  return text + fmt::format("\n  c [{}] compare with source", session.comparing ? 'x' : ' ');
}

std::string view_line(const Session& session) {
  const Eigen::Vector2d& center = session.view.center();
  return fmt::format("zoom {:.4g} at {:.1f}, {:.1f}", session.view.zoom(), center.x(), center.y());
}

Panels::Panels(vtkRenderer* renderer)
    : layers_(text_actor(Anchor::top)),
      numbers_(text_actor(Anchor::top)),
      status_(text_actor(Anchor::bottom)),
      help_(text_actor(Anchor::middle)) {
  numbers_->GetTextProperty()->SetJustificationToRight();
  help_->GetTextProperty()->SetJustificationToCentered();
  for (vtkTextActor* actor : {layers_.Get(), numbers_.Get(), status_.Get(), help_.Get()}) {
    renderer->AddViewProp(actor);
  }
}

void Panels::update(const Texts& texts, const Eigen::Array2i& window) {
  const Eigen::Array2d size = window.cast<double>();
  set(layers_, texts.layers, {kGap, size.y() - kGap});
  set(numbers_, texts.numbers, {size.x() - kGap, size.y() - kGap});
  set(status_, texts.status, {kGap, kGap});
  set(help_, texts.help, size / 2);
}

}  // namespace quadrille::viewer

#include "panels.h"

#include <fmt/core.h>
#include <vtkTextProperty.h>

namespace quadrille::viewer {
namespace {

vtkSmartPointer<vtkTextActor> text_actor() {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  vtkTextProperty* style = actor->GetTextProperty();
  style->SetFontFamilyToCourier();
  style->SetBold(true);
  style->SetColor(1, 1, 1);
  style->SetBackgroundColor(0, 0, 0);
  style->SetBackgroundOpacity(0.65);
  return actor;
}

/// Sets the text and returns its size in window pixels, 0 without any.
Eigen::Array2d set(vtkTextActor* actor, const std::string& text, int font_size,
                   vtkRenderer* renderer) {
  if (text.empty()) return {0, 0};
  actor->GetTextProperty()->SetFontSize(font_size);
  actor->SetInput(text.c_str());
  Eigen::Array2d size;
  actor->GetSize(renderer, size.data());
  return size;
}

void place(vtkTextActor* actor, const Eigen::AlignedBox2d& box) {
  actor->SetVisibility(!box.isEmpty());
  if (!box.isEmpty()) actor->SetPosition(box.min().x(), box.min().y());
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
    : renderer_(renderer), actors_{text_actor(), text_actor(), text_actor(), text_actor()} {
  for (const auto& actor : {actors_.layers, actors_.numbers, actors_.status, actors_.help}) {
    renderer->AddViewProp(actor);
  }
}

void Panels::update(const Texts& texts, const Eigen::Array2i& window,
                    const Eigen::AlignedBox2d& sliders) {
  const Eigen::Array2d size = window.cast<double>();
  const int font = panel_font_size(size);
  const ForEachPanel<Eigen::Array2d> sizes = {set(actors_.layers, texts.layers, font, renderer_),
                                              set(actors_.numbers, texts.numbers, font, renderer_),
                                              set(actors_.status, texts.status, font, renderer_),
                                              set(actors_.help, texts.help, font, renderer_)};
  const ForEachPanel<Eigen::AlignedBox2d> boxes = lay_out_panels(sizes, size, sliders);
  place(actors_.layers, boxes.layers);
  place(actors_.numbers, boxes.numbers);
  place(actors_.status, boxes.status);
  place(actors_.help, boxes.help);
}

}  // namespace quadrille::viewer

#include "sliders.h"

#include <vtkCommand.h>
#include <vtkCoordinate.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkTextProperty.h>

#include <cmath>
#include <utility>

namespace quadrille::viewer {
namespace {

vtkSmartPointer<vtkSliderRepresentation2D> representation(const SliderRange& range,
                                                          const LogSlider::Place& place) {
  auto slider = vtkSmartPointer<vtkSliderRepresentation2D>::New();
  slider->SetMinimumValue(std::log10(range.low));
  slider->SetMaximumValue(std::log10(range.high));
  slider->GetPoint1Coordinate()->SetCoordinateSystemToNormalizedViewport();
  slider->GetPoint1Coordinate()->SetValue(place.left, place.height);
  slider->GetPoint2Coordinate()->SetCoordinateSystemToNormalizedViewport();
  slider->GetPoint2Coordinate()->SetValue(place.right, place.height);
  slider->SetSliderLength(0.015);
  slider->SetSliderWidth(0.03);
  slider->SetTubeWidth(0.006);
  slider->SetEndCapLength(0);
  slider->SetTitleHeight(0.025);
  slider->ShowSliderLabelOff();
  slider->GetTitleProperty()->SetFontFamilyToCourier();
  slider->GetTitleProperty()->ShadowOn();
  slider->GetTitleProperty()->ItalicOff();
  slider->GetSelectedProperty()->SetColor(1, 0.55, 0);
  return slider;
}

}  // namespace

LogSlider::LogSlider(vtkRenderWindowInteractor* interactor, vtkRenderer* renderer,
                     const SliderRange& range, const Place& place)
    : widget_(vtkSmartPointer<vtkSliderWidget>::New()) {
  widget_->SetInteractor(interactor);
  widget_->SetDefaultRenderer(renderer);
  widget_->SetRepresentation(representation(range, place));
  widget_->SetAnimationModeToJump();
  widget_->AddObserver(vtkCommand::InteractionEvent, this, &LogSlider::update_title);
  widget_->AddObserver(vtkCommand::EndInteractionEvent, this, &LogSlider::release);
}

void LogSlider::set_title(std::function<std::string(double)> title) {
  title_ = std::move(title);
  update_title();
}

void LogSlider::release() {
  update_title();
  if (act_) act_(value());
}

double LogSlider::value() const {
  return std::pow(10, widget_->GetSliderRepresentation()->GetValue());
}

void LogSlider::set_value(double value) {
  widget_->GetSliderRepresentation()->SetValue(std::log10(value));
  update_title();
}

void LogSlider::show(bool shown) {
  if (shown != static_cast<bool>(widget_->GetEnabled())) widget_->SetEnabled(shown);
}

void LogSlider::update_title() {
  if (!title_) return;
  widget_->GetSliderRepresentation()->SetTitleText(title_(value()).c_str());
}

vtkSmartPointer<vtkActor2D> make_slider_ground(const Eigen::AlignedBox2d& shares) {
  vtkNew<vtkPlaneSource> rectangle;
  rectangle->SetOrigin(shares.min().x(), shares.min().y(), 0);
  rectangle->SetPoint1(shares.max().x(), shares.min().y(), 0);
  rectangle->SetPoint2(shares.min().x(), shares.max().y(), 0);
  vtkNew<vtkCoordinate> coordinate;
  coordinate->SetCoordinateSystemToNormalizedViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputConnection(rectangle->GetOutputPort());
  mapper->SetTransformCoordinate(coordinate);
  auto ground = vtkSmartPointer<vtkActor2D>::New();
  ground->SetMapper(mapper);
  ground->GetProperty()->SetColor(0, 0, 0);
  ground->GetProperty()->SetOpacity(0.65);
  return ground;
}

}  // namespace quadrille::viewer

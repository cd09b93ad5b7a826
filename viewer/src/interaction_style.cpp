#include "interaction_style.h"

#include <vtkCallbackCommand.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>

namespace quadrille::viewer {

vtkStandardNewMacro(InteractionStyle);

Eigen::Array2i InteractionStyle::place() const {
  int x = 0, y = 0;
  Interactor->GetEventPosition(x, y);
  return {x, Interactor->GetSize()[1] - 1 - y};
}

void InteractionStyle::OnLeftButtonDown() {
  GrabFocus(EventCallbackCommand);
  gestures_->press(place());
}

void InteractionStyle::OnLeftButtonUp() {
  ReleaseFocus();
  gestures_->release(place());
}

void InteractionStyle::OnMouseMove() { gestures_->move(place()); }
void InteractionStyle::OnMouseWheelForward() { gestures_->wheel(place(), 1); }
void InteractionStyle::OnMouseWheelBackward() { gestures_->wheel(place(), -1); }

void InteractionStyle::OnKeyPress() {
  const char* name = Interactor->GetKeySym();
  if (name) gestures_->key(name);
}

void InteractionStyle::OnTimer() { gestures_->tick(); }

}  // namespace quadrille::viewer

#pragma once

#include <vtkInteractorStyle.h>

#include <Eigen/Core>
#include <string>

namespace quadrille::viewer {

/// What the mouse and the keyboard do, in window pixels with y down.
class Gestures {
 public:
  virtual ~Gestures() = default;
  virtual void press(const Eigen::Array2i& at) = 0;
  virtual void move(const Eigen::Array2i& at) = 0;
  virtual void release(const Eigen::Array2i& at) = 0;
  /// Notches, positive away from the user.
  virtual void wheel(const Eigen::Array2i& at, int notches) = 0;
  virtual void key(const std::string& name) = 0;
  virtual void tick() = 0;
};

/// Passes the interactor's events on; VTK's own keys and mouse modes do nothing.
class InteractionStyle : public vtkInteractorStyle {
 public:
  static InteractionStyle* New();
  vtkTypeMacro(InteractionStyle, vtkInteractorStyle);

  void set_gestures(Gestures* gestures) { gestures_ = gestures; }

  void OnLeftButtonDown() override;
  void OnLeftButtonUp() override;
  void OnMiddleButtonDown() override { OnLeftButtonDown(); }
  void OnMiddleButtonUp() override { OnLeftButtonUp(); }
  void OnMouseMove() override;
  void OnMouseWheelForward() override;
  void OnMouseWheelBackward() override;
  void OnKeyPress() override;
  void OnTimer() override;
  void OnChar() override {}
  void OnRightButtonDown() override {}
  void OnRightButtonUp() override {}
  void OnKeyDown() override {}
  void OnKeyUp() override {}
  void OnKeyRelease() override {}

 private:
  Eigen::Array2i place() const;

  Gestures* gestures_ = nullptr;
};

}  // namespace quadrille::viewer

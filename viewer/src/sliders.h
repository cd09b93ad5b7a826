#pragma once

#include <vtkActor2D.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSliderWidget.h>
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <functional>
#include <string>

namespace quadrille::viewer {

/// A value between two others, in equal steps of its logarithm.
struct SliderRange {
  double low = 1, high = 10;
};

/// A slider for a number above 0, in equal steps of its logarithm.
class LogSlider {
 public:
  struct Place {
    double left = 0, right = 1, height = 0;  ///< shares of the window, height from its bottom
  };
  LogSlider(vtkRenderWindowInteractor* interactor, vtkRenderer* renderer, const SliderRange& range,
            const Place& place);
  LogSlider(const LogSlider&) = delete;
  LogSlider& operator=(const LogSlider&) = delete;

  /// `title` gives the text for a value.
  void set_title(std::function<std::string(double)> title);
  /// Calls back with the value that the user let go of.
  void on_release(std::function<void(double)> act) { act_ = std::move(act); }

  double value() const;
  void set_value(double value);
  void show(bool shown);

 private:
  void update_title();
  void release();

  std::function<std::string(double)> title_;
  std::function<void(double)> act_;
  vtkSmartPointer<vtkSliderWidget> widget_;
};

/// A dark ground under sliders, on which they are seen over any picture: a box in shares of the
/// window, from its bottom left corner.
vtkSmartPointer<vtkActor2D> make_slider_ground(const Eigen::AlignedBox2d& shares);

}  // namespace quadrille::viewer

#pragma once

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Core>
#include <span>
#include <vector>

#include "quadrille/scene_layer.h"

namespace quadrille::viewer {

/// Lines and discs in window pixels, y down, painted in the order in which they are added. Their
/// edges fade over a pixel, so they are smooth without multi-sampling, which is slow where a
/// processor draws.
class SmoothDrawing {
 public:
  /// Of a window so many pixels high.
  explicit SmoothDrawing(double height);

  /// Two or more points; joints are mitred.
  void add_line(std::span<const Eigen::Vector2d> points, double width, const Ink& ink);
  void add_disc(const Eigen::Vector2d& center, double radius, const Ink& ink);

  /// World coordinates are window pixels, y up.
  vtkSmartPointer<vtkActor> finish();

 private:
  /// `aside` from the line's or disc's middle, whose edge has faded at `outside`.
  vtkIdType add_point(const Eigen::Vector2d& p, const Ink& ink, double aside, double outside);
  void add_quad(vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType d);

  double height_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> polygons_;
  vtkNew<vtkUnsignedCharArray> colors_;
  vtkNew<vtkFloatArray> aside_;
};

}  // namespace quadrille::viewer

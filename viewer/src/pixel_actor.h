#pragma once

#include <vtkActor.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include "region_cache.h"
#include "view.h"

class vtkPolyData;

namespace quadrille::viewer {

/// A layer of pixels drawn at the screen's resolution, as a textured rectangle whose texels are
/// screen pixels; with room around the window so that moving the view need not draw.
class PixelActor {
 public:
  PixelActor();

  /// Draws what is missing, and places the rectangle: the part within the window's columns from
  /// `first` to before `last`. World coordinates are window pixels, y up. False when nothing of the
  /// picture is there.
  bool place(const Frame& frame, const RegionCache::Draw& draw, int first, int last);
  void set_opacity(double opacity);
  /// Whatever is drawn has changed.
  void forget() { cache_.clear(); }

  vtkActor* actor() const { return actor_; }

 private:
  void upload();
  void set_rectangle(const Frame& frame, const PixelRegion& part);

  RegionCache cache_;
  double scale_x_ = 0, scale_y_ = 0;  ///< of the frame that the pixels were drawn for
  vtkSmartPointer<vtkPolyData> rectangle_;
  vtkSmartPointer<vtkTexture> texture_;
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace quadrille::viewer

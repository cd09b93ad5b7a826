#pragma once

#include <Eigen/Core>
#include <string>

#include "viewer_window.h"

namespace quadrille::viewer {

/// A window of 320 x 240 pixels whose user is the test: events go the way of real ones, through
/// VTK's interactor. Places are window pixels, y down.
class WindowDriver {
 public:
  explicit WindowDriver(Subject subject, const VectorizeOptions& options = {},
                        const Eigen::Array2i& size = {320, 240});

  ViewerWindow& window() { return window_; }
  Session& session() { return window_.session(); }

  void key(const std::string& name);
  void press(int x, int y);
  void move(int x, int y);
  void release(int x, int y);
  void click(int x, int y);
  void drag(const Eigen::Array2i& from, const Eigen::Array2i& to);
  void wheel(int x, int y, int notches);

  /// What is seen, without texts.
  Raster scene() { return window_.pixels(false); }

 private:
  void send(unsigned long event, int x, int y);

  ViewerWindow window_;
};

/// A picture of 64 x 48 with curved patches, tears and irregular vertices, and a source that
/// differs from it a little.
Subject small_subject();
/// The source of such a subject alone.
std::shared_ptr<const Raster> small_source();

/// Largest difference of two pictures of equal size, in 8-bit steps, over the columns from `first`
/// to before `last`.
double largest_difference(const Raster& a, const Raster& b, int first, int last);

/// Expects that no sample differs by more than `steps` of 255; otherwise leaves the pictures
/// NAME-expected.png, -actual.png and -difference.png in the scratch folder.
void expect_same(const Raster& expected, const Raster& actual, double steps,
                 const std::string& name);

/// What a window should show of the picture of a subject: the rasterizer's output over gray.
Raster expected_picture(const Subject& subject, const Frame& frame);

}  // namespace quadrille::viewer

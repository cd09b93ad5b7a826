#include "window_driver.h"

#include <gtest/gtest.h>
#include <vtkCommand.h>

#include <cmath>

#include "quadrille/fit.h"
#include "quadrille/patch_geometry.h"
#include "quadrille/raster_file.h"
#include "support/programs.h"
#include "support/torn_meshes.h"

namespace quadrille::viewer {
namespace {

WindowSettings settings_for(const Eigen::Array2i& size) {
  WindowSettings settings;
  settings.size = size;
  settings.saved = test::scratch_dir() / "saved";
  return settings;
}

Eigen::Array4d paint(double x, double y) {
  const bool inside = std::hypot(x - 30, y - 22) < 12;
  return {inside ? 0.85 : 0.3 + 0.004 * x, 0.5 + 0.2 * std::sin(0.2 * x),
          inside ? 0.2 : 0.01 * y + 0.3, 1};
}

}  // namespace

WindowDriver::WindowDriver(Subject subject, const VectorizeOptions& options,
                           const Eigen::Array2i& size)
    : window_(std::move(subject), options, settings_for(size)) {
  window_.draw();
  window_.interactor()->Initialize();
}

void WindowDriver::send(unsigned long event, int x, int y) {
  window_.interactor()->SetEventInformationFlipY(x, y);
  window_.interactor()->InvokeEvent(event);
}

void WindowDriver::key(const std::string& name) {
  window_.interactor()->SetKeySym(name.c_str());
  window_.interactor()->SetKeyCode(name.size() == 1 ? name[0] : 0);
  for (const unsigned long event :
       {vtkCommand::KeyPressEvent, vtkCommand::CharEvent, vtkCommand::KeyReleaseEvent}) {
    window_.interactor()->InvokeEvent(event);
  }
}

void WindowDriver::press(int x, int y) { send(vtkCommand::LeftButtonPressEvent, x, y); }
void WindowDriver::move(int x, int y) { send(vtkCommand::MouseMoveEvent, x, y); }
void WindowDriver::release(int x, int y) { send(vtkCommand::LeftButtonReleaseEvent, x, y); }

void WindowDriver::click(int x, int y) {
  press(x, y);
  release(x, y);
}

void WindowDriver::drag(const Eigen::Array2i& from, const Eigen::Array2i& to) {
  move(from.x(), from.y());
  press(from.x(), from.y());
  const Eigen::Array2i middle = (from + to) / 2;
  move(middle.x(), middle.y());
  move(to.x(), to.y());
  release(to.x(), to.y());
}

void WindowDriver::wheel(int x, int y, int notches) {
  for (int i = 0; i < std::abs(notches); ++i) {
    send(notches > 0 ? vtkCommand::MouseWheelForwardEvent : vtkCommand::MouseWheelBackwardEvent, x,
         y);
  }
}

std::shared_ptr<const Raster> small_source() {
  return std::make_shared<const Raster>(testing::paint_box_filtered(64, 48, 3, 4, paint));
}

Subject small_subject() {
  Subject subject;
  subject.source = small_source();
  testing::DiscMesh disc = testing::disc_mesh(3, 1, 2, 64, 48, {30, 22}, 12);
  testing::tear(disc.mesh, disc.circle);
  PatchMesh patches = fit_patches(disc.mesh, *subject.source);
  subject.image = std::make_shared<const VectorImage>(single_layer(std::move(patches), 64, 48));
  return subject;
}

double largest_difference(const Raster& a, const Raster& b, int first, int last) {
  double largest = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = first; x < last; ++x) {
      for (int c = 0; c < 3; ++c) {
        largest = std::max(largest, 255.0 * std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]));
      }
    }
  }
  return largest;
}

void expect_same(const Raster& expected, const Raster& actual, double steps,
                 const std::string& name) {
  ASSERT_EQ(expected.width, actual.width);
  ASSERT_EQ(expected.height, actual.height);
  const double largest = largest_difference(expected, actual, 0, actual.width);
  EXPECT_LE(largest, steps + 1e-3) << "see " << test::scratch_dir() / (name + "-*.png");
  if (largest <= steps + 1e-3) return;
  Raster difference = actual;
  for (std::size_t i = 0; i < difference.data.size(); ++i) {
    difference.data[i] = std::min(1.0f, 8 * std::abs(actual.data[i] - expected.data[i]));
  }
  save_raster(expected, test::scratch_dir() / (name + "-expected.png"));
  save_raster(actual, test::scratch_dir() / (name + "-actual.png"));
  save_raster(difference, test::scratch_dir() / (name + "-difference.png"));
}

Raster expected_picture(const Subject& subject, const Frame& frame) {
  Raster expected(frame.window.x(), frame.window.y(), 3);
  std::fill(expected.data.begin(), expected.data.end(), 64 / 255.0f);
  RenderOptions options;
  options.scale = frame.zoom;
  options.region = frame.visible();
  const Raster drawn = render(*subject.image, options);
  for (int y = 0; y < drawn.height; ++y) {
    for (int x = 0; x < drawn.width; ++x) {
      std::copy_n(drawn.pixel(x, y), 3,
                  expected.pixel(options.region->x + x + frame.origin.x(),
                                 options.region->y + y + frame.origin.y()));
    }
  }
  return expected;
}

}  // namespace quadrille::viewer

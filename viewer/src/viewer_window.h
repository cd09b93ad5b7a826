#pragma once

#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "background_run.h"
#include "display.h"
#include "interaction_style.h"
#include "panels.h"
#include "scene_actors.h"
#include "session.h"
#include "sliders.h"
#include "subject.h"

namespace quadrille::viewer {

struct WindowSettings {
  Eigen::Array2i size = {1200, 800};
  bool offscreen = false;
  int threads = 0;  ///< as RunContext::threads
  std::string title = "quadrille-view";
  std::filesystem::path saved = "view";  ///< views are saved as FILE-1.png, FILE-2.png, ...
};

/// A window, on the screen or not, that shows a subject and lets the user look around in it.
class ViewerWindow : private Gestures {
 public:
  /// `options` are for vectorizing the subject's source. Throws Error{io_failure} without a
  /// display.
  ViewerWindow(Subject subject, const VectorizeOptions& options, const WindowSettings& settings);
  ~ViewerWindow() override;

  Session& session() { return session_; }
  const Subject& subject() const { return layers_->subject(); }
  vtkRenderWindowInteractor* interactor() { return interactor_; }
  BackgroundRun& background() { return background_; }
  /// As the sliders have them.
  const VectorizeOptions& options() const { return options_; }

  /// Sliders that vectorize the source anew.
  void add_sliders();
  /// Picks the patch or vertex at a point of the picture, if there is one.
  void pick_at(const Eigen::Vector2d& point);
  /// Vectorizes the source in the background with the options as the sliders have them.
  void vectorize_again();
  /// Computes what the shown layers lack, in the background.
  void compute_missing();
  /// Waits for the background, and shows what came.
  void finish_background();

  /// Brings the picture up to date.
  void draw();
  /// What draw() shows, read back; with or without texts and sliders.
  Raster pixels(bool panels);
  /// Lets the user act until the window is closed.
  void run();
  /// The file of the last view saved; empty before.
  const std::filesystem::path& last_saved() const { return last_saved_; }

 private:
  void press(const Eigen::Array2i& at) override;
  void move(const Eigen::Array2i& at) override;
  void release(const Eigen::Array2i& at) override;
  void wheel(const Eigen::Array2i& at, int notches) override;
  void key(const std::string& name) override;
  void tick() override;

  void take_result();
  void show(Subject subject);
  void click(const Eigen::Array2i& at);
  void save_view();
  void cancel();
  void follow_window_size();
  std::string status() const;
  Panels::Texts texts();
  /// Window pixels, y up; empty without sliders.
  Eigen::AlignedBox2d slider_box() const;

  enum class Drag { none, undecided, picture, divider };

  DisplayConnection display_;
  WindowSettings settings_;
  VectorizeOptions options_;
  RunContext context_;
  std::unique_ptr<SubjectLayers> layers_;
  Session session_;
  vtkSmartPointer<vtkRenderer> renderer_, overlay_;  ///< the scene; texts and sliders over it
  vtkSmartPointer<vtkRenderWindow> window_;
  vtkSmartPointer<vtkRenderWindowInteractor> interactor_;
  vtkSmartPointer<InteractionStyle> style_;
  SceneActors actors_;
  Panels panels_;
  std::optional<LogSlider> quads_slider_, lambda_slider_;
  BackgroundRun background_;
  std::string message_;
  std::string shown_status_;
  std::filesystem::path last_saved_;
  Drag drag_ = Drag::none;
  Eigen::Array2i drag_from_ = {0, 0};
};

}  // namespace quadrille::viewer

#include "viewer_window.h"

#include <fmt/core.h>
#include <vtkCommand.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "interrupt.h"
#include "quadrille/error.h"
#include "quadrille/raster_file.h"
#include "window_pixels.h"

namespace quadrille::viewer {
namespace {

constexpr int kPollMilliseconds = 150;

/// In shares of the window, from its bottom left corner.
const Eigen::AlignedBox2d kSliders(Eigen::Vector2d(0.54, 0.01), Eigen::Vector2d(0.995, 0.11));
constexpr LogSlider::Place kQuadsPlace = {0.56, 0.75, 0.08}, kLambdaPlace = {0.79, 0.98, 0.08};

vtkSmartPointer<vtkRenderWindow> make_window(const WindowSettings& settings, vtkRenderer* scene,
                                             vtkRenderer* overlay) {
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(settings.offscreen);
  window->SetMultiSamples(0);
  window->SetSize(settings.size.x(), settings.size.y());
  window->SetWindowName(settings.title.c_str());
  window->SetNumberOfLayers(2);
  overlay->SetLayer(1);
  window->AddRenderer(scene);
  window->AddRenderer(overlay);
  return window;
}

RunContext context_of(const WindowSettings& settings) {
  RunContext context;
  context.threads = settings.threads;
  return context;
}

}  // namespace

ViewerWindow::ViewerWindow(Subject subject, const VectorizeOptions& options,
                           const WindowSettings& settings)
    : settings_(settings),
      options_(options),
      context_(context_of(settings)),
      layers_(std::make_unique<SubjectLayers>(std::move(subject), context_)),
      session_{View(layers_->subject().size(), settings.size)},
      renderer_(vtkSmartPointer<vtkRenderer>::New()),
      overlay_(vtkSmartPointer<vtkRenderer>::New()),
      window_(make_window(settings, renderer_, overlay_)),
      interactor_(vtkSmartPointer<vtkRenderWindowInteractor>::New()),
      style_(vtkSmartPointer<InteractionStyle>::New()),
      actors_(renderer_, context_),
      panels_(overlay_),
      background_(settings.threads) {
  style_->set_gestures(this);
  interactor_->SetRenderWindow(window_);
  interactor_->SetInteractorStyle(style_);
  interactor_->AddObserver(vtkCommand::ConfigureEvent, this, &ViewerWindow::draw);
  actors_.set_subject(layers_.get());
}

ViewerWindow::~ViewerWindow() {
  interactor_->RemoveAllObservers();
  style_->set_gestures(nullptr);
}

void ViewerWindow::add_sliders() {
  overlay_->AddViewProp(make_slider_ground(kSliders));
  const double least_quads = std::min(50, options_.quads);
  const double lambda = options_.cross_field.alignment;
  const SliderRange lambda_range = {std::min(0.01, lambda), std::max(1.0, lambda)};
  const Raster& source = *subject().source;
  const double pixels = static_cast<double>(source.width) * source.height;
  const double most_quads =
      std::clamp(pixels / 4, std::max(2.0 * options_.quads, 100.0), 2.0 * kMaxQuads);
  quads_slider_.emplace(interactor_, overlay_, SliderRange{least_quads, most_quads}, kQuadsPlace);
  quads_slider_->set_title([](double quads) { return fmt::format("quads {:.0f}", quads); });
  quads_slider_->set_value(options_.quads);
  quads_slider_->on_release([this](double quads) {
    options_.quads = std::min(static_cast<int>(std::lround(quads)), kMaxQuads);
    vectorize_again();
  });
  lambda_slider_.emplace(interactor_, overlay_, lambda_range, kLambdaPlace);
  lambda_slider_->set_title([](double value) { return fmt::format("lambda {:.2g}", value); });
  lambda_slider_->set_value(lambda);
  lambda_slider_->on_release([this](double value) {
    options_.cross_field.alignment = value;
    vectorize_again();
  });
}

void ViewerWindow::vectorize_again() {
  message_.clear();
  background_.start({subject().source, options_, true, false});
  draw();
}

void ViewerWindow::compute_missing() {
  if (background_.progress().running) return;
  const bool awaited = std::ranges::any_of(layer_infos(), [&](const LayerInfo& info) {
    return session_.layers.shown(info.id) && layers_->awaits_stages(info.id);
  });
  if (awaited) background_.start({subject().source, options_, false, true});
}

void ViewerWindow::finish_background() {
  do {
    background_.wait();
    take_result();
  } while (background_.progress().running);
}

void ViewerWindow::take_result() {
  auto result = background_.take();
  if (!result) return;
  message_ = result->error;
  if (!message_.empty()) return;
  Subject subject = this->subject();
  if (result->image) {
    subject.image = std::move(result->image);
    subject.stages.reset();
  }
  if (result->stages) subject.stages = std::move(result->stages);
  show(std::move(subject));
  compute_missing();
}

void ViewerWindow::show(Subject subject) {
  if (subject.image != this->subject().image) session_.picked.reset();
  auto layers = std::make_unique<SubjectLayers>(std::move(subject), context_);
  actors_.set_subject(layers.get());
  layers_ = std::move(layers);
}

void ViewerWindow::follow_window_size() {
  const int* size = window_->GetSize();
  if (size[0] > 0 && size[1] > 0) session_.view.resize({size[0], size[1]});
}

std::string ViewerWindow::status() const {
  const RunProgress progress = background_.progress();
  std::string text = view_line(session_);
  if (progress.running) {
    text += fmt::format("\n{} {:.0f} % (Esc stops)", progress.stage, 100 * progress.fraction);
  } else if (!message_.empty()) {
    text += "\n" + message_;
  }
  return text;
}

Panels::Texts ViewerWindow::texts() {
  Panels::Texts texts;
  texts.layers = layer_table(session_, *layers_);
  texts.status = shown_status_ = status();
  if (session_.picked && subject().image) {
    texts.numbers = describe(*subject().image, *session_.picked, layers_->errors());
  }
  if (session_.help) texts.help = key_help();
  return texts;
}

Eigen::AlignedBox2d ViewerWindow::slider_box() const {
  if (!quads_slider_) return {};
  const Eigen::Array2d window = session_.view.window().cast<double>();
  return {(kSliders.min().array() * window).matrix(), (kSliders.max().array() * window).matrix()};
}

void ViewerWindow::draw() {
  follow_window_size();
  actors_.update(session_);
  overlay_->SetDraw(session_.panels);
  if (session_.panels) panels_.update(texts(), session_.view.window(), slider_box());
  for (std::optional<LogSlider>* slider : {&quads_slider_, &lambda_slider_}) {
    if (*slider) (*slider)->show(session_.panels);
  }
  window_->Render();
}

Raster ViewerWindow::pixels(bool panels) {
  const bool shown = std::exchange(session_.panels, panels);
  draw();
  Raster picture = window_pixels(window_);
  session_.panels = shown;
  return picture;
}

void ViewerWindow::run() {
  interactor_->Initialize();
  interactor_->CreateRepeatingTimer(kPollMilliseconds);
  draw();
  interactor_->Start();
}

void ViewerWindow::press(const Eigen::Array2i& at) {
  drag_from_ = at;
  drag_ = session_.on_divider(at.x()) ? Drag::divider : Drag::undecided;
}

void ViewerWindow::move(const Eigen::Array2i& at) {
  constexpr int kStill = 3;  // a click may tremble so many pixels
  if (drag_ == Drag::undecided && (at - drag_from_).abs().maxCoeff() > kStill) {
    drag_ = Drag::picture;
  }
  if (drag_ == Drag::divider) {
    session_.move_divider(at.x());
    draw();
  } else if (drag_ == Drag::picture) {
    session_.view.pan((at - drag_from_).cast<double>().matrix());
    drag_from_ = at;
    draw();
  }
}

void ViewerWindow::release(const Eigen::Array2i& at) {
  if (std::exchange(drag_, Drag::none) == Drag::undecided) click(at);
}

void ViewerWindow::pick_at(const Eigen::Vector2d& point) {
  constexpr double kReach = 6;  // of a vertex, window pixels
  if (subject().image) {
    session_.picked = pick(*subject().image, point, kReach / session_.view.zoom());
  }
}

void ViewerWindow::click(const Eigen::Array2i& at) {
  const Eigen::Vector2d middle_of_pixel = at.cast<double>().matrix() + Eigen::Vector2d(0.5, 0.5);
  pick_at(session_.view.frame().to_picture(middle_of_pixel));
  draw();
}

void ViewerWindow::wheel(const Eigen::Array2i& at, int notches) {
  constexpr double kStep = 1.25;
  session_.view.zoom_at(at.cast<double>().matrix(), std::pow(kStep, notches));
  draw();
}

void ViewerWindow::key(const std::string& name) {
  switch (session_.press(name)) {
    case KeyEffect::none:
      return;
    case KeyEffect::redraw:
      compute_missing();
      break;
    case KeyEffect::save:
      save_view();
      break;
    case KeyEffect::cancel:
      cancel();
      break;
    case KeyEffect::quit:
      interactor_->TerminateApp();
      return;
  }
  draw();
}

void ViewerWindow::tick() {
  if (cli::interrupting_signal()) return interactor_->TerminateApp();
  const auto image = subject().image;
  const auto stages = subject().stages;
  take_result();
  // Drawing takes time from the computation under way.
  if (image != subject().image || stages != subject().stages || status() != shown_status_) draw();
}

void ViewerWindow::cancel() {
  if (background_.progress().running) {
    background_.cancel();
    message_ = "stopped";
  } else {
    session_.picked.reset();
    message_.clear();
  }
}

void ViewerWindow::save_view() {
  namespace fs = std::filesystem;
  fs::path file;
  std::error_code ignored;
  for (int number = 1; file.empty() || fs::exists(file, ignored); ++number) {
    file = settings_.saved.string() + fmt::format("-{}.png", number);
  }
  try {
    save_raster(pixels(/*panels=*/false), file);
    message_ = "saved " + file.string();
    last_saved_ = file;
  } catch (const Error& error) {
    message_ = error.what();
  }
}

}  // namespace quadrille::viewer

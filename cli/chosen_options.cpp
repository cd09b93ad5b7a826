#include "chosen_options.h"

#include <fmt/core.h>

#include "quadrille/image_file.h"

namespace quadrille::cli {
namespace {

constexpr double kEditableShapeWeight = 0.12;

TearOptions::Mode tear_mode(const std::string& name) {
  using Mode = TearOptions::Mode;
  return name == "off" ? Mode::off : name == "strong" ? Mode::strong : Mode::automatic;
}

std::string reason(const Content& content) {
  std::string text =
      fmt::format("{:.0f} % flat, {} colours", 100 * content.flat_share, content.main_colors);
  if (content.transparent_share > 0) {
    text += fmt::format(", {:.0f} % transparent", 100 * content.transparent_share);
  }
  return text;
}

}  // namespace

ChosenOptions choose_options(const MeshOptions& mesh, const Raster& picture, Observer& observer) {
  ChosenOptions chosen;
  chosen.preset = mesh.preset;
  if (mesh.preset == "auto") {
    chosen.content = classify_content(picture);
    chosen.preset = choose_preset(*chosen.content).name;
  }
  VectorizeOptions& options = chosen.vectorize;
  apply(preset_named(chosen.preset), picture, options);
  if (mesh.quads) options.quads = *mesh.quads;
  options.fit.method = mesh.fit == "bessel"      ? FitMethod::bessel
                       : mesh.fit == "bessel-ls" ? FitMethod::bessel_ls
                                                 : FitMethod::hermite;
  if (!mesh.tears.empty()) options.tears.mode = tear_mode(mesh.tears);
  options.optimize.rounds = mesh.optimize;
  if (mesh.editable) options.optimize.shape_weight = kEditableShapeWeight;
  options.lattice = mesh.lattice;
  options.region = mesh.mesh == "opaque" ? MeshRegion::opaque : MeshRegion::whole;
  options.cross_field.alignment = mesh.alignment;
  options.cross_field.method =
      mesh.field == "paper" ? CrossFieldMethod::paper : CrossFieldMethod::smooth;
  if (!mesh.density.empty()) options.density = load_image(mesh.density);
  observer.tell(fmt::format("preset {}: {}; {} quads wished", chosen.preset,
                            chosen.content ? reason(*chosen.content) : "as asked for",
                            options.quads));
  return chosen;
}

}  // namespace quadrille::cli

#include "document_quantized.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "document_checks.h"
#include "document_colors.h"
#include "document_connectivity.h"
#include "document_container.h"
#include "document_geometry.h"
#include "document_quantization.h"
#include "document_shapes.h"

namespace quadrille {
namespace {

/// The same patches over the renumbered mesh, wedges in the order of straight_patches().
PatchMesh renumbered(const PatchMesh& patches, const OrderedMesh& ordered) {
  const std::vector<int>& before = ordered.halfedge_before;
  PatchMesh result = straight_patches(ordered.mesh);
  result.opaque = patches.opaque;
  for (int e = 0; e < result.mesh.edge_count(); ++e) {
    const int h = before[result.mesh.halfedge(e)];
    result.edge_tangents[e] = {tangent_along(patches, h, 0), tangent_along(patches, h, 1)};
  }
  for (int h = result.mesh.halfedge_count() - 1; h >= 0; --h) {
    Wedge& wedge = result.wedges[result.wedge_of_corner[h]];
    wedge = patches.wedges[patches.wedge_of_corner[before[h]]];
    // A quad that starts at another corner turns the sign of its mixed derivative along with that
    // of the twist; a fan that starts elsewhere turns the latter only.
    const int moved = result.mesh.fan_position(h) - patches.mesh.fan_position(before[h]);
    if (moved % 2 != 0) wedge.twist = -wedge.twist;
  }
  return result;
}

/// Whether the wedges are those that the tears make, whatever their numbers.
bool wedges_follow_tears(const PatchMesh& patches) {
  const PatchMesh reference = straight_patches(patches.mesh);
  if (reference.wedges.size() != patches.wedges.size()) return false;
  std::vector<int> other(reference.wedges.size(), -1);
  for (std::size_t h = 0; h < reference.wedge_of_corner.size(); ++h) {
    int& w = other[reference.wedge_of_corner[h]];
    if (w < 0) w = patches.wedge_of_corner[h];
    if (w != patches.wedge_of_corner[h]) return false;
  }
  return true;
}

flatbuffers::Offset<flatbuffers::Vector<std::uint8_t>> finished(
    flatbuffers::FlatBufferBuilder& builder, RangeEncoder& coder) {
  return builder.CreateVector(coder.finish());
}

std::span<const std::uint8_t> bytes_of(const flatbuffers::Vector<std::uint8_t>& stored) {
  return {stored.data(), stored.size()};
}

}  // namespace

bool can_store_quantized(const PatchMesh& patches, double width, double height,
                         const StepChoice& choice) {
  const QuadMesh& mesh = patches.mesh;
  if (patches.edge_tangents.size() != static_cast<std::size_t>(mesh.edge_count()) ||
      mesh.edge_flags.size() != static_cast<std::size_t>(mesh.edge_count()) ||
      patches.wedge_of_corner.size() != static_cast<std::size_t>(mesh.halfedge_count())) {
    return false;
  }
  return can_code_connectivity(mesh) && wedges_follow_tears(patches) &&
         can_quantize(patches, PositionGrid(choice.finest().position_exponent, width, height),
                      choice.finest().color);
}

flatbuffers::Offset<fbs::QuantizedPatches> store_quantized(flatbuffers::FlatBufferBuilder& builder,
                                                           const PatchMesh& patches, double width,
                                                           double height,
                                                           const StepChoice& choice) {
  RangeEncoder connectivity, geometry, colors;
  const OrderedMesh ordered = encode_connectivity(connectivity, patches.mesh);
  const auto [quantized, steps] = quantize(renumbered(patches, ordered), width, height, choice);
  const PositionGrid grid(steps.position_exponent, width, height);
  encode_geometry(geometry, quantized, grid);
  encode_colors(colors, quantized, grid, steps.color);
  const auto stored_connectivity = finished(builder, connectivity);
  const auto stored_geometry = finished(builder, geometry);
  const auto stored_colors = finished(builder, colors);
  return fbs::CreateQuantizedPatches(builder, static_cast<std::uint32_t>(patches.patch_count()),
                                     static_cast<std::int8_t>(steps.position_exponent), steps.color,
                                     stored_connectivity, stored_geometry, stored_colors);
}

PatchMesh restore_quantized(const fbs::QuantizedPatches& stored, double width, double height,
                            bool opaque, const std::string& name) {
  constexpr int kFinest = 24;
  // With these no colour of 25 bits leaves the range of a float, whatever the positions.
  constexpr double kLeastColor = 0x1p-24, kMostColor = 0x1p8;
  const int exponent = stored.position_exponent();
  const double step = stored.color_step();
  if (std::abs(exponent) > kFinest || !(step >= kLeastColor && step <= kMostColor)) {
    report_damaged_document(name, "a step of quantisation is out of range");
  }
  if (stored.quad_count() > std::numeric_limits<int>::max() / 4) {
    report_damaged_document(name, "it has too many quads");
  }
  const PositionGrid grid(exponent, width, height);
  if (!grid.is_usable()) report_damaged_document(name, "its size does not fit its positions");

  QuantizedPatches quantized;
  RangeDecoder connectivity(bytes_of(*stored.connectivity()), name);
  quantized.mesh = decode_connectivity(connectivity, static_cast<int>(stored.quad_count()));
  connectivity.finish();

  RangeDecoder geometry(bytes_of(*stored.geometry()), name);
  decode_geometry(geometry, quantized, grid);
  geometry.finish();
  set_tangents(grid.step(), quantized);
  check_finite<double>(quantized.tangents, name);

  PatchMesh wedges = straight_patches(quantized.mesh);
  quantized.wedge_of_corner = std::move(wedges.wedge_of_corner);
  quantized.wedges.resize(wedges.wedges.size());
  quantized.opaque = opaque;
  RangeDecoder colors(bytes_of(*stored.colors()), name);
  decode_colors(colors, quantized, grid, step);
  colors.finish();
  PatchMesh patches = dequantize(quantized, grid, step);
  check_finite<float>(patches.wedges, name);
  return patches;
}

}  // namespace quadrille

#include "document_patches.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "byte_planes.h"
#include "document_checks.h"
#include "document_container.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

using Bytes = flatbuffers::Vector<std::uint8_t>;
using EdgeTangents = std::array<Eigen::Vector2d, 2>;
static_assert(sizeof(Wedge) == 16 * sizeof(float));
static_assert(sizeof(EdgeTangents) == 4 * sizeof(double));

template <class Word>
std::vector<std::uint8_t> planes(const std::vector<Word>& words, std::size_t components) {
  return split_planes(std::span<const Word>(words), components);
}

/// The words of an array of elements of `components` words each; refuses a size in between.
template <class Word>
std::vector<Word> words_from(const Bytes& bytes, std::size_t components, const std::string& name) {
  if (bytes.size() % (components * sizeof(Word)) != 0) {
    report_damaged_document(name, "an array has a wrong size");
  }
  return join_planes<Word>(std::span(bytes.data(), bytes.size()), components);
}

std::vector<std::uint32_t> coded_quads(const std::vector<QuadMesh::Quad>& quads) {
  std::vector<std::uint32_t> words = words_of<std::uint32_t>(quads);
  for (std::size_t i = words.size(); i-- > 4;) words[i] = zigzag_difference(words[i], words[i - 4]);
  return words;
}

std::vector<QuadMesh::Quad> decoded_quads(std::vector<std::uint32_t> words) {
  for (std::size_t i = 4; i < words.size(); ++i) {
    words[i] = undo_zigzag_difference(words[i], words[i - 4]);
  }
  return elements_of<QuadMesh::Quad>(words);
}

QuadMesh restore_mesh(const fbs::LosslessPatches& stored, const std::string& name) {
  std::vector<QuadMesh::Quad> quads =
      decoded_quads(words_from<std::uint32_t>(*stored.quads(), 4, name));
  std::vector<Eigen::Vector2d> vertices =
      elements_of<Eigen::Vector2d>(words_from<std::uint64_t>(*stored.vertices(), 2, name));
  check_finite<double>(vertices, name);
  try {
    return QuadMesh(std::move(vertices), std::move(quads));
  } catch (const Error& error) {
    report_damaged_document(name, error.what());
  }
}

}  // namespace

flatbuffers::Offset<fbs::LosslessPatches> store_patches(flatbuffers::FlatBufferBuilder& builder,
                                                        const PatchMesh& patches) {
  std::vector<std::uint32_t> wedges = words_of<std::uint32_t>(patches.wedge_of_corner);
  for (std::size_t h = 0; h < wedges.size(); ++h) {
    wedges[h] = zigzag_difference(
        wedges[h], static_cast<std::uint32_t>(patches.mesh.origin(static_cast<int>(h))));
  }
  const auto quads = builder.CreateVector(planes(coded_quads(patches.mesh.quads()), 4));
  const auto vertices =
      builder.CreateVector(planes(words_of<std::uint64_t>(patches.mesh.vertices), 2));
  const auto edge_flags = builder.CreateVector(patches.mesh.edge_flags);
  const auto edge_tangents =
      builder.CreateVector(planes(words_of<std::uint64_t>(patches.edge_tangents), 4));
  const auto wedge_of_corner = builder.CreateVector(planes(wedges, 4));
  const auto wedge_values =
      builder.CreateVector(planes(words_of<std::uint32_t>(patches.wedges), 16));
  return fbs::CreateLosslessPatches(builder, quads, vertices, edge_flags, edge_tangents,
                                    wedge_of_corner, wedge_values);
}

PatchMesh restore_patches(const fbs::LosslessPatches& stored, const std::string& name) {
  PatchMesh patches;
  patches.mesh = restore_mesh(stored, name);
  const QuadMesh& mesh = patches.mesh;
  patches.mesh.edge_flags.assign(stored.edge_flags()->begin(), stored.edge_flags()->end());

  patches.edge_tangents =
      elements_of<EdgeTangents>(words_from<std::uint64_t>(*stored.edge_tangents(), 4, name));

  std::vector<std::uint32_t> wedges = words_from<std::uint32_t>(*stored.wedge_of_corner(), 4, name);
  const std::size_t corners = mesh.halfedge_count();
  if (wedges.size() != corners) {
    report_damaged_document(name, "it has " + std::to_string(wedges.size()) +
                                      " corners instead of " + std::to_string(corners));
  }
  for (std::size_t h = 0; h < corners; ++h) {
    wedges[h] = undo_zigzag_difference(
        wedges[h], static_cast<std::uint32_t>(mesh.origin(static_cast<int>(h))));
  }
  patches.wedge_of_corner = elements_of<int>(wedges);
  patches.wedges = elements_of<Wedge>(words_from<std::uint32_t>(*stored.wedges(), 16, name));
  const std::string contradiction = contradiction_in(patches);
  if (!contradiction.empty()) report_damaged_document(name, contradiction);
  return patches;
}

std::size_t stored_size(const PatchMesh& patches) {
  return patches.mesh.quads().size() * 2 * sizeof(QuadMesh::Quad) +
         patches.mesh.vertices.size() * sizeof(Eigen::Vector2d) + patches.mesh.edge_flags.size() +
         patches.edge_tangents.size() * sizeof(EdgeTangents) +
         patches.wedges.size() * sizeof(Wedge);
}

}  // namespace quadrille

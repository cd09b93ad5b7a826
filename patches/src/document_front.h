#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "quadrille/quad_mesh.h"

namespace quadrille {

/// A mesh that grows quad by quad across its open edges, as a document's reader and writer see it.
/// Half-edges are numbered as in QuadMesh.
class QuadFront {
 public:
  /// What follows an open half-edge around one of its ends, as far as the quads there are known.
  struct Neighbour {
    int halfedge = -1;  ///< without a known quad on its other side
    int quads = 0;      ///< that meet between the two half-edges, at most kMostQuads
  };
  static constexpr int kMostQuads = 255;

  const std::vector<QuadMesh::Quad>& quads() const { return quads_; }
  int quad_count() const { return static_cast<int>(quads_.size()); }
  int origin(int h) const { return quads_[h >> 2][h & 3]; }
  int tip(int h) const { return quads_[h >> 2][(h + 1) & 3]; }

  /// Adds a quad; its sides are linked to the open half-edges between the same vertices.
  void add(const QuadMesh::Quad& corners);

  /// The first half-edge that was never returned and has no quad on its other side, or -1.
  int next_gate();
  void mark_border(int h) { twin_[h] = kBorder; }
  bool is_border(int h) const { return twin_[h] == kBorder; }

  /// The open half-edge or border that ends where `gate` begins.
  Neighbour before(int gate) const;
  /// The open half-edge or border that begins where `gate` ends.
  Neighbour after(int gate) const;

 private:
  static constexpr int kOpen = -1, kBorder = -2;
  std::vector<QuadMesh::Quad> quads_;
  std::vector<int> twin_;
  int next_gate_ = 0;
  std::unordered_map<std::uint64_t, int> open_;  // by origin and tip
};

}  // namespace quadrille

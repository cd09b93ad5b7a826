#include "document_front.h"

namespace quadrille {
namespace {

std::uint64_t key(int origin, int tip) {
  return std::uint64_t{static_cast<std::uint32_t>(origin)} << 32 | static_cast<std::uint32_t>(tip);
}

}  // namespace

void QuadFront::add(const QuadMesh::Quad& corners) {
  quads_.push_back(corners);
  for (int k = 0; k < 4; ++k) {
    const int h = static_cast<int>(twin_.size());
    twin_.push_back(kOpen);
    const auto other = open_.find(key(tip(h), origin(h)));
    if (other == open_.end()) {
      open_.emplace(key(origin(h), tip(h)), h);
    } else if (twin_[other->second] == kOpen) {
      twin_[h] = other->second;
      twin_[other->second] = h;
      open_.erase(other);
    }
  }
}

int QuadFront::next_gate() {
  const int count = static_cast<int>(twin_.size());
  while (next_gate_ < count && twin_[next_gate_] != kOpen) ++next_gate_;
  return next_gate_ < count ? next_gate_++ : -1;
}

// Both walks end: a step is a one-to-one map of half-edges, and the first one has no predecessor,
// since the gate is open.

QuadFront::Neighbour QuadFront::before(int gate) const {
  Neighbour at{QuadMesh::prev(gate), 1};
  while (twin_[at.halfedge] >= 0 && at.quads < kMostQuads) {
    at.halfedge = QuadMesh::prev(twin_[at.halfedge]);
    ++at.quads;
  }
  return at;
}

QuadFront::Neighbour QuadFront::after(int gate) const {
  Neighbour at{QuadMesh::next(gate), 1};
  while (twin_[at.halfedge] >= 0 && at.quads < kMostQuads) {
    at.halfedge = QuadMesh::next(twin_[at.halfedge]);
    ++at.quads;
  }
  return at;
}

}  // namespace quadrille

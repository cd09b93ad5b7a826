#include "document_connectivity.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "document_front.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

using Quad = QuadMesh::Quad;
constexpr int kUnseen = -1;

/// What lies across a gate: the border, or a quad with the gate's tip and origin as its first two
/// corners and these two after them.
struct Across {
  bool border = false;
  int third = kUnseen, fourth = kUnseen;
};

/// Follows the coded mesh through the mesh to be written.
class Guide {
 public:
  explicit Guide(const QuadMesh& mesh) : mesh_(mesh), seen_(mesh.vertex_count(), kUnseen) {}

  /// The first quad of the next component: it starts at the lowest vertex not seen yet and at the
  /// lowest of its neighbours.
  void start() {
    while (seen_[lowest_] != kUnseen) ++lowest_;
    const auto fan = mesh_.fan(lowest_);
    take(*std::min_element(fan.begin(), fan.end(),
                           [&](int a, int b) { return mesh_.tip(a) < mesh_.tip(b); }));
  }
  Across across(int gate) {
    next_ = mesh_.twin(halfedge_before[gate]);
    if (next_ < 0) return {true};
    return {false, seen_[mesh_.tip(QuadMesh::next(next_))],
            seen_[mesh_.origin(QuadMesh::prev(next_))]};
  }
  /// The quad that across() told of is now part of the coded mesh.
  void added() { take(next_); }

  std::vector<int> halfedge_before;

 private:
  const QuadMesh& mesh_;
  std::vector<int> seen_;  // vertex -> number in the coded mesh
  int lowest_ = 0, count_ = 0, next_ = -1;

  void take(int h) {
    for (int k = 0; k < 4; ++k, h = QuadMesh::next(h)) {
      halfedge_before.push_back(h);
      int& number = seen_[mesh_.origin(h)];
      if (number == kUnseen) number = count_++;
    }
  }
};

/// The decoder's guide knows nothing.
struct NoGuide {
  void start() {}
  Across across(int) { return {}; }
  void added() {}
};

struct Models {
  AdaptiveBit border[8][8], known[8][2][2], seen[8];
  AdaptiveInteger distance;
};

template <class Coder>
class Corners {
 public:
  Corners(Coder& coder, Models& models, int& vertex_count)
      : coder_(coder), models_(models), vertex_count_(vertex_count) {}

  /// A new corner next to an end of the gate in `state`, where the front goes on to vertex
  /// `neighbour` (or -1 at the border). `second` and `joined`: of the other corner.
  int code(int wish, int neighbour, int state, bool second, bool joined) {
    if (neighbour >= 0 && coder_.bit(models_.known[state][second][joined], wish == neighbour)) {
      return neighbour;
    }
    if (!coder_.bit(models_.seen[state], wish != kUnseen)) return vertex_count_++;
    const int distance = models_.distance.code(coder_, vertex_count_ - wish);
    if (distance < 1 || distance > vertex_count_) coder_.refuse("a vertex is out of range");
    return vertex_count_ - distance;
  }

 private:
  Coder& coder_;
  Models& models_;
  int& vertex_count_;
};

template <class Coder, class SomeGuide>
QuadFront code_quads(Coder& coder, SomeGuide& guide, int quad_count) {
  QuadFront front;
  Models models;
  int vertex_count = 0;
  Corners<Coder> corners(coder, models, vertex_count);
  const auto state = [&](const QuadFront::Neighbour& end) {
    if (end.quads == QuadFront::kMostQuads) coder.refuse("a vertex has too many quads");
    return std::min(end.quads, 4) - 1 + (front.is_border(end.halfedge) ? 4 : 0);
  };
  while (front.quad_count() < quad_count) {
    const int v = vertex_count;
    vertex_count += 4;
    front.add({v, v + 1, v + 2, v + 3});
    guide.start();
    for (int gate = front.next_gate(); gate >= 0; gate = front.next_gate()) {
      const auto before = front.before(gate), after = front.after(gate);
      const int at_origin = state(before), at_tip = state(after);
      const Across wish = guide.across(gate);
      if (coder.bit(models.border[at_origin][at_tip], wish.border)) {
        front.mark_border(gate);
        continue;
      }
      if (front.quad_count() == quad_count) coder.refuse("it has more quads than it says");
      const int left = front.is_border(before.halfedge) ? -1 : front.origin(before.halfedge);
      const int right = front.is_border(after.halfedge) ? -1 : front.tip(after.halfedge);
      const int third = corners.code(wish.third, left, at_origin, false, false);
      const int fourth = corners.code(wish.fourth, right, at_tip, true, third == left);
      front.add({front.tip(gate), front.origin(gate), third, fourth});
      guide.added();
    }
  }
  return front;
}

bool is_odd_and_closed(const QuadMesh& mesh, int v) {
  return !mesh.is_border_vertex(v) && mesh.fan(v).size() % 2 == 1;
}

/// Per odd closed fan of the mesh in coding order the position of its first half-edge.
template <class Coder, class FirstOf>
std::vector<int> code_first_of_fans(Coder& coder, const QuadMesh& mesh, const FirstOf& first_of) {
  AdaptiveInteger model;
  std::vector<int> firsts;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!is_odd_and_closed(mesh, v)) continue;
    const int first = model.code(coder, first_of(v));
    if (first < 0 || first >= static_cast<int>(mesh.fan(v).size())) {
      coder.refuse("a fan starts outside of itself");
    }
    firsts.push_back(first);
  }
  return firsts;
}

/// The quads in the order closest to the coded one in which the chosen half-edges are the lowest of
/// their fans; shorter than the mesh when there is none.
std::vector<int> sorted_quads(const QuadMesh& mesh, const std::vector<int>& firsts) {
  std::vector<std::pair<int, int>> before;  // the former quad must come before the latter
  std::size_t next = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!is_odd_and_closed(mesh, v)) continue;
    const auto fan = mesh.fan(v);
    const int first = fan[firsts[next++]];
    for (const int h : fan) {
      if (h != first) before.emplace_back(QuadMesh::quad_of(first), QuadMesh::quad_of(h));
    }
  }
  std::sort(before.begin(), before.end());
  std::vector<int> waits_for(mesh.quad_count(), 0), order;
  for (const auto& pair : before) ++waits_for[pair.second];
  std::priority_queue<int, std::vector<int>, std::greater<>> ready;
  for (int q = 0; q < mesh.quad_count(); ++q) {
    if (waits_for[q] == 0) ready.push(q);
  }
  while (!ready.empty()) {
    const int q = ready.top();
    ready.pop();
    order.push_back(q);
    for (auto pair = std::lower_bound(before.begin(), before.end(), std::pair(q, 0));
         pair != before.end() && pair->first == q; ++pair) {
      if (--waits_for[pair->second] == 0) ready.push(pair->second);
    }
  }
  return order;
}

QuadMesh with_quads(const QuadMesh& mesh, const std::vector<int>& order) {
  std::vector<Quad> quads;
  for (const int q : order) quads.push_back(mesh.quads()[q]);
  return QuadMesh(mesh.vertices, std::move(quads));
}

QuadMesh mesh_of(const QuadFront& front) {
  int vertex_count = 0;
  for (const Quad& q : front.quads()) {
    for (const int v : q) vertex_count = std::max(vertex_count, v + 1);
  }
  return QuadMesh(std::vector<Eigen::Vector2d>(vertex_count, Eigen::Vector2d::Zero()),
                  front.quads());
}

}  // namespace

bool can_code_connectivity(const QuadMesh& mesh) {
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (static_cast<int>(mesh.fan(v).size()) >= QuadFront::kMostQuads) return false;
  }
  return true;
}

OrderedMesh encode_connectivity(RangeEncoder& coder, const QuadMesh& mesh) {
  Guide guide(mesh);
  QuadMesh coded = mesh_of(code_quads(coder, guide, mesh.quad_count()));
  const std::vector<int>& before = guide.halfedge_before;
  for (int h = 0; h < coded.halfedge_count(); ++h) {
    coded.vertices[coded.origin(h)] = mesh.vertices[mesh.origin(before[h])];
  }
  const std::vector<int> firsts = code_first_of_fans(coder, coded, [&](int v) {
    const auto fan = coded.fan(v);
    return static_cast<int>(std::find_if(fan.begin(), fan.end(),
                                         [&](int h) { return mesh.fan_position(before[h]) == 0; }) -
                            fan.begin());
  });
  const std::vector<int> order = sorted_quads(coded, firsts);
  OrderedMesh ordered{with_quads(coded, order), {}};
  for (const int q : order) {
    for (int k = 0; k < 4; ++k) ordered.halfedge_before.push_back(before[4 * q + k]);
  }
  for (int h = 0; h < ordered.mesh.halfedge_count(); ++h) {
    ordered.mesh.edge_flags[ordered.mesh.edge(h)] =
        mesh.edge_flags[mesh.edge(ordered.halfedge_before[h])];
  }
  return ordered;
}

QuadMesh decode_connectivity(RangeDecoder& coder, int quad_count) {
  try {
    NoGuide guide;
    const QuadMesh coded = mesh_of(code_quads(coder, guide, quad_count));
    const std::vector<int> firsts = code_first_of_fans(coder, coded, [](int) { return 0; });
    const std::vector<int> order = sorted_quads(coded, firsts);
    if (static_cast<int>(order.size()) != quad_count) coder.refuse("its fans start in a circle");
    return with_quads(coded, order);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::invalid_argument) throw;
    coder.refuse(error.what());
  }
}

}  // namespace quadrille

#include "document_geometry.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace quadrille {
namespace {

/// Contexts by how large something nearby was: 0, 1, 2-3, 4-7, ...
int size_class(int magnitude, int classes) {
  return std::min(static_cast<int>(std::bit_width(static_cast<unsigned>(magnitude))), classes - 1);
}

int rounded(double x) { return static_cast<int>(std::floor(x + 0.5)); }

/// Where a vertex lies on one axis: inside, or exactly at one of the picture's sides.
enum Side { kInside, kNearSide, kFarSide, kUnknownSide };

template <class Coder>
class PositionCoder {
 public:
  PositionCoder(Coder& coder, const QuadMesh& mesh, const PositionGrid& grid,
                std::vector<Eigen::Vector2i>& points)
      : coder_(coder), mesh_(mesh), grid_(grid), points_(points), errors_(points.size(), 0) {}

  /// Vertex v from those before it.
  void code(int v) {
    const Eigen::Vector2i wish = points_[v];
    const Eigen::Vector2i guess = predict(v);
    const int context = size_class(nearby_error(v), kClasses);
    Eigen::Vector2i& p = points_[v];
    for (int axis = 0; axis < 2; ++axis) {
      if (mesh_.is_border_vertex(v)) {
        const Side side = code_side(v, axis, wish[axis]);
        if (side != kInside) {
          p[axis] = side == kNearSide ? 0 : grid_.last(axis);
          continue;
        }
      }
      p[axis] = guess[axis] + error_[axis][context].code(coder_, wish[axis] - guess[axis]);
      if (std::abs(p[axis]) > kLargest) coder_.refuse("a position is out of range");
      errors_[v] += std::abs(p[axis] - guess[axis]);
    }
  }

 private:
  static constexpr int kClasses = 12, kLargest = 1 << 25;
  Coder& coder_;
  const QuadMesh& mesh_;
  const PositionGrid& grid_;
  std::vector<Eigen::Vector2i>& points_;
  std::vector<int> errors_;  // of the prediction, both axes together
  AdaptiveInteger error_[2][kClasses];
  AdaptiveBit side_[2][kUnknownSide + 1][kUnknownSide + 1][2];

  /// Calls visit(neighbour, half-edge from v to it or from it to v).
  template <class Visit>
  void for_each_known_neighbour(int v, const Visit& visit) const {
    for (const int h : mesh_.fan(v)) {
      if (mesh_.tip(h) < v) visit(mesh_.tip(h), h);
      const int back = QuadMesh::prev(h);
      if (mesh_.origin(back) < v) visit(mesh_.origin(back), back);
    }
  }

  int nearby_error(int v) const {
    std::int64_t sum = 0;
    int count = 0;
    for_each_known_neighbour(v, [&](int u, int) {
      sum += errors_[u];
      ++count;
    });
    return count > 0 ? static_cast<int>(sum / count) : 1 << 16;
  }

  /// The mean of parallelograms and of straight continuations.
  Eigen::Vector2i predict(int v) const {
    Eigen::Vector2d sum(0, 0);
    double count = 0;
    for (const int h : mesh_.fan(v)) {
      const int a = mesh_.tip(h), b = mesh_.origin(QuadMesh::prev(h));
      const int across = mesh_.tip(QuadMesh::next(h));
      if (a < v && b < v && across < v) {
        sum += (points_[a] + points_[b] - points_[across]).template cast<double>();
        count += 1;
      }
    }
    for_each_known_neighbour(v, [&](int u, int h) {
      const int beyond = continuation(h, u);
      if (beyond < 0 || beyond >= v) return;
      sum += 0.5 * (2 * points_[u] - points_[beyond]).template cast<double>();
      count += 0.5;
    });
    if (count == 0) {
      for_each_known_neighbour(v, [&](int u, int) {
        sum += points_[u].template cast<double>();
        count += 1;
      });
    }
    if (count == 0) return v > 0 ? points_[v - 1] : Eigen::Vector2i(0, 0);
    return {rounded(sum.x() / count), rounded(sum.y() / count)};
  }

  /// The vertex that continues the edge of half-edge h across its end u, two quads further, or -1.
  int continuation(int h, int u) const {
    if (mesh_.tip(h) == u) {
      const int other = mesh_.twin(QuadMesh::next(h));
      return other < 0 ? -1 : mesh_.tip(QuadMesh::next(other));
    }
    const int other = mesh_.twin(QuadMesh::prev(h));
    return other < 0 ? -1 : mesh_.origin(QuadMesh::prev(other));
  }

  Side side_of(int axis, int n) const {
    return n == 0 ? kNearSide : n == grid_.last(axis) ? kFarSide : kInside;
  }

  Side code_side(int v, int axis, int n) {
    Side before = kUnknownSide, after = kUnknownSide;  // of the neighbours along the border
    const int out = mesh_.fan(v).front(), in = QuadMesh::prev(mesh_.fan(v).back());
    if (mesh_.origin(in) < v) before = side_of(axis, points_[mesh_.origin(in)][axis]);
    if (mesh_.tip(out) < v) after = side_of(axis, points_[mesh_.tip(out)][axis]);
    auto& models = side_[axis][before][after];
    const Side wish = side_of(axis, n);
    if (!coder_.bit(models[0], wish != kInside)) return kInside;
    return coder_.bit(models[1], wish == kFarSide) ? kFarSide : kNearSide;
  }
};

/// Flags in edge order; flagged edges form chains, so flagged neighbours are the context.
template <class Coder>
void code_flags(Coder& coder, QuadMesh& mesh) {
  std::vector<int> flagged(mesh.vertex_count(), 0);
  AdaptiveBit any[3][3], bits[8];
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    int &a = flagged[mesh.origin(h)], &b = flagged[mesh.tip(h)];
    std::uint8_t& flags = mesh.edge_flags[e];
    const int most = std::min(std::max(a, b), 2), least = std::min({a, b, 2});
    if (coder.bit(any[most][least], flags != 0)) {
      std::uint8_t value = 0;
      for (int i = 0; i < 8; ++i) value |= coder.bit(bits[i], flags >> i & 1) << i;
      flags = value;
      ++a, ++b;
    }
  }
}

template <class Coder>
void code_shapes(Coder& coder, const QuadMesh& mesh, std::vector<EdgeShape>& shapes) {
  std::vector<char> bent(mesh.vertex_count(), 0);
  AdaptiveBit plain[3], free;
  AdaptiveInteger level, deviation;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    char &a = bent[mesh.origin(h)], &b = bent[mesh.tip(h)];
    EdgeShape& shape = shapes[e];
    if (coder.bit(plain[a + b], shape.level == 0)) continue;
    a = b = 1;
    if (!coder.bit(free, shape.level == EdgeShape::kFree)) {
      shape.level = level.code(coder, shape.level);
      if (shape.level < 1 || shape.level > EdgeShape::kStraight) {
        coder.refuse("an edge has an unknown shape");
      }
      continue;
    }
    shape.level = EdgeShape::kFree;
    for (int& d : shape.deviation) d = deviation.code(coder, d);
  }
}

template <class Coder>
void code_geometry(Coder& coder, QuadMesh& mesh, std::vector<Eigen::Vector2i>& points,
                   std::vector<EdgeShape>& shapes, const PositionGrid& grid) {
  PositionCoder<Coder> positions(coder, mesh, grid, points);
  for (int v = 0; v < mesh.vertex_count(); ++v) positions.code(v);
  code_flags(coder, mesh);
  code_shapes(coder, mesh, shapes);
}

}  // namespace

void encode_geometry(RangeEncoder& coder, const QuantizedPatches& patches,
                     const PositionGrid& grid) {
  QuadMesh mesh = patches.mesh;
  std::vector<Eigen::Vector2i> points = patches.points;
  std::vector<EdgeShape> shapes = patches.shapes;
  code_geometry(coder, mesh, points, shapes, grid);
}

void decode_geometry(RangeDecoder& coder, QuantizedPatches& patches, const PositionGrid& grid) {
  patches.points.assign(patches.mesh.vertices.size(), Eigen::Vector2i::Zero());
  patches.shapes.assign(patches.mesh.edge_count(), {});
  code_geometry(coder, patches.mesh, patches.points, patches.shapes, grid);
  for (std::size_t v = 0; v < patches.points.size(); ++v) {
    patches.mesh.vertices[v] = grid.at(patches.points[v]);
  }
}

}  // namespace quadrille

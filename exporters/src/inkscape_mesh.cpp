#include "inkscape_mesh.h"

#include <algorithm>

#include "inkscape_divisions.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

PlaneCurve reversed(const PlaneCurve& p) { return {p[3], p[2], p[1], p[0]}; }

/// A node of the mesh gradient, and where its colour comes from: a quad and parameters in it.
struct MeshNode {
  Vector2d position;
  int column, row;
  Vector2d uv;
  Vector2d beyond = Vector2d::Zero();  ///< how far the node lies outside the grid, in parameters
};

class MeshBuilder {
 public:
  MeshBuilder(const PlacedGrid& grid, const GridDivisions& divisions)
      : grid_(grid),
        divisions_(divisions),
        column_lines_(lines_of(divisions.columns)),
        row_lines_(lines_of(divisions.rows)),
        columns_(static_cast<int>(column_lines_.size()) - 1),
        rows_(static_cast<int>(row_lines_.size()) - 1) {
    set_sides();
    for (int j = 0; j <= rows_; ++j) {
      for (int i = 0; i <= columns_; ++i) {
        const GridLine &column = column_lines_[i], &row = row_lines_[j];
        const PlaneCurve& side = across_[j * columns_ + std::min(i, columns_ - 1)];
        nodes_.push_back(
            {i < columns_ ? side[0] : side[3], column.quad, row.quad, {column.at, row.at}});
      }
    }
  }

  InkscapeMesh build(double bleed) {
    for (turns_ = 0; turns_ < 4; ++turns_) {
      extend_top(bleed);
      turn();
    }
    InkscapeMesh mesh;
    mesh.columns = columns_;
    mesh.rows = rows_;
    for (const MeshNode& node : nodes_) {
      mesh.nodes.push_back(node.position);
      mesh.colors.push_back(color_of(node));
    }
    mesh.across = std::move(across_);
    mesh.down = std::move(down_);
    return mesh;
  }

 private:
  void set_sides() {
    for (const GridLine& row : row_lines_) {
      for (int i = 0; i < columns_; ++i) {
        across_.push_back(side_curve(part(column_lines_[i], column_lines_[i + 1], row, row), 0));
      }
    }
    for (int j = 0; j < rows_; ++j) {
      for (const GridLine& column : column_lines_) {
        down_.push_back(
            reversed(side_curve(part(column, column, row_lines_[j], row_lines_[j + 1]), 3)));
      }
    }
  }

  /// The patch between lines; the ends of a line that begins the next quad are this quad's ends.
  BicubicBezier<Vector2d> part(const GridLine& left, const GridLine& right, const GridLine& top,
                               const GridLine& bottom) const {
    const auto end = [](const GridLine& first, const GridLine& last) {
      return last.quad > first.quad ? 1 : last.at;
    };
    return sub_patch(grid_.position(left.quad, top.quad),
                     {left.at, top.at, end(left, right), end(top, bottom)});
  }

  /// Beyond the grid the colour goes on as the patch's polynomial, but changes no more than it does
  /// as far inside.
  Color color_of(const MeshNode& node) const {
    const auto shown_at = [&](const Vector2d& uv) -> Color {
      const Color color = grid_.color(node.column, node.row).at(uv.x(), uv.y());
      return color.cwiseMax(0.0f).cwiseMin(1.0f);
    };
    const Color on_grid = shown_at(node.uv);
    const Color bound = (shown_at(node.uv - node.beyond) - on_grid).abs();
    const Color change = shown_at(node.uv + node.beyond) - on_grid;
    return on_grid + change.cwiseMax(-bound).cwiseMin(bound);
  }

  /// Prolongs the patches of the first row, or adds a row where they are short: their colours could
  /// not go on far enough.
  void extend_top(double bleed) {
    constexpr double kLong = 3;  // bleeds
    double shortest = kLong * bleed;
    for (int i = 0; i <= columns_; ++i)
      shortest = std::min(shortest, (down_[i][3] - down_[i][0]).norm());
    const bool is_long = shortest >= kLong * bleed;
    if (!is_long) repeat_top();
    for (int i = 0; i <= columns_; ++i) {
      PlaneCurve& first = down_[i];
      MeshNode& node = nodes_[i];
      const PlaneCurve& side = is_long ? first : down_[columns_ + 1 + i];
      const double by = std::min(0.5, bleed / std::max(3 * (side[1] - side[0]).norm(), 1e-9));
      node.beyond += by * part_length(node) * outward();
      if (is_long && by < 0.5) {
        first = sub_curve(first, -by, 1);
      } else {
        move_ends(first, side[0] - bleed * (side[3] - side[0]).normalized(), first[3]);
      }
      node.position = first[0];
    }
    for (int i = 0; i < columns_; ++i) {
      move_ends(across_[i], nodes_[i].position, nodes_[i + 1].position);
    }
  }

  /// Inserts a first row of patches without height.
  void repeat_top() {
    std::vector<PlaneCurve> heights;
    for (int i = 0; i <= columns_; ++i) {
      const Vector2d& p = nodes_[i].position;
      heights.push_back({p, p, p, p});
    }
    const std::vector<MeshNode> first_nodes(nodes_.begin(), nodes_.begin() + columns_ + 1);
    const std::vector<PlaneCurve> first_across(across_.begin(), across_.begin() + columns_);
    nodes_.insert(nodes_.begin(), first_nodes.begin(), first_nodes.end());
    across_.insert(across_.begin(), first_across.begin(), first_across.end());
    down_.insert(down_.begin(), heights.begin(), heights.end());
    ++rows_;
  }

  /// A quarter turn: the right side becomes the top.
  void turn() {
    std::vector<MeshNode> nodes;
    std::vector<PlaneCurve> across, down;
    for (int j = 0; j <= columns_; ++j) {
      for (int i = 0; i <= rows_; ++i) nodes.push_back(nodes_[i * (columns_ + 1) + columns_ - j]);
      for (int i = 0; i < rows_; ++i) across.push_back(down_[i * (columns_ + 1) + columns_ - j]);
    }
    for (int j = 0; j < columns_; ++j) {
      for (int i = 0; i <= rows_; ++i) {
        down.push_back(reversed(across_[i * columns_ + columns_ - 1 - j]));
      }
    }
    nodes_ = std::move(nodes);
    across_ = std::move(across);
    down_ = std::move(down);
    std::swap(columns_, rows_);
  }

  /// Outward from the present top, in the parameters of the quads.
  Vector2d outward() const {
    const Vector2d directions[4] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    return directions[turns_];
  }

  /// The extent of the node's part of its quad, across the present top.
  double part_length(const MeshNode& node) const {
    return 1.0 / (turns_ % 2 == 0 ? divisions_.rows[node.row] : divisions_.columns[node.column]);
  }

  /// Moves the ends of a curve, and what is between them in proportion.
  static void move_ends(PlaneCurve& curve, const Vector2d& start, const Vector2d& end) {
    const Vector2d from = start - curve[0], to = end - curve[3];
    for (int i = 0; i < 4; ++i) curve[i] += from * ((3 - i) / 3.0) + to * (i / 3.0);
  }

  const PlacedGrid& grid_;
  const GridDivisions& divisions_;
  std::vector<GridLine> column_lines_, row_lines_;
  int columns_, rows_;
  int turns_ = 0;
  std::vector<MeshNode> nodes_;            ///< as in InkscapeMesh, turned so many times
  std::vector<PlaneCurve> across_, down_;  ///< likewise
};

}  // namespace

InkscapeMesh inkscape_mesh(const PlacedGrid& grid, double bleed, double tolerance) {
  const bool bicubic = is_faithful_bicubic(grid, tolerance);
  const GridDivisions divisions = divisions_of(grid, bicubic, tolerance);
  InkscapeMesh mesh = MeshBuilder(grid, divisions).build(bleed);
  mesh.bicubic = bicubic;
  return mesh;
}

}  // namespace quadrille

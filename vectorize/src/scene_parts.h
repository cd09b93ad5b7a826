#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/scene_layer.h"
#include "quadrille/vectorize.h"

namespace quadrille {

inline Eigen::Vector2d to_source(const WorkingPicture& working, double x, double y) {
  return {x * working.scale_x, y * working.scale_y};
}

/// An array of numbers, a component each.
template <class T>
SceneArray number_array(std::string name, std::string meaning, std::vector<T> values) {
  return {std::move(name), std::move(meaning), 1, SceneArray::Kind::number, std::move(values)};
}

/// An array of colours, three or four components each.
inline SceneArray color_array(std::string name, std::string meaning, int components,
                              std::vector<std::uint8_t> values) {
  return {std::move(name), std::move(meaning), components, SceneArray::Kind::color,
          std::move(values)};
}

/// Collects vectors.
class VectorArray {
 public:
  void add(const Eigen::Vector2d& v) {
    values_.push_back(static_cast<float>(v.x()));
    values_.push_back(static_cast<float>(v.y()));
  }
  SceneArray finish(std::string name, std::string meaning) {
    return {std::move(name), std::move(meaning), 2, SceneArray::Kind::vector, std::move(values_)};
  }

 private:
  std::vector<float> values_;
};

/// A grid with the working pixels, still without arrays.
template <class T>
SceneGrid grid_of(const FieldGrid<T>& field, const WorkingPicture& working) {
  SceneGrid grid;
  grid.width = field.width;
  grid.height = field.height;
  grid.pixel_width = working.scale_x;
  grid.pixel_height = working.scale_y;
  return grid;
}

inline void add_bytes(std::vector<std::uint8_t>& bytes, const Ink& ink) {
  for (const int c : ink) bytes.push_back(static_cast<std::uint8_t>(c));
}

}  // namespace quadrille

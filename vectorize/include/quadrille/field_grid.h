#pragma once

#include <cstddef>
#include <vector>

namespace quadrille {

/// One value per working pixel, rows from the top.
template <class T>
struct FieldGrid {
  int width = 0;
  int height = 0;
  std::vector<T> data;

  FieldGrid() = default;
  FieldGrid(int width, int height, T value = T{})
      : width(width), height(height), data(static_cast<std::size_t>(width) * height, value) {}
  T& operator()(int x, int y) { return data[static_cast<std::size_t>(y) * width + x]; }
  const T& operator()(int x, int y) const { return data[static_cast<std::size_t>(y) * width + x]; }
};

}  // namespace quadrille

#pragma once

#include <algorithm>
#include <vector>

namespace quadrille {

/// Leaves one of each, ascending.
template <class T>
void remove_duplicates(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace quadrille

#include "panel_layout.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace quadrille::viewer {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Array2d;

constexpr double kGap = 10;  // window pixels between texts, and around them

/// The boxes that are taken.
class Room {
 public:
  void take(const AlignedBox2d& box) {
    if (!box.isEmpty()) taken_.push_back(box);
  }
  bool is_free(const AlignedBox2d& box) const {
    return box.isEmpty() || std::ranges::none_of(taken_, [&](const AlignedBox2d& other) {
             return box.intersects(other);
           });
  }

 private:
  std::vector<AlignedBox2d> taken_;
};

/// Empty when there is nothing to place.
AlignedBox2d box_at(double left, double bottom, const Array2d& size) {
  if ((size <= 0).any()) return {};
  return {Eigen::Vector2d(left, bottom), Eigen::Vector2d(left + size.x(), bottom + size.y())};
}

AlignedBox2d place_status(const Array2d& size, const AlignedBox2d& sliders) {
  const AlignedBox2d box = box_at(kGap, kGap, size);
  if (sliders.isEmpty() || box.isEmpty() || !box.intersects(sliders)) return box;
  return box_at(kGap, sliders.max().y() + kGap, size);
}

}  // namespace

int panel_font_size(const Array2d& window) {
  constexpr double kColumns = 50, kRows = 30;
  constexpr int kLeast = 9, kMost = 14;
  return std::clamp(static_cast<int>(std::min(window.x() / kColumns, window.y() / kRows)), kLeast,
                    kMost);
}

ForEachPanel<AlignedBox2d> lay_out_panels(const ForEachPanel<Array2d>& sizes, const Array2d& window,
                                          const AlignedBox2d& sliders) {
  ForEachPanel<AlignedBox2d> boxes;
  Room room;
  room.take(sliders);
  boxes.status = place_status(sizes.status, sliders);
  room.take(boxes.status);
  boxes.help =
      box_at((window.x() - sizes.help.x()) / 2, (window.y() - sizes.help.y()) / 2, sizes.help);
  if (!room.is_free(boxes.help)) boxes.help.setEmpty();
  room.take(boxes.help);

  const Array2d top = window - kGap;
  const AlignedBox2d list = box_at(kGap, top.y() - sizes.layers.y(), sizes.layers);
  const AlignedBox2d right =
      box_at(top.x() - sizes.numbers.x(), top.y() - sizes.numbers.y(), sizes.numbers);
  if (list.isEmpty() || !room.is_free(list)) {
    if (room.is_free(right)) boxes.numbers = right;
    return boxes;
  }
  const AlignedBox2d below = box_at(kGap, list.min().y() - kGap - sizes.numbers.y(), sizes.numbers);
  const bool is_beside = right.isEmpty() || (room.is_free(right) && !right.intersects(list));
  const bool is_below = !is_beside && below.min().y() >= kGap && room.is_free(below);
  if (is_beside || is_below) {
    boxes.layers = list;
    boxes.numbers = is_beside ? right : below;
  } else if (room.is_free(right)) {
    boxes.numbers = right;
  } else {
    boxes.layers = list;
  }
  return boxes;
}

}  // namespace quadrille::viewer

#include "panel_layout.h"

#include <gtest/gtest.h>

#include <vector>

namespace quadrille::viewer {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Array2d;
using Eigen::Vector2d;

/// About the texts of a window, in characters, at the window's font.
ForEachPanel<Array2d> sizes_for(const Array2d& window, bool help) {
  const Array2d character = Array2d(0.6, 1.1) * panel_font_size(window);
  return {character * Array2d(54, 12), character * Array2d(36, 7), character * Array2d(38, 2),
          help ? Array2d(character * Array2d(52, 14)) : Array2d(0, 0)};
}

AlignedBox2d sliders_of(const Array2d& window) {
  return {Vector2d(0.54 * window.x(), 0.01 * window.y()),
          Vector2d(0.995 * window.x(), 0.11 * window.y())};
}

TEST(PanelLayout, NoTextCoversAnother) {
  for (double width = 100; width <= 1600; width += 25) {
    for (double height = 100; height <= 1000; height += 50) {
      for (const bool help : {false, true}) {
        const Array2d window(width, height);
        const AlignedBox2d sliders = sliders_of(window);
        const auto boxes = lay_out_panels(sizes_for(window, help), window, sliders);
        const std::vector<AlignedBox2d> all = {boxes.layers, boxes.numbers, boxes.status,
                                               boxes.help, sliders};
        for (std::size_t i = 0; i < all.size(); ++i) {
          for (std::size_t j = 0; j < i; ++j) {
            EXPECT_TRUE(all[i].isEmpty() || all[j].isEmpty() || !all[i].intersects(all[j]))
                << i << " and " << j << " at " << width << " x " << height;
          }
        }
        EXPECT_FALSE(boxes.status.isEmpty());
      }
    }
  }
}

TEST(PanelLayout, EverythingIsShownWhereThereIsRoom) {
  for (const Array2d& window : {Array2d(1200, 800), Array2d(700, 500), Array2d(400, 400)}) {
    const auto boxes = lay_out_panels(sizes_for(window, false), window, sliders_of(window));
    EXPECT_FALSE(boxes.layers.isEmpty());
    EXPECT_FALSE(boxes.numbers.isEmpty()) << window.transpose();
  }
  const Array2d large(1920, 1080);
  const auto boxes = lay_out_panels(sizes_for(large, true), large, sliders_of(large));
  EXPECT_FALSE(boxes.layers.isEmpty());
  EXPECT_FALSE(boxes.help.isEmpty());
  EXPECT_FALSE(boxes.numbers.isEmpty());
}

TEST(PanelLayout, NumbersTakeThePlaceOfTheList) {
  const Array2d window(330, 200);
  const auto boxes = lay_out_panels(sizes_for(window, false), window, {});
  EXPECT_TRUE(boxes.layers.isEmpty());
  EXPECT_FALSE(boxes.numbers.isEmpty());
}

TEST(PanelLayout, WhatIsNotWantedTakesNoRoom) {
  const auto boxes = lay_out_panels({{0, 0}, {0, 0}, {0, 0}, {0, 0}}, {1200, 800}, {});
  EXPECT_TRUE(boxes.layers.isEmpty() && boxes.numbers.isEmpty() && boxes.status.isEmpty() &&
              boxes.help.isEmpty());
}

}  // namespace
}  // namespace quadrille::viewer

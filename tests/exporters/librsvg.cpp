#include "librsvg.h"

#include <gtest/gtest.h>

#include "quadrille/image_file.h"
#include "support/programs.h"

namespace quadrille::test {

Raster drawn_by_librsvg(const std::filesystem::path& svg, const std::array<int, 2>& size) {
  const auto png = std::filesystem::path(svg).replace_extension(".png");
  std::string log;
  EXPECT_EQ(run({"rsvg-convert", "--unlimited", "-w", std::to_string(size[0]), "-h",
                 std::to_string(size[1]), "-o", png, svg},
                &log),
            0)
      << log;
  return load_image(png);
}

}  // namespace quadrille::test

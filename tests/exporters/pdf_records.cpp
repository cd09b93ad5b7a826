#include "pdf_records.h"

#include <gtest/gtest.h>
#include <zlib.h>

namespace quadrille::test {

std::vector<std::uint8_t> inflated(ScratchFile& scratch, const CoonsShading& shading) {
  std::vector<std::uint8_t> stored;
  scratch.read(shading.data, [&](ScratchFile::Bytes part) {
    stored.insert(stored.end(), part.begin(), part.end());
  });
  std::vector<std::uint8_t> rows(64 << 20);
  uLongf size = rows.size();
  EXPECT_EQ(uncompress(rows.data(), &size, stored.data(), stored.size()), Z_OK);
  const std::size_t row = shading.record_bytes;
  EXPECT_EQ(size % (row + 1), 0u);
  std::vector<std::uint8_t> data;
  for (std::size_t begin = 0; begin < size; begin += row + 1) {
    EXPECT_EQ(rows[begin], 2);
    for (std::size_t i = 0; i < row; ++i) {
      const int above = begin > 0 ? data[data.size() - row] : 0;
      data.push_back(static_cast<std::uint8_t>(rows[begin + 1 + i] + above));
    }
  }
  return data;
}

std::vector<ReadPatch> patches_in(const std::vector<std::uint8_t>& data,
                                  const CoordinateGrid& grid) {
  std::vector<ReadPatch> patches;
  std::size_t at = 0;
  const auto coordinate = [&](int axis) {
    std::uint32_t number = 0;
    for (int k = 0; k < grid.bits / 8; ++k) number = number << 8 | data.at(at++);
    return grid.origin[axis] + grid.unit * number;
  };
  while (at < data.size()) {
    const int flag = data.at(at++);
    ReadPatch patch;
    patch.shares_side = flag > 0;
    if (flag > 0) {
      const ReadPatch& before = patches.back();
      for (int k = 0; k < 4; ++k) patch.points[k] = before.points[(3 * flag + k) % 12];
      for (int k = 0; k < 2; ++k) patch.colors[k] = before.colors[(flag + k) % 4];
    }
    for (int k = flag > 0 ? 4 : 0; k < 12; ++k) {
      const double x = coordinate(0);
      patch.points[k] = {x, coordinate(1)};
    }
    for (int k = flag > 0 ? 2 : 0; k < 4; ++k) {
      for (int& channel : patch.colors[k]) channel = data.at(at++);
    }
    patches.push_back(patch);
  }
  return patches;
}

}  // namespace quadrille::test

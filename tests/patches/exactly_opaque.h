#pragma once

#include <gtest/gtest.h>

#include "quadrille/patch_mesh.h"

namespace quadrille::testing {

inline void expect_exactly_opaque(const PatchMesh& patches) {
  EXPECT_TRUE(patches.opaque);
  for (const Wedge& w : patches.wedges) {
    EXPECT_EQ(w.value[3], 1);
    EXPECT_EQ(w.dx[3], 0);
    EXPECT_EQ(w.dy[3], 0);
    EXPECT_EQ(w.twist[3], 0);
  }
}

}  // namespace quadrille::testing

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/simplify.h"

#include <gtest/gtest.h>

namespace ods::simplify_test {

struct Sheet {
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
};

// A square of cells x cells, in the plane y = 0 but for a bump in the middle.
Sheet sheet(uint cells, float bump) {
  Sheet sheet;
  for (uint z = 0; z <= cells; z++) {
    for (uint x = 0; x <= cells; x++) {
      const bool is_middle = 2 * x == cells && 2 * z == cells;
      sheet.positions.emplace_back(static_cast<float>(x), is_middle ? bump : 0.0f, static_cast<float>(z));
    }
  }
  for (uint z = 0; z < cells; z++) {
    for (uint x = 0; x < cells; x++) {
      const uint at = z * (cells + 1) + x, below = at + cells + 1;
      sheet.triangles.emplace_back(at, below, at + 1);
      sheet.triangles.emplace_back(at + 1, below, below + 1);
    }
  }
  return sheet;
}

TEST(Simplified, APlaneIsTwoTriangles) {
  const Sheet flat = sheet(8, 0.0f);
  EXPECT_EQ(simplified(flat.positions, flat.triangles, 0.01f).size(), 2u);
  EXPECT_TRUE(simplified({}, {}, 0.01f).empty());
}

TEST(Simplified, KeepsWhatIsLargerThanTheError) {
  const Sheet bumped = sheet(8, 0.5f);
  EXPECT_GT(simplified(bumped.positions, bumped.triangles, 0.01f).size(), 4u);
  EXPECT_EQ(simplified(bumped.positions, bumped.triangles, 0.6f).size(), 2u);
}

TEST(Simplified, KeepsBordersThatStay) {
  const Sheet flat = sheet(8, 0.0f);
  Sheet left = flat;
  left.triangles = simplified(flat.positions, flat.triangles, 0.01f, Borders::kStay);
  EXPECT_LT(left.triangles.size(), flat.triangles.size());
  const std::vector<uint> kept = leave_out_unused(left.positions, left.triangles);
  EXPECT_GE(kept.size(), 32u);  // of the border
  for (size_t i = 0; i < kept.size(); i++) EXPECT_EQ(left.positions[i], flat.positions[kept[i]]);
}

TEST(Simplified, FindsEqualPositions) {
  const std::vector<uint> first = first_equal({vec3(1.0f), vec3(2.0f), vec3(1.0f)});
  EXPECT_EQ(first[0], first[2]);
  EXPECT_NE(first[0], first[1]);
}

}  // namespace ods::simplify_test

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/stored_lenses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/picture/save.h"
#include "tests/support/temporary_folder.h"

namespace ods::stored_lenses_test {

// The place of a direction in the whole eyes, less the bars around both together.
TEST(StoredPicture, BlackBarsMoveEachEye) {
  const TemporaryFolder folder;
  const std::string path = folder.path("film.png");
  Picture picture;
  picture.eyes.resize(1);
  picture.eyes[0].eye = kMono, picture.eyes[0].radiance = Image(320, 180, 3);
  SaveOptions save;
  save.layout = Layout::kSeparate;
  save_picture(picture, save, path);
  OpenOptions open;
  open.format.layout = Layout::kSideBySide, open.format.projection = find_projection("vr180")->setting;
  open.format.bars.top = open.format.bars.bottom = 10;
  const StoredPicture beside = open_picture(path, open);
  open.format.layout = Layout::kTopBottom, open.format.projection = find_projection("lat-long")->setting;
  const StoredPicture stacked = open_picture(path, open);
  ASSERT_EQ(beside.maps.size(), 2u);
  ASSERT_EQ(stacked.maps.size(), 2u);
  const float half = std::sqrt(0.5f);
  for (const vec3 d : {vec3(0.0f, 0.0f, -1.0f), vec3(0.0f, half, -half), vec3(half, 0.0f, -half)}) {
    const vec2 flat = place_of(make_projection(find_projection("vr180")->setting), d).uv;
    const vec2 round = place_of(make_projection(find_projection("lat-long")->setting), d).uv;
    for (const size_t eye : {0u, 1u}) {
      const ImagePoint in_half = beside.maps[eye]->place(d), in_whole = stacked.maps[eye]->place(d);
      EXPECT_TRUE(in_half.seen && in_whole.seen);
      EXPECT_NEAR(in_half.uv.x, flat.x, 1e-5f);
      EXPECT_NEAR(in_half.uv.y, (10.0f + 160.0f * flat.y) / 180.0f, 1e-5f);
      EXPECT_NEAR(in_whole.uv.y, ((eye == 0 ? 10.0f : 0.0f) + 80.0f * round.y) / 90.0f, 1e-5f);
    }
  }
  EXPECT_FALSE(beside.maps[0]->place(vec3(0.0f, 0.0f, 1.0f)).seen);
}

}  // namespace ods::stored_lenses_test

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/others.h"

#include <gtest/gtest.h>

#include "ods/identify/identify.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/unknown_files.h"

namespace ods {
namespace {

// A small anaglyph of distant things: only what is below has parallax.
TEST(AnaglyphMark, AFewNearThingsAreAReasonForDoubt) {
  constexpr int kNear = 3;  // pixels
  const Extent size{420, 280};
  const TemporaryFolder folder;
  StereoCamera camera;
  camera.projection = find_projection("perspective")->setting;
  camera.projection.aspect = 1.5f;
  for (const World world : {World::kField, World::kHall}) {
    const Image far = seen_in(world, camera, kMono, size);
    for (const bool is_anaglyph : {true, false}) {
      Image image = far;
      for (int y = size.height - 28; is_anaglyph && y < size.height; y++) {
        for (int x = kNear; x < size.width / 2; x++) image.at(x, y)[0] = far.at(x - kNear, y)[0];
      }
      const std::string path = folder.path("file.png");
      write_unknown(
          path, {std::nullopt, camera.projection}, [&](int, const ProjectionSetting&, Extent) { return image; }, size);
      const Identity seen = identify(open_unknown(path));
      EXPECT_EQ(seen.is_anaglyph, is_anaglyph) << world_name(world);
      EXPECT_FALSE(is_anaglyph && seen.is_sure()) << world_name(world);
      EXPECT_EQ(seen.best().projection.kind, kPerspective) << world_name(world);
    }
  }
}

}  // namespace
}  // namespace ods

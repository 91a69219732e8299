// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures that seem to have two eyes and do not: noise in a pattern, a world that repeats itself, and the same picture
// twice; and eyes of cameras that are not level.
#include "ods/identify/cuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ods/identify/identify.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/unknown_files.h"

namespace ods {
namespace {

ProjectionSetting window(Extent size) {
  ProjectionSetting setting = find_projection("perspective")->setting;
  setting.aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
  return setting;
}

Image window_of(World world, int eye, Extent size) {
  StereoCamera camera;
  camera.projection = window(size);
  return seen_in(world, camera, eye, size, eye != kMono);
}

class Doubtful : public testing::Test {
 protected:
  TemporaryFolder folder;

  StoredPicture file_of(const Truth& truth, const TwoEyes& eyes, Extent size) const {
    const std::string path = folder.path(unknown_name(truth));
    write_unknown(path, truth, eyes, size);
    return open_unknown(path);
  }
};

// As from a generator or a camera's colour filter: every other pixel is a little brighter.
TEST_F(Doubtful, ACheckerboardOfNoiseIsOneEye) {
  const Extent size{640, 480};
  for (const World world : {World::kField, World::kHall}) {
    Image image = window_of(world, kMono, size);
    for (int y = 0; y < size.height; y++) {
      for (int x = 0; x < size.width; x++) {
        for (int c = 0; c < 3; c++) image.at(x, y)[c] *= (x + y) % 2 == 0 ? 1.06f : 0.94f;
      }
    }
    const std::string path = folder.path("file.png");
    write_unknown(
        path, {std::nullopt, window(size)}, [&](int, const ProjectionSetting&, Extent) { return image; }, size);
    const Identity seen = identify(open_unknown(path));
    ASSERT_FALSE(seen.readings.empty());
    EXPECT_FALSE(seen.best().layout) << world_name(world) << ": " << reading_text(seen.best());
  }
}

TEST_F(Doubtful, TheSamePictureTwiceIsNotSure) {
  for (const World world : {World::kField, World::kHall}) {
    for (const char* name : {"vr180", "lat-long"}) {
      const Truth truth{Layout::kSideBySide, find_projection(name)->setting};
      const Extent size = unknown_eye(truth.projection, 512);
      StereoCamera camera;
      camera.projection = truth.projection;
      const Image image = seen_in(world, camera, kMono, size);
      EXPECT_FALSE(identify(file_of(
                                truth, [&](int, const ProjectionSetting&, Extent) { return image; }, size))
                       .is_sure())
          << world_name(world) << ' ' << name;
    }
  }
}

// A hall with a floor of tiles, and walls that are alike. The viewer is not in its middle, so what is ahead resembles
// what is behind without being at the same place.
Image tiled_hall(float wall, vec2 viewer) {
  constexpr float kPi = 3.14159265f, kFloor = -1.6f, kCeiling = 3.0f;
  const auto tile = [](float a, float b) {
    return (static_cast<int>(std::floor(a)) + static_cast<int>(std::floor(b))) % 2 == 0 ? 0.4f : 0.12f;
  };
  Image image(1024, 512, 3);
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      const float up = 0.5f * kPi - (static_cast<float>(y) + 0.5f) / 512.0f * kPi;
      const float around = (static_cast<float>(x) + 0.5f) / 512.0f * kPi;
      const vec3 to(std::cos(up) * std::sin(around), std::sin(up), -std::cos(up) * std::cos(around));
      const float height = to.y > 0.0f ? kCeiling / to.y : kFloor / to.y;
      const float aside = ((to.x > 0.0f ? wall : -wall) - viewer.x) / to.x;
      const float ahead = ((to.z > 0.0f ? wall : -wall) - viewer.y) / to.z;
      const float away = std::min({height, aside, ahead});
      const vec3 at = away * to + vec3(viewer.x, 0.0f, viewer.y);
      const float light = away == height  ? tile(at.x, at.z) * (to.y > 0.0f ? 0.7f : 1.0f)
                          : away == aside ? tile(at.z + 0.5f, 1.5f * at.y)
                                          : tile(at.x + 0.5f, 1.5f * at.y);
      std::fill_n(image.at(x, y), 3, light);
    }
  }
  return image;
}

TEST_F(Doubtful, AHallThatIsAlikeAheadAndBehindIsOneEye) {
  const Truth truth{std::nullopt, find_projection("lat-long")->setting};
  for (const auto& [wall, viewer] : {std::pair{5.0f, vec2(0.2f, 0.2f)}, {9.0f, vec2(0.2f, 0.35f)}}) {
    const Image hall = tiled_hall(wall, viewer);
    const Identity seen =
        identify(file_of(truth, [&](int, const ProjectionSetting&, Extent) { return hall; }, {1024, 512}));
    ASSERT_FALSE(seen.readings.empty());
    EXPECT_EQ(reading_text(seen.best()), "one eye, lat-long") << wall;
  }
}

// Windows of two eyes, the right one of which is shifted as a whole, by so many pixels.
TwoEyes shifted_eyes(World world, Extent size, int across, int down) {
  return [=](int eye, const ProjectionSetting&, Extent) {
    const Image image = window_of(world, eye, {size.width + across, size.height + down});
    Image part(size.width, size.height, 3);
    for (int y = 0; y < size.height; y++) {
      for (int x = 0; x < size.width; x++) {
        const float* from = eye == kLeft ? image.at(x, y) : image.at(x + across, y + down);
        for (int c = 0; c < 3; c++) part.at(x, y)[c] = from[c];
      }
    }
    return part;
  };
}

// As on stereo cards, whose prints were cut by hand.
TEST_F(Doubtful, EyesThatAreShiftedAsAWholeAreTwoEyes) {
  const Extent size{720, 480};
  for (const World world : {World::kField, World::kHall}) {
    const TwoEyes eyes = shifted_eyes(world, size, 60, 18);
    const Identity seen = identify(file_of({Layout::kSideBySide, window(size)}, eyes, size));
    ASSERT_FALSE(seen.readings.empty());
    ASSERT_TRUE(seen.best().layout) << world_name(world) << ": " << reading_text(seen.best());
    EXPECT_EQ(arrangement_of(*seen.best().layout).how, EyePacking::kBeside) << reading_text(seen.best());
  }
}

// A cube has the shape of a photograph.
TEST_F(Doubtful, CamerasThatAreNotLevelShowNoCube) {
  const Extent size{720, 480};
  FormatHint pair;
  pair.layout = Layout::kSideBySide;
  for (const World world : {World::kField, World::kHall}) {
    const TwoEyes eyes = shifted_eyes(world, size, 0, 12);
    const Identity seen = identify(file_of({Layout::kSideBySide, window(size)}, eyes, size), pair);
    ASSERT_FALSE(seen.readings.empty());
    EXPECT_EQ(seen.best().projection.kind, kPerspective) << world_name(world) << ": " << reading_text(seen.best());
  }
}

}  // namespace
}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Raw files of simulated 360 cameras are compared with the truth: circles and field of view.
#include "ods/identify/front_and_back.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ods/identify/open_media.h"
#include "ods/picture/save.h"
#include "tests/support/simulated_camera.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/unknown_files.h"
#include "tests/support/worlds.h"

namespace ods {
namespace {

FisheyeLens lens(float x, float y, float radius, float fov, float yaw = 0.0f) {
  FisheyeLens lens;
  lens.center = vec2(x, y), lens.radius = radius, lens.fov = fov, lens.yaw = yaw;
  return lens;
}

struct Kind {
  const char* name;
  SimulatedCamera camera;
  int quality = 90;
};

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  const auto add = [&](const char* name, float fov) -> SimulatedCamera& {
    SimulatedCamera camera;
    camera.lenses = {lens(240, 240, 236, fov), lens(240, 240, 236, fov, 180)};
    all.push_back({name, camera});
    return all.back().camera;
  };
  add("clean", 195);
  add("glow", 195).flaws = {0.08f, 0.08f, 0.4f, 0.02f, 0.01f};
  add("strong_glow", 205).flaws = {0.12f, 0.15f, 0.3f, 0.01f, 0.015f};
  add("without_overlap", 180);
  add("without_overlap_in_glow", 180).flaws = {0.08f, 0.15f, 0.3f, 0.01f, 0.01f};
  SimulatedCamera& stacked = add("stacked", 200);
  stacked.layout = Layout::kTopBottom;
  SimulatedCamera& cut = add("cut", 192);
  cut.half = {480, 400}, cut.lenses[0].center.y = 200, cut.lenses[1].center.y = 200;
  SimulatedCamera& loose = add("loose", 195);
  loose.lenses[0] = lens(233.4f, 243.1f, 210, 195), loose.lenses[1] = lens(251.8f, 236.2f, 210, 195, 180.8f);
  loose.lenses[1].pitch = 0.9f, loose.lenses[1].roll = -1.2f, loose.flaws.noise = 0.02f;
  add("poor_jpeg", 190).flaws = {0.05f, 0.1f, 0.5f, 0.01f, 0.01f};
  all.back().quality = 60;
  SimulatedCamera& turned = add("turned", 200);
  turned.lenses[0].roll = 90, turned.lenses[1].roll = -90, turned.flaws.black = 0.04f;
  SimulatedCamera& wide = add("wide", 220);
  wide.flaws.vignette = 0.6f;
  return all;
}

float shown_light(World world, vec3 origin, vec3 direction) {
  const vec3 light = world_at(world, origin, direction);
  return std::pow(std::clamp(dot(light, vec3(0.3f, 0.6f, 0.1f)), 0.0f, 1.0f), 1.0f / 2.2f);
}

class RawFile : public testing::TestWithParam<std::tuple<Kind, World>> {};

TEST_P(RawFile, IsMeasured) {
  const auto& [kind, world] = GetParam();
  const TemporaryFolder folder;
  const World place = world;
  const LensWorld shown = [&](int, vec3 direction) { return shown_light(place, vec3(0.0f), direction); };
  write_raw_file(folder.path("raw.jpg"), kind.camera, shown, kind.quality);
  const MediaFile media = open_media(folder.path("raw.jpg"));
  ASSERT_EQ(media.hint.lenses.size(), 2u);
  EXPECT_TRUE(media.hint.front_and_back);
  for (const size_t i : {0u, 1u}) {
    const FisheyeLens &found = media.hint.lenses[i], &truth = kind.camera.lenses[i];
    EXPECT_NEAR(found.center.x, truth.center.x, 0.012f * truth.radius);
    EXPECT_NEAR(found.center.y, truth.center.y, 0.012f * truth.radius);
    EXPECT_NEAR(found.radius, truth.radius, 0.012f * truth.radius);
    EXPECT_NEAR(found.fov * truth.radius / found.radius, truth.fov, 1.5f);
  }
  // Light shows which way is up, and both lenses turn with it.
  const float turn = media.hint.lenses[0].roll + media.hint.lenses[1].roll,
              true_turn = kind.camera.lenses[0].roll + kind.camera.lenses[1].roll;
  EXPECT_NEAR(std::remainder(turn - true_turn, 360.0f), 0.0f, 1.0f);
}

INSTANTIATE_TEST_SUITE_P(All, RawFile,
                         testing::Combine(testing::ValuesIn(kinds()), testing::Values(World::kHall, World::kField)),
                         [](const auto& each) {
                           return std::string(std::get<0>(each.param).name) + "_" + world_name(std::get<1>(each.param));
                         });

// FFmpeg's v360 fills the corners of both halves; its field of view is that from edge to edge.
TEST(FilledHalves, AreTwoFisheyes) {
  const TemporaryFolder folder;
  constexpr float kCorner = 1.42f;
  for (const World world : {World::kHall, World::kField}) {
    for (const float fov : {180.0f, 190.0f, 200.0f, 220.0f}) {
      SimulatedCamera camera;
      for (FisheyeLens& each : camera.lenses) each = lens(240, 240, kCorner * 240, kCorner * fov);
      camera.lenses[1].yaw = 180.0f;
      const LensWorld shown = [&](int, vec3 direction) { return shown_light(world, vec3(0.0f), direction); };
      write_raw_file(folder.path("raw.jpg"), camera, shown, 85);
      const MediaFile media = open_media(folder.path("raw.jpg"));
      ASSERT_EQ(media.hint.lenses.size(), 2u) << world_name(world) << fov;
      EXPECT_TRUE(media.hint.front_and_back);
      EXPECT_NEAR(media.hint.lenses[0].fov * 240.0f / media.hint.lenses[0].radius, fov, 1.5f) << world_name(world);
    }
  }
}

// Halves of other pictures do not overlap as lenses do.
TEST(FilledHalves, AreNotSeenInPanoramas) {
  const TemporaryFolder folder;
  for (const World world : kWorlds) {
    for (const char* name : {"lat-long", "perspective", "cylinder"}) {
      ProjectionSetting projection = find_projection(name)->setting;
      projection.aspect = 2.0f;
      const TwoEyes eyes = [&](int eye, const ProjectionSetting& setting, Extent size) {
        StereoCamera camera;
        camera.projection = setting;
        return seen_in(world, camera, eye, size);
      };
      write_unknown(folder.path("a.jpg"), {std::nullopt, projection}, eyes, {960, 480});
      EXPECT_TRUE(open_media(folder.path("a.jpg")).hint.lenses.empty()) << world_name(world) << name;
    }
  }
}

// A screenshot of a headset, all red in a headset's test: two barrels of light on black, a word before each lens.
TEST(FilledHalves, AreNotSeenInAHeadsetsScreenshot) {
  constexpr int kSide = 480;
  const auto light = [](int which, float u, float v) {
    const float word = which == 0 ? 0.05f : -0.05f;  // the lens's middle, nearer to the other one
    const float side = std::pow(std::abs(u - word) / 0.86f, 4.0f) + std::pow(std::abs(v) / 0.86f, 4.0f);
    if (side > 1.0f) return 0.0f;
    const int column = static_cast<int>(std::floor((u - word + 0.3f) * 40.0f)), row = static_cast<int>(v * 40.0f);
    const bool is_letter = column >= 0 && column < 24 && std::abs(row) < 3 && (column * 7 + row * row * 5) % 3 == 0;
    return is_letter ? 0.0f : 0.21f * std::clamp(8.0f * (1.0f - side), 0.0f, 1.0f);
  };
  EyeImage both;
  both.eye = kMono;
  both.radiance = Image(2 * kSide, kSide, 3);
  for (int y = 0; y < kSide; y++) {
    for (int x = 0; x < 2 * kSide; x++) {
      const float u = 2.0f * (static_cast<float>(x % kSide) + 0.5f) / kSide - 1.0f;
      const float value = light(x / kSide, u, 2.0f * (static_cast<float>(y) + 0.5f) / kSide - 1.0f);
      std::fill_n(both.radiance.at(x, y), 3, value);
    }
  }
  Picture picture;
  picture.eyes.push_back(std::move(both));
  SaveOptions options;
  options.tone = ToneCurve::kLinear;
  const TemporaryFolder folder;
  save_picture(picture, options, folder.path("shot.jpg"));
  EXPECT_TRUE(open_media(folder.path("shot.jpg")).hint.lenses.empty());
}

// A format that the pixels showed has their evidence as its reason, not a request.
TEST(RawFileReason, IsWhatThePixelsShow) {
  const TemporaryFolder folder;
  const LensWorld shown = [](int, vec3 direction) { return shown_light(World::kHall, vec3(0.0f), direction); };
  write_raw_file(folder.path("raw.jpg"), kinds()[0].camera, shown, 90);
  const MediaFile media = open_media(folder.path("raw.jpg"));
  EXPECT_EQ(media.format.layout.source, FormatSource::kPixels);
  EXPECT_NE(media.format.layout.reason.find("look ahead and back, 19"), std::string::npos)
      << media.format.layout.reason;
  EXPECT_NE(media.format.layout.reason.find("they agree by 0."), std::string::npos) << media.format.layout.reason;
  EXPECT_TRUE(media.format.front_and_back);
  MediaOptions asked;
  asked.known.layout = Layout::kSideBySide, asked.known.projection = find_projection("fisheye")->setting;
  EXPECT_EQ(open_media(folder.path("raw.jpg"), asked).format.layout.source, FormatSource::kOptions);
}

// Two lenses that look ahead: the eyes differ by parallax, and the right one may come first.
TEST(RawStereoFile, IsAPairInItsOrder) {
  const TemporaryFolder folder;
  for (const bool right_first : {false, true}) {
    for (const bool is_cut : {false, true}) {
      SimulatedCamera camera;
      camera.half = is_cut ? Extent{400, 534} : Extent{480, 480};
      const float radius = is_cut ? 180.0f : 240.0f;
      const vec2 middle = 0.5f * vec2(static_cast<float>(camera.half.width), static_cast<float>(camera.half.height));
      camera.lenses[0] = camera.lenses[1] = lens(middle.x, middle.y, radius, 190);
      camera.flaws = {0.08f, 0.05f, 0.3f, 0.01f, 0.01f};
      const LensWorld shown = [&](int which, vec3 direction) {
        const float side = (which == 0) == right_first ? 0.032f : -0.032f;
        return shown_light(World::kHall, vec3(side, 0.0f, 0.0f), direction);
      };
      write_raw_file(folder.path("raw.jpg"), camera, shown, 90);
      const MediaFile media = open_media(folder.path("raw.jpg"));
      ASSERT_EQ(media.hint.lenses.size(), 2u) << right_first << is_cut;
      EXPECT_FALSE(media.hint.front_and_back);
      EXPECT_EQ(media.hint.layout, right_first ? Layout::kCrossEyed : Layout::kSideBySide) << is_cut;
      for (const FisheyeLens& found : media.hint.lenses) {
        EXPECT_NEAR(length(found.center - middle), 0.0f, 0.012f * radius) << right_first << is_cut;
        EXPECT_NEAR(found.radius, radius, 0.012f * radius) << right_first << is_cut;
      }
    }
  }
}

// A clear sky and even ground show no angle: the usual one is assumed, and a note asks for the right one.
TEST(RawFileOfNothing, IsToldToBeUnknown) {
  const TemporaryFolder folder;
  SimulatedCamera camera = kinds()[0].camera;
  camera.flaws.noise = 0.01f;
  const LensWorld shown = [](int, vec3 d) { return 0.5f + 0.3f * d.y + 0.15f * d.z; };
  write_raw_file(folder.path("raw.jpg"), camera, shown, 95);
  const MediaFile media = open_media(folder.path("raw.jpg"));
  ASSERT_TRUE(media.hint.front_and_back);
  EXPECT_EQ(media.hint.lenses[0].fov, 195.0f);
  EXPECT_NE(media.notes.at(0).find("`input-fov`"), std::string::npos);
  MediaOptions options;
  options.known.projection = find_projection("fisheye")->setting;
  options.known.projection->fov = 200.0f, options.known.front_and_back = true;
  EXPECT_EQ(open_media(folder.path("raw.jpg"), options).hint.lenses.at(0).fov, 200.0f);
}

}  // namespace
}  // namespace ods

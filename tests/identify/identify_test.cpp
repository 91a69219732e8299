// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures without metadata are recognised by their pixels; bench/identify_bench.cpp measures how often.
#include "ods/identify/identify.h"

#include <gtest/gtest.h>

#include <tuple>

#include "ods/base/error.h"
#include "ods/identify/eye_match.h"
#include "ods/identify/marks.h"
#include "ods/identify/open_media.h"
#include "ods/identify/pairs.h"
#include "ods/identify/thumbnail.h"
#include "ods/image/tone.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/unknown_files.h"

namespace ods {
namespace {

ProjectionSetting named(const char* name) {
  return find_projection(name)->setting;
}

// Many tests see the same.
Image seen(World world, const StereoCamera& camera, int eye, Extent size, bool is_pair = false) {
  struct Seen {
    std::tuple<World, int, int, int, bool> what;
    StereoCamera camera;
    Image image;
  };
  static std::vector<Seen> pictures;
  const std::tuple what(world, eye, size.width, size.height, is_pair);
  const auto found = std::find_if(pictures.begin(), pictures.end(),
                                  [&](const Seen& each) { return each.what == what && each.camera == camera; });
  if (found != pictures.end()) return found->image;
  return pictures.emplace_back(Seen{what, camera, seen_in(world, camera, eye, size, is_pair)}).image;
}

Image eye_of(World world, const ProjectionSetting& projection, int eye = kMono, int pixels = 448) {
  StereoCamera camera;
  camera.projection = projection;
  return seen(world, camera, eye, unknown_eye(projection, pixels));
}

Image grey(const Image& image) {
  Image result(image.width, image.height, 1);
  for (size_t i = 0; i < result.pixels.size(); i++) {
    result.pixels[i] =
        0.2126f * image.pixels[3 * i] + 0.7152f * image.pixels[3 * i + 1] + 0.0722f * image.pixels[3 * i + 2];
  }
  return result;
}

// --- marks -----------------------------------------------------------------------------------------------------------

class MarksOfWorlds : public testing::TestWithParam<World> {};

TEST_P(MarksOfWorlds, OnlyFisheyesHaveAnEmptyCircle) {
  for (const NamedProjection& each : named_projections()) {
    if (each.name == "fisheye-polynomial") continue;
    const Marks marks = marks_of(shown(grey(eye_of(GetParam(), each.setting, kMono, 256))));
    EXPECT_EQ(marks.circle > 0.5, is_fisheye(each.setting.kind)) << each.name << " " << marks.circle;
    EXPECT_EQ(marks.circle < -0.5, !is_fisheye(each.setting.kind)) << each.name << " " << marks.circle;
  }
}

TEST_P(MarksOfWorlds, OnlyLatLongsHavePoles) {
  for (const char* name : {"lat-long", "vr180"}) {
    EXPECT_GT(marks_of(shown(grey(eye_of(GetParam(), named(name))))).poles, 0.5) << name;
  }
  for (const char* name : {"perspective", "eac-face", "cylinder"}) {
    EXPECT_LT(marks_of(shown(grey(eye_of(GetParam(), named(name))))).poles, 0.2) << name;
  }
}

TEST_P(MarksOfWorlds, OnlyWholeTurnsClose) {
  for (const char* name : {"lat-long", "cylinder"}) {
    EXPECT_GT(marks_of(shown(grey(eye_of(GetParam(), named(name))))).closes, 0.5) << name;
  }
  for (const char* name : {"vr180", "perspective", "eac-face"}) {
    EXPECT_LT(marks_of(shown(grey(eye_of(GetParam(), named(name))))).closes, -0.3) << name;
  }
}

TEST_P(MarksOfWorlds, FacesJoinAsTheirCubeHasThem) {
  for (const char* name : {"cube-3x2", "cube-6x1", "cube-1x6", "eac"}) {
    const Image eye = shown(grey(eye_of(GetParam(), named(name))));
    EXPECT_GT(faces_join(eye, named(name)), 0.5) << name;
  }
  const Image cube = shown(grey(eye_of(GetParam(), named("cube-3x2"))));
  EXPECT_LT(faces_join(cube, named("eac")), 0.0);
  EXPECT_GT(breaks_at_grid(cube, 3, 2), 0.3);
  if (GetParam() == World::kField) return;  // whose horizon is such a line
  EXPECT_LT(breaks_at_grid(shown(grey(eye_of(GetParam(), named("lat-long")))), 3, 2), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Worlds, MarksOfWorlds, testing::ValuesIn(kWorlds),
                         [](const auto& world) { return world_name(world.param); });

// --- eyes ------------------------------------------------------------------------------------------------------------

TEST(MatchEyes, TwoEyesMatchAndTwoPlacesDoNot) {
  for (const World world : kWorlds) {
    const Image left = grey(eye_of(world, named("vr180"), kLeft, 320)),
                right = grey(eye_of(world, named("vr180"), kRight, 320));
    EXPECT_GT(match_eyes({left, right}).mark(), 0.5) << world_name(world);
    StereoCamera behind;
    behind.projection = named("vr180");
    behind.yaw = 180.0f;
    const Image other = grey(seen(world, behind, kMono, {left.width, left.height}));
    EXPECT_LT(match_eyes({left, other}).mark(), -0.5) << world_name(world);
  }
}

TEST(ParallaxIn, IsLevelInTheRightProjectionAndTellsWhichEyeIsFirst) {
  for (const World world : {World::kHall, World::kCave}) {
    for (const char* name : {"fisheye", "dome"}) {
      const Image left = shown(grey(eye_of(world, named(name), kLeft)));
      const Image right = shown(grey(eye_of(world, named(name), kRight)));
      const Parallax parallax = parallax_in(find_pairs(left, right), named(name));
      EXPECT_GT(parallax.order, 0.3) << world_name(world) << " " << name;
      EXPECT_LT(parallax_in(find_pairs(right, left), named(name)).order, -0.3) << world_name(world) << " " << name;
      for (const char* other : {"mirror-ball", "eac", "cube-1x6"}) {
        EXPECT_LT(parallax_in(find_pairs(left, right), named(other)).level, parallax.level - 0.2)
            << world_name(world) << " " << name << " as " << other;
      }
    }
  }
}

// --- files -----------------------------------------------------------------------------------------------------------

class Unknown : public testing::Test {
 protected:
  Identity identity_of(World world, const Truth& truth, bool is_pair = false) {
    const TwoEyes eyes = [&](int eye, const ProjectionSetting& projection, Extent size) {
      StereoCamera camera;
      camera.projection = projection;
      return seen(world, camera, eye, size, is_pair);
    };
    const std::string path = folder.path(unknown_name(truth));
    write_unknown(path, truth, eyes, unknown_eye(truth.projection, 512));
    return identify(open_unknown(path));
  }

  TemporaryFolder folder;
};

// The two that were public and read wrongly: two square halves of the sphere one above the other, and two fisheyes
// side by side; each from two cameras.
TEST_F(Unknown, PhotosOfTwoLensesAreRecognised) {
  for (const World world : kWorlds) {
    for (const Truth& truth : {Truth{Layout::kTopBottom, named("vr180")}, Truth{Layout::kSideBySide, named("vr180")},
                               Truth{Layout::kSideBySide, named("fisheye")}}) {
      const Identity identity = identity_of(world, truth, true);
      ASSERT_FALSE(identity.readings.empty());
      EXPECT_TRUE(is_right(identity.best(), truth)) << world_name(world) << ": " << truth_text(truth) << ", but "
                                                    << reading_text(identity.best()) << " " << identity.reason;
    }
  }
}

// Every tile of a test room matches many others, and every wall all others.
TEST_F(Unknown, ARoomOfTilesIsNotReadWrongly) {
  const Layout beside = Layout::kSideBySide, stacked = Layout::kTopBottom;
  for (const Truth& truth :
       {Truth{std::nullopt, named("lat-long")}, Truth{stacked, named("lat-long")}, Truth{beside, named("lat-long")},
        Truth{beside, named("vr180")}, Truth{beside, named("fisheye")}, Truth{std::nullopt, named("cube-3x2")},
        Truth{stacked, named("cube-3x2")}, Truth{stacked, named("eac")}, Truth{std::nullopt, named("perspective")}}) {
    const Identity identity = identity_of(World::kTiles, truth);
    const Verdict verdict = verdict_on(identity, truth);
    EXPECT_TRUE(verdict != Verdict::kWrong && verdict != Verdict::kSureAndWrong)
        << truth_text(truth) << ", but " << (identity.readings.empty() ? "nothing" : reading_text(identity.best()))
        << " " << identity.reason;
  }
}

// A reading that pixels do not show is not sure.
TEST_F(Unknown, ALensIsNotSure) {
  const Identity identity = identity_of(World::kCave, {std::nullopt, named("fisheye-equisolid")});
  ASSERT_GE(identity.readings.size(), 2u);
  EXPECT_FALSE(identity.is_sure());
  EXPECT_EQ(verdict_on(identity, {std::nullopt, named("fisheye-equisolid")}), Verdict::kNamed);
  const std::string doubt = doubt_text(identity);
  EXPECT_NE(doubt.find("one eye, fisheye ("), std::string::npos) << doubt;
  EXPECT_NE(doubt.find("one eye, fisheye-equisolid ("), std::string::npos) << doubt;
  EXPECT_NE(doubt.find("`layout` and `projection`"), std::string::npos) << doubt;
}

// Faces in an order that is none of ours are told, whatever the layout, and no reading is sure.
TEST_F(Unknown, FacesInAnotherOrderAreTold) {
  const TwoEyes eyes = [&](int eye, const ProjectionSetting& projection, Extent size) {
    const Image own = eye_of(World::kCave, projection, eye, 512);
    Image other = own;
    for (int y = 0; y < size.height; y++) {
      for (int x = 0; x < size.width; x++) {
        std::copy_n(own.at((x + size.width / 3) % size.width, (y + size.height / 2) % size.height), 3, other.at(x, y));
      }
    }
    return other;
  };
  for (const Truth& truth : {Truth{std::nullopt, named("cube-3x2")}, Truth{Layout::kTopBottom, named("cube-3x2")}}) {
    const std::string path = folder.path("file.jpg");
    write_unknown(path, truth, eyes, unknown_eye(truth.projection, 512));
    const Identity identity = identify(open_unknown(path));
    EXPECT_TRUE(identity.has_other_faces) << truth_text(truth);
    EXPECT_FALSE(identity.is_sure()) << truth_text(truth);
    EXPECT_NE(doubt_text(identity).find("faces of a cube in another order"), std::string::npos);
    EXPECT_FALSE(identity_of(World::kCave, truth).has_other_faces) << truth_text(truth);
  }
}

using Change = std::function<Image(const Image&)>;

// Two eyes, of two cameras in vr180 beside each other, else of ODS above each other, as a file, changed by `change`.
StoredPicture stereo_file(const TemporaryFolder& folder, World world, bool is_half, const Change& change) {
  Image both(960, is_half ? 480 : 960, 3);
  for (const int eye : {kLeft, kRight}) {
    StereoCamera camera;
    camera.projection = named(is_half ? "vr180" : "lat-long");
    const Image own = seen(world, camera, eye, {is_half ? 480 : 960, 480}, is_half);
    const int from = eye == kLeft ? 0 : 480;
    for (int y = 0; y < own.height; y++) {
      std::copy_n(own.at(0, y), 3 * own.width, is_half ? both.at(from, y) : both.at(0, from + y));
    }
  }
  const std::string path = folder.path("file.jpg");
  Picture picture;
  picture.eyes.resize(1);
  picture.eyes[0].eye = kMono, picture.eyes[0].radiance = change(both);
  SaveOptions options;
  options.layout = Layout::kSeparate, options.tone = ToneCurve::kLinear;
  save_picture(picture, options, path);
  return open_unknown(path);
}

Image of_height(const Image& image, int height) {
  Image result(image.width, height, 3);
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < 3 * image.width; x++) {
      const float at =
          (static_cast<float>(y) + 0.5f) * static_cast<float>(image.height) / static_cast<float>(height) - 0.5f;
      const int y0 = std::clamp(static_cast<int>(at), 0, image.height - 2);
      result.at(0, y)[x] = std::lerp(image.at(0, y0)[x], image.at(0, y0 + 1)[x], at - static_cast<float>(y0));
    }
  }
  return result;
}

TEST_F(Unknown, Vr180SqueezedInto16To9IsRecognised) {
  for (const World world : kWorlds) {
    const Identity seen =
        identify(stereo_file(folder, world, true, [](const Image& both) { return of_height(both, 540); }));
    ASSERT_FALSE(seen.readings.empty());
    EXPECT_EQ(reading_text(seen.best()), "side-by-side, vr180") << world_name(world);
    EXPECT_FALSE(seen.bars.any());
  }
}

TEST_F(Unknown, SpheresSqueezedInto16To9AreRecognised) {
  for (const World world : kWorlds) {
    const Identity seen =
        identify(stereo_file(folder, world, false, [](const Image& both) { return of_height(both, 540); }));
    ASSERT_FALSE(seen.readings.empty());
    EXPECT_EQ(reading_text(seen.best()), "top-bottom, lat-long") << world_name(world);
    EXPECT_TRUE(seen.is_sure()) << world_name(world) << " " << seen.best().certainty;
  }
}

// Video sites store the faces in 16:9.
TEST_F(Unknown, AnEquiAngularCubeIn16To9IsRecognised) {
  for (const World world : kWorlds) {
    StereoCamera camera;
    camera.projection = named("eac");
    Picture picture;
    picture.eyes.resize(1);
    picture.eyes[0].eye = kMono;
    picture.eyes[0].radiance = of_height(seen(world, camera, kMono, {960, 640}), 540);
    SaveOptions options;
    options.layout = Layout::kSeparate, options.tone = ToneCurve::kLinear;
    save_picture(picture, options, folder.path("file.jpg"));
    const Identity seen = identify(open_unknown(folder.path("file.jpg")));
    ASSERT_FALSE(seen.readings.empty());
    EXPECT_EQ(reading_text(seen.best()), "one eye, eac") << world_name(world);
  }
}

// Halves that repeat each other in part, without any parallax.
TEST(EyeMatch, ARepeatedPatternIsNoSecondEye) {
  std::vector<Image> halves;
  uint32_t state = 1;
  for (int half = 0; half < 2; half++) {
    Image& image = halves.emplace_back(384, 384, 1);
    for (int y = 0; y < image.height; y++) {
      for (int x = 0; x < image.width; x++) {
        state = state * 1664525u + 1013904223u;
        const bool is_floor = y > 150;
        const float grid = x % 37 < 4 || y % 29 < 4 ? 0.8f : 0.1f + 0.001f * static_cast<float>(x % 53);
        *image.at(x, y) = is_floor ? grid : static_cast<float>(state >> 8 & 0xffff) / 65535.0f;
      }
    }
  }
  EXPECT_LT(match_eyes(halves).mark(), 0.5);
  halves[1] = halves[0];
  EXPECT_GT(match_eyes(halves).mark(), 0.5) << "one eye twice";
}

TEST_F(Unknown, BlackBarsAreNoPartOfVr180) {
  const auto with_bars = [](const Image& both) {
    Image file(both.width, 540, 3);
    std::copy(both.pixels.begin(), both.pixels.end(), file.at(0, 30));
    return file;
  };
  for (const World world : kWorlds) {
    const Identity seen = identify(stereo_file(folder, world, true, with_bars));
    ASSERT_FALSE(seen.readings.empty());
    EXPECT_EQ(reading_text(seen.best()), "side-by-side, vr180") << world_name(world);
    EXPECT_NEAR(seen.bars.top, 30, 1) << world_name(world);
    EXPECT_NEAR(seen.bars.bottom, 30, 1) << world_name(world);
  }
}

// The cave's colours have nothing in common: its parts match nowhere.
TEST_F(Unknown, AnaglyphsAreToldAndNothingElseIsOne) {
  for (const World world : {World::kField, World::kHall}) {
    StereoCamera camera;
    camera.projection = named("perspective");
    Image mixed = seen(world, camera, kRight, {640, 480}, true);
    const Image left = seen(world, camera, kLeft, {640, 480}, true);
    for (size_t i = 0; i < mixed.pixels.size(); i += 3) mixed.pixels[i] = left.pixels[i];
    for (const bool is_anaglyph : {true, false}) {
      const std::string path = folder.path("file.png");
      write_unknown(path, {std::nullopt, named("perspective")},
                    [&](int, const ProjectionSetting&, Extent) { return is_anaglyph ? mixed : left; }, {640, 480});
      const Identity seen = identify(open_unknown(path));
      EXPECT_EQ(seen.is_anaglyph, is_anaglyph) << world_name(world);
      if (!is_anaglyph) continue;
      EXPECT_FALSE(seen.is_likely()) << world_name(world);
      EXPECT_THROW(refuse_unlikely(open_media(path)), Error);
    }
  }
}

// px nx py ny pz nz: our order, but of a world whose Y is up.
TEST_F(Unknown, StripsOfAWorldWhoseYIsUpAreTold) {
  for (const World world : kWorlds) {
    for (const char* name : {"cube-6x1", "cube-1x6"}) {
      for (const float pitch : {0.0f, 90.0f}) {
        const TwoEyes eyes = [&](int eye, const ProjectionSetting& projection, Extent size) {
          StereoCamera camera;
          camera.projection = projection, camera.pitch = pitch;
          return seen(world, camera, eye, size);
        };
        const std::string path = folder.path("file.jpg");
        write_unknown(path, {std::nullopt, named(name)}, eyes, unknown_eye(named(name), 512));
        const Identity seen = identify(open_unknown(path));
        EXPECT_EQ(seen.is_sure(), pitch == 0.0f) << world_name(world) << " " << name;
        EXPECT_EQ(doubt_text(seen).find("faces of a cube") != std::string::npos, pitch != 0.0f) << world_name(world);
      }
    }
  }
}

TEST_F(Unknown, OfATransparentGroundNothingIsLikely) {
  StereoCamera camera;
  camera.projection = named("mirror-ball");
  const Image ball = seen(World::kHall, camera, kMono, {256, 256});
  const auto identity_with = [&](float around) {
    Picture picture;
    EyeImage& image = picture.eyes.emplace_back();
    image.eye = kMono;
    image.radiance = ball;
    image.alpha = Image(256, 256, 1);
    for (int y = 0; y < 256; y++) {
      for (int x = 0; x < 256; x++) {
        const bool is_inside = std::hypot(static_cast<float>(x) - 127.5f, static_cast<float>(y) - 127.5f) < 128.0f;
        *image.alpha.at(x, y) = is_inside ? 1.0f : around;
      }
    }
    SaveOptions options;
    options.tone = ToneCurve::kLinear;
    save_picture(picture, options, folder.path("ball.png"));
    return identify(open_unknown(folder.path("ball.png")));
  };
  const Identity opaque = identity_with(1.0f), clear = identity_with(0.0f);
  EXPECT_TRUE(opaque.is_likely());
  EXPECT_FALSE(clear.is_likely());
  EXPECT_NEAR(clear.best().certainty, 0.5 * opaque.best().certainty, 1e-6);
}

// A plot has the same boxes, axes and words in both halves, and margins that are as even as poles.
Image plot(Extent size, float paper) {
  Image image(size.width, size.height, 3);
  std::ranges::fill(image.pixels, paper);
  const auto fill = [&](float left, float top, float right, float bottom, float value) {
    const auto at = [](float part, int side) { return static_cast<int>(part * static_cast<float>(side)); };
    for (int y = at(top, size.height); y < at(bottom, size.height); y++) {
      for (int x = at(left, size.width); x < at(right, size.width); x++) std::fill_n(image.at(x, y), 3, value);
    }
  };
  if (paper > 0.0f) fill(0.04f, 0.05f, 0.96f, 0.7f, 0.7f * paper);
  for (int i = 0; i < 12; i++) {
    const float x = 0.06f + 0.075f * static_cast<float>(i);
    const float top = 0.08f + 0.09f * static_cast<float>((5 * (i % 6) + i / 6) % 6);
    fill(x, top, x + 0.02f, top + 0.08f, std::abs(paper - 0.8f)),
        fill(x + 0.022f, top + 0.03f, x + 0.042f, top + 0.12f, std::abs(paper - 0.95f));
    fill(x + 0.009f, top - 0.03f, x + 0.011f, top + 0.13f, 1.0f - paper);
    for (float y = 0.72f; y < 0.9f; y += 0.014f)  // words
      fill(x + 0.005f, y, x + 0.02f + 0.03f * std::abs(std::sin(300.0f * y)), y + 0.007f, std::abs(paper - 0.9f));
  }
  return image;
}

TEST_F(Unknown, ADrawingIsNotSurelyASphere) {
  for (const Extent size : {Extent{900, 900}, Extent{1200, 600}, Extent{640, 320}, Extent{1280, 720}}) {
    for (const float paper : {1.0f, 0.9f, 0.0f}) {
      const TwoEyes drawn = [&](int, const ProjectionSetting&, Extent) { return plot(size, paper); };
      write_unknown(folder.path("plot.png"), {std::nullopt, named("perspective")}, drawn, size);
      const StoredPicture whole = open_unknown(folder.path("plot.png"));
      EXPECT_TRUE(has_one_ground(whole)) << size.width << " " << paper;
      const Identity seen = identify(whole);
      const bool is_flat = seen.readings.empty() || seen.best().projection.kind == kPerspective;
      EXPECT_TRUE(is_flat || !seen.is_likely()) << size.width << " " << paper << ": " << reading_text(seen.best());
    }
  }
}

TEST_F(Unknown, AWorldHasNoGround) {
  for (const World world : kWorlds) {
    for (const char* name : {"lat-long", "vr180", "fisheye", "perspective", "cube-3x2"}) {
      const std::string path = folder.path("world.jpg");
      write_unknown(
          path, {std::nullopt, named(name)},
          [&](int, const ProjectionSetting& setting, Extent) { return eye_of(world, setting, kMono, 256); },
          unknown_eye(named(name), 256));
      EXPECT_FALSE(has_one_ground(open_unknown(path))) << world_name(world) << " " << name;
    }
  }
}

// The first scene of a game engine: a grid up to the horizon, the same in all four directions, below stars.
Image grid_world() {
  constexpr float kPi = 3.14159265f;
  Image room(1024, 512, 3);
  const auto line = [](float at, float far) {
    const float off = std::abs(at - std::round(at)) / (0.03f + 0.02f * far);
    return std::exp(-off * off) / (1.0f + 0.1f * far);
  };
  for (int y = 0; y < room.height; y++) {
    for (int x = 0; x < room.width; x++) {
      const float up = 0.5f * kPi - (static_cast<float>(y) + 0.5f) / 512.0f * kPi;
      const float around = (static_cast<float>(x) + 0.5f) / 512.0f * kPi, far = 1.0f / std::tan(std::max(-up, 1e-3f));
      const float grid = std::max(line(far * std::sin(around), far), line(far * std::cos(around), far));
      const float light = up > 0.0f ? 0.2f * std::exp(-up / 0.12f) : 0.2f * grid * std::exp(-far / 14.0f);
      std::fill_n(room.at(x, y), 3, light);
    }
  }
  uint32_t state = 3;
  const auto next = [&](uint32_t below) { return (state = state * 1664525u + 1013904223u) / 65536u % below; };
  for (int star = 0; star < 900; star++) {
    const int x = static_cast<int>(next(1024)), y = static_cast<int>(next(235));
    std::fill_n(room.at(x, y), 3, 0.05f + 0.4f * static_cast<float>(next(100)) / 100.0f);
  }
  return room;
}

TEST_F(Unknown, AWorldThatRepeatsItselfIsOneEye) {
  write_unknown(folder.path("grid.jpg"), {std::nullopt, named("lat-long")},
                [](int, const ProjectionSetting&, Extent) { return grid_world(); }, {1024, 512});
  const Identity seen = identify(open_unknown(folder.path("grid.jpg")));
  ASSERT_FALSE(seen.readings.empty());
  EXPECT_EQ(reading_text(seen.best()), "one eye, lat-long");
  EXPECT_TRUE(seen.is_likely()) << seen.best().certainty;
}

TEST_F(Unknown, WhatIsKnownCountsMoreThanPixels) {
  const TwoEyes eyes = [&](int eye, const ProjectionSetting& projection, Extent size) {
    StereoCamera camera;
    camera.projection = projection;
    return seen(World::kHall, camera, eye, size);
  };
  const std::string path = folder.path("file.jpg");
  write_unknown(path, {Layout::kTopBottom, named("lat-long")}, eyes, {512, 256});
  FormatHint known;
  known.layout = Layout::kBottomTop;
  for (const Reading& reading : identify(open_unknown(path), known).readings) {
    EXPECT_EQ(reading.layout, Layout::kBottomTop);
  }
  known.layout.reset(), known.projection = named("cylinder");
  for (const Reading& reading : identify(open_unknown(path), known).readings) {
    EXPECT_EQ(reading.projection, named("cylinder"));
  }
}

}  // namespace
}  // namespace ods

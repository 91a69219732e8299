// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Verdicts on one eye's picture whose distances are known.
#include "ods/comfort/comfort.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ods/base/error.h"
#include "ods/camera/pixel.h"
#include "ods/comfort/areas.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/comfort/verdict.h"
#include "ods/picture/picture.h"

namespace ods {
namespace {

// A hall of 20 m around, and spheres of light at places of their own: what one eye of the camera sees of them.
struct Ball {
  vec3 middle;
  float radius;
};

SeenDepth see(const StereoCamera& camera, int eye, const std::vector<Ball>& balls, int width = 512) {
  SeenDepth seen{camera, eye, Image(width, width / 2, 1), {}, {}};
  const Camera kernel = make_camera(camera);
  for (int y = 0; y < width / 2; y++) {
    for (int x = 0; x < width; x++) {
      const Ray ray = camera_ray(kernel, eye, pixel_middle(x, y, seen.depth));
      float nearest = 20.0f;
      int thing = -1;
      for (size_t i = 0; i < balls.size(); i++) {
        const vec3 to = balls[i].middle - ray.origin;
        const float along = dot(to, ray.direction), miss2 = dot(to, to) - along * along;
        const float r2 = balls[i].radius * balls[i].radius;
        if (along < 0.0f || miss2 > r2) continue;
        if (const float t = along - std::sqrt(r2 - miss2); t < nearest) nearest = t, thing = static_cast<int>(i);
      }
      seen.depth.at(x, y)[0] = nearest;
      seen.things.push_back(thing);
    }
  }
  for (size_t i = 0; i < balls.size(); i++) seen.names.push_back("ball " + std::to_string(i));
  return seen;
}

// Strains are not proportional to the distance there: the eyes' lines almost touch the circle.
TEST(Comfort, AThingBesideTheEyesHasAUsefulRemedy) {
  const float radius = 1.0f;  // so large that its edges are no steps
  const auto judged = [&](const StereoCamera& camera, float away) {
    return judge_comfort(see(camera, kLeft, {{vec3(0, 0, -away), radius}}));
  };
  const ComfortVerdict report = judged({}, 0.04f + radius);
  ASSERT_EQ(report.level, ComfortLevel::kError);
  const StrainedPlace& place = report.places[0];
  EXPECT_LT(place.distance, 0.06);
  EXPECT_LT(place.enough, 3.0);
  EXPECT_LE(judged({}, static_cast<float>(place.enough) * 1.02f + radius).level, ComfortLevel::kCaution);
  StereoCamera closer;
  closer.ipd = report.largest_ipd * 0.99f;
  EXPECT_GT(closer.ipd, 0.001f);
  EXPECT_LE(judged(closer, 0.04f + radius).level, ComfortLevel::kCaution);
}

TEST(Comfort, AHallIsComfortable) {
  for (const int eye : {kLeft, kRight, kMono}) {
    const ComfortVerdict report = judge_comfort(see(StereoCamera{}, eye, {}));
    EXPECT_EQ(report.level, ComfortLevel::kOk);
    EXPECT_NEAR(report.share[ComfortLevel::kOk], 1.0, 1e-9);
    EXPECT_NEAR(report.nearest, 20.0, 0.01);
    EXPECT_EQ(report.largest_ipd, StereoCamera{}.ipd);
    EXPECT_TRUE(report.places.empty());
  }
}

// Each by name, with its place, its distance and the distance that would be enough.
TEST(Comfort, NearThingsAreNamedWithTheirPlaces) {
  const std::vector<Ball> balls = {{vec3(0.5f, 0, 0), 0.05f}, {vec3(0, 0, -3), 0.4f}, {vec3(0, 0.8f, 0.05f), 0.1f}};
  for (const int eye : {kLeft, kRight, kMono}) {
    SeenDepth seen = see(StereoCamera{}, eye, balls);
    const ComfortVerdict report = judge_comfort(seen);
    EXPECT_EQ(report.level, ComfortLevel::kError);
    ASSERT_EQ(report.places.size(), 2u);
    const StrainedPlace& above = report.places[0].name == "ball 2" ? report.places[0] : report.places[1];
    const StrainedPlace& beside = report.places[0].name == "ball 0" ? report.places[0] : report.places[1];
    EXPECT_EQ(above.name, "ball 2");
    EXPECT_EQ(above.strain, Strain::kVertical);
    EXPECT_GT(above.elevation, 70.0);
    EXPECT_EQ(beside.name, "ball 0");
    EXPECT_EQ(beside.level, ComfortLevel::kError);
    EXPECT_NEAR(beside.azimuth, 90.0, 6.0);
    EXPECT_NEAR(beside.distance, 0.45, 0.02);
    EXPECT_GT(beside.enough, 0.6);
    EXPECT_GT(report.share[ComfortLevel::kError], 0.0);
    // The remedy by the eye distance helps.
    StereoCamera closer;
    closer.ipd = report.largest_ipd * 0.99f;
    const ComfortVerdict fixed = judge_comfort(see(closer, eye, balls));
    EXPECT_LE(fixed.level, ComfortLevel::kCaution)
        << fixed.places[0].name << strain_row(fixed.places[0].strain).name << fixed.places[0].value << " "
        << fixed.places[0].elevation << " " << closer.ipd;
    // Without names they are areas.
    seen.things.clear(), seen.names.clear();
    const ComfortVerdict areas = judge_comfort(seen);
    EXPECT_GE(areas.places.size(), 2u);
    EXPECT_NEAR(areas.share[ComfortLevel::kError], report.share[ComfortLevel::kError], 1e-12);
  }
}

// A merge takes the strain from above.
TEST(Comfort, MergesCount) {
  const std::vector<Ball> balls = {{vec3(0, 1.5f, 0), 0.1f}};
  EXPECT_EQ(judge_comfort(see(StereoCamera{}, kLeft, balls)).level, ComfortLevel::kError);
  StereoCamera merged;
  merged.top = {kMergeCosine, 0.0f, 80.0f, 1.0f};
  EXPECT_LT(judge_comfort(see(merged, kLeft, balls)).level, ComfortLevel::kError);
}

// With the merge that follows from depth nothing is above the limit, and what is far keeps its stereo.
TEST(Comfort, TheMergeFromDepthKeepsTheLimit) {
  const std::vector<Ball> low = {{vec3(0, 1.5f, 0), 0.3f}, {vec3(0, -2.0f, -0.5f), 0.4f}};
  for (const float limit : {15.0f, static_cast<float>(kFusionLimit), 50.0f}) {
    const Image map = merge_map_of(comfortable_shares(see(StereoCamera{}, kMono, low), {}, limit));
    StereoCamera merged;
    use_merge_map(merged, map);
    for (const int eye : {kLeft, kRight}) {
      const ComfortVerdict report = judge_comfort(see(merged, eye, low));
      const double worst = report.max[Strain::kVertical];
      const StrainedPlace place = report.places.empty() ? StrainedPlace{} : report.places[0];
      EXPECT_LE(worst, double{limit}) << place.name << " " << place.azimuth << " " << place.elevation;
      EXPECT_GE(worst, 0.7 * double{limit}) << limit;
    }
    EXPECT_EQ(map.at(0, kMergeRows / 2)[0], 1.0f);
    for (int row = 1; row < kMergeRows / 2; row++) {
      EXPECT_GE(map.at(0, row)[0], map.at(0, row - 1)[0]);
      EXPECT_LE(map.at(0, row)[0] - map.at(0, row - 1)[0], 0.1f) << "nothing jumps";
    }
  }
  const Image free =
      merge_map_of(comfortable_shares(see(StereoCamera{}, kMono, {}), {}, static_cast<float>(kFusionLimit)));
  for (const float share : free.pixels) EXPECT_EQ(share, 1.0f);
}

// A thing flies over the viewer: at every moment the limit holds, before and after it the stereo comes back, and
// nothing pumps.
TEST(Comfort, TheMergeOfAVideoIsSteady) {
  constexpr int kStep = 4, kLooks = 81, kPictures = kStep * (kLooks - 1) + 1;
  constexpr float kLimit = 25.0f;
  const auto things_at = [](int picture) {
    const float along = 24.0f * (static_cast<float>(picture) / kPictures - 0.5f);
    return std::vector<Ball>{{vec3(0.3f, 1.5f, along), 0.3f}};
  };
  std::vector<std::vector<float>> looks;
  for (int i = 0; i < kPictures; i += kStep) {
    looks.push_back(comfortable_shares(see(StereoCamera{}, kMono, things_at(i), 256), {}, kLimit));
  }
  const SteadyMerge merge(looks, kStep);
  ASSERT_TRUE(merge.varies());
  float minimum = 1.0f, maximum = 0.0f;
  for (int i = 0; i < kPictures; i++) {
    const auto map = merge.at(i), next = merge.at(i + 1);
    for (size_t k = 0; k < map->pixels.size(); k++) {
      EXPECT_LE(std::abs(map->pixels[k] - next->pixels[k]), 1.0f / (17 * kStep) + 0.001f) << i;
      EXPECT_GE(map->pixels[k], merge.minimum().pixels[k]);
    }
    minimum = std::min(minimum, map->pixels[0]), maximum = std::max(maximum, map->pixels[0]);
    if (i % 10 != 0) continue;
    StereoCamera merged;
    use_merge_map(merged, *map);
    const ComfortVerdict report = judge_comfort(see(merged, kLeft, things_at(i), 256));
    EXPECT_LE(report.max[Strain::kVertical], double{kLimit}) << i;
  }
  EXPECT_LT(minimum, 0.5f);
  EXPECT_EQ(maximum, 1.0f);
  // One look is for all.
  const SteadyMerge still({looks[0]}, 1);
  EXPECT_FALSE(still.varies());
  EXPECT_EQ(still.at(1000)->pixels, still.at(0)->pixels);
}

// Rows of a camera that is the same all around are judged by a shorter way.
TEST(Comfort, EvenRowsAreJudgedAsAnyOthers) {
  const std::vector<Ball> balls = {{vec3(0.5f, 0, 0), 0.05f}, {vec3(0, 0, -3), 0.4f}, {vec3(0, 1.3f, 0.05f), 0.1f}};
  StereoCamera even, other;
  even.bottom = even.top = {kMergeCosine, 40.0f, 80.0f, 1.0f};
  other = even;
  other.neck = 1e-6f;
  for (const int eye : {kLeft, kRight}) {
    const SeenDepth seen = see(even, eye, balls);
    SeenDepth same = seen;
    same.camera = other;
    const ComfortVerdict a = judge_comfort(seen), b = judge_comfort(same);
    for (const ComfortLevel level : kComfortLevels) EXPECT_NEAR(a.share[level], b.share[level], 1e-4);
    for (const Strain strain : kStrains) EXPECT_NEAR(a.max[strain], b.max[strain], 1e-3 * a.max[strain]);
    EXPECT_NEAR(a.largest_ipd, b.largest_ipd, 1e-4);
    ASSERT_EQ(a.places.size(), b.places.size());
    for (size_t i = 0; i < a.places.size(); i++) {
      EXPECT_EQ(a.places[i].name, b.places[i].name);
      EXPECT_NEAR(a.places[i].enough, b.places[i].enough, 1e-3);
    }
  }
}

TEST(Comfort, APointIsJudgedAsInThePicture) {
  const SeenDepth seen = see(StereoCamera{}, kRight, {{vec3(0.4f, 0.4f, 0), 0.05f}});
  const ComfortVerdict report = judge_comfort(seen);
  ASSERT_FALSE(report.places.empty());
  double near = 0.0, vertical = 0.0;
  ComfortLevel level = ComfortLevel::kOk;
  for (int i = 0; i < seen.depth.width * seen.depth.height; i++) {
    const int x = i % seen.depth.width, y = i / seen.depth.width;
    const PointComfort point = judge_point(seen.camera, kRight, pixel_middle(x, y, seen.depth), *seen.depth.at(x, y));
    near = std::max(near, point.near), vertical = std::max(vertical, point.vertical);
    level = std::max(level, point.level);
  }
  EXPECT_NEAR(near, report.max[Strain::kNear], 1e-3);
  EXPECT_NEAR(vertical, report.max[Strain::kVertical], 1e-2);
  EXPECT_EQ(level, ComfortLevel::kError);
  EXPECT_TRUE(std::isinf(judge_point(seen.camera, kRight, vec2(0.5f), kFarDepth).distance));
}

TEST(Comfort, RulesAreOfTheDistance) {
  const std::vector<Ball> balls = {{vec3(0.85f, 0, 0), 0.05f}, {vec3(0, 3.3f, 0), 0.1f}};
  ComfortOptions google;
  google.rules = ComfortRules::kGoogle;
  const ComfortVerdict report = judge_comfort(see(StereoCamera{}, kLeft, balls), google);
  ASSERT_EQ(report.places.size(), 1u);
  EXPECT_EQ(report.places[0].name, "ball 1");  // 3.2 m above; 0.8 m beside is enough
  EXPECT_NEAR(report.places[0].enough, 3.5, 0.02);
  ComfortOptions sphere;
  sphere.rules = ComfortRules::kSafeSphere;
  sphere.safe_radius = 1.0f;
  const ComfortVerdict other = judge_comfort(see(StereoCamera{}, kLeft, balls), sphere);
  ASSERT_EQ(other.places.size(), 1u);
  EXPECT_EQ(other.places[0].name, "ball 0");
}

TEST(Comfort, DepthWithoutSenseIsAnErrorOrUnknown) {
  SeenDepth seen = see(StereoCamera{}, kLeft, {});
  seen.things.clear();
  for (const float bad : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    std::ranges::fill(seen.depth.pixels, bad);
    EXPECT_THROW(judge_comfort(seen), Error);
  }
  std::ranges::fill(seen.depth.pixels, std::numeric_limits<float>::infinity());
  seen.depth.pixels[0] = std::numeric_limits<float>::quiet_NaN();
  const ComfortVerdict report = judge_comfort(seen);
  EXPECT_EQ(report.level, ComfortLevel::kOk);
  EXPECT_GT(report.unknown, 0.0);
}

TEST(Comfort, BlocksKeepWhatIsNearest) {
  Image depth(9, 4, 1);
  std::ranges::fill(depth.pixels, 5.0f);
  depth.at(4, 1)[0] = 0.5f;
  depth.at(8, 3)[0] = -1.0f;
  const Image blocks = nearest_of_blocks(depth, 5);
  EXPECT_EQ(blocks.width, 5);
  EXPECT_EQ(blocks.height, 2);
  EXPECT_EQ(blocks.at(2, 0)[0], 0.5f);
  EXPECT_EQ(blocks.at(0, 0)[0], 5.0f);
  EXPECT_EQ(blocks.at(4, 1)[0], 5.0f);
}

}  // namespace
}  // namespace ods

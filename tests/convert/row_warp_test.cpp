// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Whole rows moved by depth: against the search along each ray, and against the world that the picture is of.
#include "ods/convert/row_warp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "tests/support/ball_in_box.h"

namespace ods::row_warp_test {

const std::vector<int> kBoth{kLeft, kRight};

ConvertTarget stereo_of(const MadePicture& made, Holes holes) {
  ConvertTarget target = target_of(made, made.picture.camera.projection, made.picture.size);
  target.eyes = kBoth;
  target.holes = holes;
  return target;
}

struct Agreement {
  int64_t all = 0, hits = 0, far_apart = 0, other_depth = 0, one_alone = 0;
};

// Row by row against ray by ray, wherever both are defined.
Agreement agreement(const MadePicture& made, const ConvertTarget& target) {
  const Mapping mapping = make_mapping(made.picture, target);
  const Reprojection reprojection = make_reprojection(mapping.source);
  const std::optional<RowWarp> warp = RowWarp::make(mapping, reprojection);
  Agreement result;
  if (!warp) return result;
  std::vector<SurfaceHit> row;
  for (int index = 0; index < 2; index++) {
    for (int y = 0; y < target.eye.height; y++) {
      if (!warp->warp(index, y, false, row)) continue;
      for (int x = 0; x < target.eye.width; x++) {
        const vec2 home = mapping.home_of(x, y);
        const int from = mapping.from[static_cast<size_t>(index)];
        const SurfaceHit met = meet_surface(reprojection, from, mapping.ray_of(index, home, home));
        const SurfaceHit& own = row[static_cast<size_t>(x)];
        result.all++;
        result.one_alone += own.place.seen != met.place.seen;
        if (!own.place.seen || !met.place.seen) continue;
        result.hits++;
        result.other_depth += std::abs(own.depth - met.depth) > 0.01f * met.depth;
        vec2 off = own.place.at - met.place.at;
        off.x -= static_cast<float>(made.picture.size.width) *
                 std::round(off.x / static_cast<float>(made.picture.size.width));
        result.far_apart += own.place.source_eye == met.place.source_eye && length(off) > 0.1f;
      }
    }
  }
  return result;
}

TEST(RowWarp, FindsWhatRaysFind) {
  StereoCamera merged;
  merged.top = merged.bottom = kUsualMerge;
  StereoCamera turned = merged;
  turned.yaw = 37.0f;
  StereoCamera necked = merged;
  necked.neck = 0.08f;
  StereoCamera shifted;
  shifted.convergence = kShift;
  for (const StereoCamera& camera : {StereoCamera(), merged, turned, necked, shifted}) {
    for (const std::vector<int>& eyes : {std::vector<int>{kMono}, kBoth}) {
      const MadePicture made = picture_of_world(StereoCamera(), {512, 256}, eyes);
      ConvertTarget target = stereo_of(made, Holes::kEmpty);
      target.camera = camera;
      target.camera.ipd = eyes.size() == 2 ? 0.05f : 0.065f;
      const Agreement result = agreement(made, target);
      EXPECT_GT(result.all, 2 * 512 * 200);
      EXPECT_LT(result.one_alone, result.all / 400);
      EXPECT_LT(result.other_depth, result.all / 400);
      EXPECT_LT(result.far_apart, result.all / 400);
    }
  }
}

TEST(RowWarp, FindsWhatRaysFindInPartsOfTheSphere) {
  StereoCamera half;
  half.projection = projection_named("vr180");
  const MadePicture whole = picture_of_world(StereoCamera(), {512, 256}, {kMono});
  ConvertTarget target = stereo_of(whole, Holes::kEmpty);
  target.camera.projection = half.projection, target.eye = {256, 256};
  const Agreement to_half = agreement(whole, target);
  EXPECT_GT(to_half.hits, 2 * 256 * 200);
  EXPECT_LT(to_half.one_alone + to_half.other_depth + to_half.far_apart, to_half.all / 200);

  const MadePicture made = picture_of_world(half, {256, 256}, {kMono});
  const Agreement from_half = agreement(made, stereo_of(made, Holes::kEmpty));
  EXPECT_GT(from_half.hits, 2 * 250 * 200);
  EXPECT_LT(from_half.one_alone + from_half.other_depth + from_half.far_apart, from_half.all / 200);
}

TEST(RowWarp, IsOnlyForSymmetricCameras) {
  const MadePicture made = picture_of_world(StereoCamera(), {64, 32}, {kMono});
  const auto can = [&](const std::function<void(ConvertTarget&)>& change) {
    ConvertTarget target = stereo_of(made, Holes::kEmpty);
    change(target);
    const Mapping mapping = make_mapping(made.picture, target);
    const Reprojection reprojection = make_reprojection(mapping.source);
    return RowWarp::make(mapping, reprojection).has_value();
  };
  EXPECT_TRUE(can([](ConvertTarget&) {}));
  EXPECT_FALSE(can([](ConvertTarget& target) { target.camera.pitch = 10.0f; }));
  EXPECT_FALSE(can([](ConvertTarget& target) { target.camera.projection = projection_named("cube-3x2"); }));
  EXPECT_FALSE(can([](ConvertTarget& target) {
    auto map = std::make_shared<Image>(4, 1, 1);
    map->pixels = {1.0f, 0.5f, 1.0f, 1.0f};
    target.camera.merge_map = map, target.camera.top.mode = kMergeMap;
  }));
}

// A smaller target is the mean of a larger one.
TEST(RowWarp, SmallerTargetsAreAveraged) {
  const MadePicture made = picture_of_world(StereoCamera(), {1024, 512}, {kMono});
  ConvertTarget target = stereo_of(made, Holes::kFilled);
  target.eye = {400, 200};
  const Conversion conversion = convert(made.picture, target);
  const std::vector<Image> images = images_of(conversion.rows);
  const Camera camera = make_camera(target.camera);
  double squares = 0.0;
  int64_t other_depth = 0, near_edges = 0;
  for (size_t eye = 0; eye < 2; eye++) {
    for (int i = 0; i < 400 * 200; i++) {
      vec3 mean(0.0f);
      float nearest = 1e9f, farthest = 0.0f;
      for (int k = 0; k < 16; k++) {
        const vec2 uv((static_cast<float>(i % 400) + 0.125f + 0.25f * static_cast<float>(k % 4)) / 400.0f,
                      (static_cast<float>(i / 400) + 0.125f + 0.25f * static_cast<float>(k / 4)) / 200.0f);
        const Seen seen = look_at_world(camera_ray(camera, target.eyes[eye], uv));
        mean = mean + seen.color * (1.0f / 16.0f);
        nearest = std::min(nearest, seen.depth), farthest = std::max(farthest, seen.depth);
      }
      const float* pixel = &images[eye].pixels[static_cast<size_t>(4 * i)];
      for (int c = 0; c < 3; c++) squares += std::pow(double{pixel[c] - mean[c]}, 2);
      near_edges += farthest > 1.2f * nearest;
      other_depth += pixel[3] < 0.95f * nearest || pixel[3] > 1.02f * farthest;
    }
  }
  EXPECT_GT(-10.0 * std::log10(squares / (6.0 * 400 * 200)), 38.0);
  EXPECT_LT(other_depth, near_edges + 100);
  EXPECT_EQ(*conversion.empty, 0);
}

// The first and last column of the ball in each row of an eye, by its colour; first > last: there is none.
std::pair<int, int> ball_in_row(const std::function<vec3(int x)>& color, int width) {
  int first = width, last = -1;
  for (int x = 0; x < width; x++) {
    const vec3 at = color(x);
    if (at.x - at.y < 0.3f) continue;
    first = std::min(first, x), last = x;
  }
  return {first, last};
}

TEST(RowWarp, NoEdgeIsOffByMoreThanAPixel) {
  for (const Extent size : {Extent{512, 256}, Extent{2048, 1024}}) {
    const MadePicture made = picture_of_world(StereoCamera(), size, {kMono});
    const ConvertTarget target = stereo_of(made, Holes::kFilled);
    const std::vector<Image> images = images_of(convert(made.picture, target).rows);
    const Camera camera = make_camera(target.camera);
    int rows = 0, worst = 0;
    for (size_t eye = 0; eye < 2; eye++) {
      for (int y = 0; y < size.height; y++) {
        const auto own = ball_in_row(
            [&](int x) { return vec3(images[eye].at(x, y)[0], images[eye].at(x, y)[1], 0.0f); }, size.width);
        const auto truth = ball_in_row(
            [&](int x) {
              const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(size.width),
                            (static_cast<float>(y) + 0.5f) / static_cast<float>(size.height));
              return look_at_world(camera_ray(camera, target.eyes[eye], uv)).color;
            },
            size.width);
        if (truth.second - truth.first < 6) continue;  // its top and bottom, which are edges downwards
        rows++;
        worst = std::max({worst, std::abs(own.first - truth.first), std::abs(own.second - truth.second)});
      }
    }
    EXPECT_GT(rows, size.height / 8);
    EXPECT_LE(worst, 1) << size.width;
  }
}

// Holes are filled, and nothing of what is in front of them is in them.
TEST(RowWarp, HolesShowWhatIsBehind) {
  const MadePicture made = picture_of_world(StereoCamera(), {512, 256}, {kMono});
  for (const char* to : {"lat-long", "cube-3x2"}) {  // by rows, and by rays
    const auto images = [&](Holes holes, int64_t& empty, int64_t& filled) {
      ConvertTarget target = stereo_of(made, holes);
      target.camera.projection = projection_named(to);
      if (to == std::string("cube-3x2")) target.eye = {384, 256};
      const Conversion conversion = convert(made.picture, target);
      const std::vector<Image> result = images_of(conversion.rows);
      empty = *conversion.empty, filled = *conversion.filled;
      return result;
    };
    int64_t empty = 0, filled = 0, none = 0;
    const std::vector<Image> with = images(Holes::kEmpty, empty, none);
    EXPECT_EQ(none, 0);
    const std::vector<Image> without = images(Holes::kFilled, none, filled);
    EXPECT_LE(none, 1) << to;
    EXPECT_NEAR(static_cast<double>(filled), static_cast<double>(empty), 2.0) << to;
    EXPECT_GT(filled, 100) << to;
    int64_t red = 0;
    for (size_t eye = 0; eye < 2; eye++) {
      EXPECT_EQ(without[eye].channels, with[eye].channels - 1);  // no alpha
      for (int i = 0; i < with[eye].width * with[eye].height; i++) {
        if (with[eye].pixels[static_cast<size_t>(5 * i + 3)] > 0.0f) continue;
        const float* pixel = &without[eye].pixels[static_cast<size_t>(4 * i)];
        red += pixel[0] - pixel[1] > 0.1f;
        EXPECT_GT(pixel[3], 1.7f);  // the box
      }
    }
    EXPECT_LE(red, filled / 20) << to;  // the filter reaches across edges
  }
}

}  // namespace ods::row_warp_test

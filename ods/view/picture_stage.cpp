// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/picture_stage.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "ods/base/angles.h"
#include "ods/base/decimal.h"
#include "ods/base/error.h"
#include "ods/convert/convert.h"
#include "ods/convert/panorama.h"
#include "ods/convert/reproject.h"
#include "ods/depth/floor.h"
#include "ods/layers/probes/harmonics.h"

namespace ods {

namespace {

// The distances of both eyes, one above the other, infinite where there is nothing.
Image stacked_depths(const StoredPicture& picture) {
  const int width = std::min(picture.size.width, kMaxStageWidth);
  const int height = std::max(picture.size.height * width / picture.size.width, 1);
  Image all(width, height * static_cast<int>(picture.eyes.size()), 1);
  for (size_t eye = 0; eye < picture.eyes.size(); eye++) {
    const Image depth = depth_of_eye(picture, eye);
    const auto nearest = [](int at, int of, int from) { return static_cast<int>((at + 0.5) * from / of); };
    for (int y = 0; y < height; y++) {
      float* const row = all.at(0, y + static_cast<int>(eye) * height);
      for (int x = 0; x < width; x++) {
        const float each = depth.at(nearest(x, width, depth.width), nearest(y, height, depth.height))[0];
        row[x] = inverse_depth(each) > 0.0f ? each : INFINITY;
      }
    }
  }
  return all;
}

void store_depths(const Image& depths, PictureStage& stage) {
  float least = INFINITY, most = 0.0f;
  for (const float each : depths.pixels) {
    if (std::isfinite(each)) least = std::min(least, each), most = std::max(most, each);
  }
  if (most == 0.0f) least = most = 1.0f;
  stage.nearest = least;
  stage.per_octave = static_cast<float>((kFarCode - 1) / std::max(std::log2(static_cast<double>(most) / least), 0.01));
  FileHeader header;
  header.format = FileFormat::kPng;
  header.width = depths.width, header.height = depths.height;
  header.channels = {{"R"}, {"G"}, {"B"}};
  stage.depth_png = image_bytes("the depth", header, [&](int y, std::span<float> row) {
    for (int x = 0; x < depths.width; x++) {
      const float each = depths.at(x, y)[0];
      int code = kFarCode;
      if (std::isfinite(each)) {
        const double octaves = std::log2(static_cast<double>(each) / stage.nearest);
        code = std::clamp(static_cast<int>(std::lround(octaves * stage.per_octave)), 0, kFarCode - 1);
      }
      float* const to = &row[3 * static_cast<size_t>(x)];
      to[0] = static_cast<float>(code >> 8) / 255.0f;
      to[1] = static_cast<float>(code & 255) / 255.0f;
      to[2] = 0.0f;
    }
  });
}

struct Seen {
  std::array<vec3, 9> sum{};
  vec3 color{0.0f};
  float whole = 0.0f;  // steradians
  std::array<float, 9> unseen{};
};

// A small lat-long of one eye is enough: the harmonics are smooth. What the picture does not show has its mean colour.
std::array<vec3, 9> light_of(const StoredPicture& picture) {
  constexpr Extent kSize{256, 128};
  ConvertTarget target = same_format(picture);
  target.camera.projection = find_projection("lat-long")->setting;
  target.camera.convergence = kParallel;
  target.eye = kSize;
  target.eyes = {kMono};
  if (picture.eyes.size() > 1) target.mono_from = picture.eyes[0].eye;
  const Conversion conversion = convert(picture, target);
  const Source source = make_source(picture);
  const Camera camera = make_camera(target.camera);
  const size_t channels = count_channels(conversion.rows.layers);
  std::vector<float> row(static_cast<size_t>(kSize.width) * channels);
  Seen seen;
  for (int y = 0; y < kSize.height; y++) {
    conversion.rows.fill(0, y, row);
    for (int x = 0; x < kSize.width; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / kSize.width, (static_cast<float>(y) + 0.5f) / kSize.height);
      const float solid = 2.0f * kPi / kSize.width * kPi / kSize.height * std::sin(uv.y * kPi);
      const vec3 direction = camera_ray(camera, kMono, uv).direction;
      const auto values = harmonics(direction);
      if (!place_of_line(source, 0, direction).seen) {
        for (size_t i = 0; i < values.size(); i++) seen.unseen[i] += solid * values[i];
        continue;
      }
      const float* const pixel = &row[static_cast<size_t>(x) * channels];
      const vec3 color(pixel[0], pixel[1], pixel[2]);
      for (size_t i = 0; i < values.size(); i++) seen.sum[i] += solid * values[i] * color;
      seen.color += solid * color;
      seen.whole += solid;
    }
  }
  const vec3 mean = seen.color / std::max(seen.whole, 1e-6f);
  for (size_t i = 0; i < seen.sum.size(); i++) seen.sum[i] += seen.unseen[i] * mean;
  return seen.sum;
}

vec3 place_ahead(const StoredPicture& picture) {
  constexpr float kAhead = 1.2f;  // metres
  Image nearness = depth_of_eye(picture, 0);
  for (float& each : nearness.pixels) each = inverse_depth(each);
  const std::optional<double> floor = floor_below(nearness, make_camera(picture.camera), picture.eyes[0].eye);
  const float yaw = picture.camera.yaw * static_cast<float>(kDegree);
  const vec3 below(0.0f, static_cast<float>(floor.value_or(0.0)), 0.0f);
  return picture.camera.position - below + kAhead * vec3(std::sin(yaw), 0.0f, -std::cos(yaw));
}

Json numbers_of(vec3 v) {
  return {decimal(v.x), decimal(v.y), decimal(v.z)};
}

}  // namespace

PictureStage make_stage(const StoredPicture& picture) {
  if (!picture.maps.empty()) {
    throw Error(ErrorKind::kUsage,
                "objects cannot be put between the lenses of a camera: ods convert makes a panorama");
  }
  if (!depth_layer(picture)) {
    throw Error(ErrorKind::kUsage, "the picture has no depth: render it as .exr with depth");
  }
  PictureStage stage;
  stage.eyes = static_cast<int>(picture.eyes.size());
  store_depths(stacked_depths(picture), stage);
  stage.light = light_of(picture);
  stage.ahead = place_ahead(picture);
  return stage;
}

Json stage_json(const PictureStage& stage, const StereoCamera& camera, const std::string& depth_file) {
  const Camera made = make_camera(camera);
  Json light = Json::array();
  for (const vec3& each : stage.light) light.insert(light.end(), {each.x, each.y, each.z});
  return {{"depth", depth_file},
          {"eyes", stage.eyes},
          {"nearest", stage.nearest},
          {"per_octave", stage.per_octave},
          {"light", light},
          {"center", numbers_of(made.center)},
          {"frame", {numbers_of(made.right), numbers_of(made.up), numbers_of(made.back)}},
          {"yaw", decimal(camera.yaw)}};
}

}  // namespace ods

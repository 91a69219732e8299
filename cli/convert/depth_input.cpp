// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/depth_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/console/console.h"
#include "cli/options/eye_options.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/convert/reproject.h"

namespace {

constexpr const char* kDepthWords[] = {"--depth-kind",  "--near",        "--far",
                                       "--depth-along", "--depth-edges", "--eye-height"};

std::string meanings() {
  std::string text;
  for (const ods::DepthKindRow& row : ods::kDepthKindTable) {
    if (row.name == row.meaning) continue;
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", row.name, row.meaning);
  }
  return text;
}

}  // namespace

void add_depth_options(Options& options, DepthInput& depth) {
  ods::DepthOptions& how = depth.options;
  options.group("Depth beside the input, from which eyes see around things");
  options.text(
      "--depth", ValueKind::input_file(), depth.path,
      "how far everything in the picture is: a grey .png or .tif of 16 bits, .exr, .pfm, .npy, of any size; for "
      "frames and videos frames (####) or a video; %V: a file per eye");
  options.choice("--depth-kind", how.format.kind, ods::kDepthKindTable,
                 "what its numbers mean; floats are metres unless you say. " + meanings());
  options.number("--near", how.format.nearest, 1e-3f, 1e6f, "distance of its near end, metres");
  options.number("--far", how.format.farthest, 1e-3f, 1e9f,
                 "distance of its far end, metres; for inverse infinite if you give none");
  options.choice("--depth-along", how.format.along, ods::kDepthAlongTable,
                 "whether distances are from the eye (ray), or along the axis of the lens or the cube's face (axis)");
  options.choice("--depth-edges", how.edges, ods::kDepthEdgesTable,
                 "sharp: soft edges become as sharp as the picture's; soft: depth is used as it is");
  options.number("--eye-height", how.eye_height, 0.01f, 1e4f,
                 "height of the camera above the floor, metres: finds the scale of depth that has none");
}

void check_depth_options(const Options& options, const DepthInput& depth) {
  for (const char* word : kDepthWords) {
    if (options.given(word) && depth.path.empty()) throw UsageError(fmt::format("{} goes with --depth FILE", word));
  }
}

void give_depth(const DepthInput& depth, ods::StoredPicture& picture) {
  say_of_depth(ods::add_depth(picture, ods::read_depth(depth.path, picture), depth.options));
}

void say_of_depth(const ods::DepthReport& report) {
  for (const std::string& words : report.warnings) warn(words);
  for (const std::string& words : report.notes) note(words);
}

// What the picture shows, as the middle between the target's eyes sees it: the nearest in each direction.
static ods::SeenDepth seen_from_middle(const ods::StoredPicture& picture, const ods::StereoCamera& target) {
  constexpr int kWidth = 512, kMostLooks = 2048;
  ods::SeenDepth seen;
  seen.camera.ipd = target.ipd;
  seen.eye = ods::kMono;
  seen.depth = ods::Image(kWidth, kWidth / 2, 1);
  std::fill(seen.depth.pixels.begin(), seen.depth.pixels.end(), ods::kFarDepth);
  const ods::Camera from = ods::make_camera(picture.camera), to = ods::make_camera(target);
  for (size_t eye = 0; eye < picture.eyes.size(); eye++) {
    const ods::Image depth = ods::nearest_of_blocks(ods::depth_of_eye(picture, eye), kMostLooks);
    for (int i = 0; i < depth.width * depth.height; i++) {
      const ods::vec2 uv((static_cast<float>(i % depth.width) + 0.5f) / static_cast<float>(depth.width),
                         (static_cast<float>(i / depth.width) + 0.5f) / static_cast<float>(depth.height));
      const float distance = depth.pixels[static_cast<size_t>(i)];
      const ods::Ray ray = ods::camera_ray(from, picture.eyes[eye].eye, uv);
      if (!ods::is_surface(distance) || ray.direction == ods::vec3(0.0f)) continue;
      const ods::vec3 point = ray.origin - from.center + ray.direction * distance;
      const ods::vec3 own(dot(point, to.right), dot(point, to.up), dot(point, to.back));
      const ods::vec2 at = ods::direction_to_lat_long(normalize(own));
      const int x = std::clamp(static_cast<int>(at.x * kWidth), 0, kWidth - 1);
      const int y = std::clamp(static_cast<int>(at.y * (kWidth / 2)), 0, seen.depth.height - 1);
      float& nearest = *seen.depth.at(x, y);
      nearest = std::min(nearest, length(own));
    }
  }
  return seen;
}

std::vector<float> shares_of_depth(const ods::StoredPicture& picture, float limit, const ods::StereoCamera& camera) {
  return ods::comfortable_shares(seen_from_middle(picture, camera), {}, limit);
}

void use_shares(std::vector<float> shares, ods::StereoCamera& camera) {
  ods::Image map = ods::merge_map_of(std::move(shares));
  note(merge_by_depth_text(map));
  ods::use_merge_map(camera, std::move(map));
}

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/render_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/options/camera_options.h"
#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"

using ods::PoleMergeSetting, ods::ProjectionSetting, ods::StereoCamera, ods::vec2, ods::vec3;

namespace {

using Words = std::vector<std::string>;

constexpr const char* kMergeMapEnd = ".merge-map.exr";
constexpr const char* kTiltMapEnd = ".head-tilt-map.exr";

void save_map(const ods::Image& map, const std::string& path) {
  ods::FileHeader header;
  header.format = ods::FileFormat::kExr;
  header.width = map.width, header.height = map.height;
  header.channels = {{"Y", ods::SampleType::kFloat}};
  ods::AtomicFile file(path);
  write_image(file, header, [&](int y, std::span<float> row) {
    std::copy_n(map.pixels.begin() + static_cast<ptrdiff_t>(y) * map.width, row.size(), row.begin());
  });
  file.commit();
}

void add(Words& words, const char* option, const std::string& value) {
  words.insert(words.end(), {option, value});
}

void add_if_changed(Words& words, const char* option, float value, float usual) {
  if (value != usual) add(words, option, fmt::format("{}", value));
}

std::string text(vec3 v) {
  return fmt::format("{},{},{}", v.x, v.y, v.z);
}

std::string text(const PoleMergeSetting& merge) {
  if (merge.mode == ods::kMergeNone) return "none";
  return fmt::format("{},{},{},{}", ods::merge_name(merge.mode), merge.start, merge.end, merge.exponent);
}

bool has_merge_map(const StereoCamera& camera) {
  return camera.top.mode == ods::kMergeMap || camera.bottom.mode == ods::kMergeMap;
}

void add_eyes(Words& words, const StereoCamera& camera, const StereoCamera& usual, const std::string& maps) {
  if (camera.top != camera.bottom) {
    add(words, "--merge-top", text(camera.top));
    add(words, "--merge-bottom", text(camera.bottom));
  } else if (camera.top != usual.top) {
    add(words, "--merge", text(camera.top));
  }
  if (has_merge_map(camera)) add(words, "--merge-map", maps + kMergeMapEnd);
  if (camera.head_tilt_map) add(words, "--head-tilt-map", maps + kTiltMapEnd);
}

void add_projection(Words& words, const ProjectionSetting& setting, int width) {
  const std::string name(ods::projection_name(setting));
  const ProjectionSetting named = ods::find_projection(name)->setting;
  if (name != "lat-long") add(words, "--projection", name);
  const vec2 x = setting.longitude, y = setting.latitude;
  if (ods::has_range(setting.kind) && (x != named.longitude || y != named.latitude)) {
    add(words, "--range", fmt::format("{},{},{},{}", x.x, x.y, y.x, y.y));
  }
  if (ods::has_fov(setting.kind)) add_if_changed(words, "--fov", setting.fov, named.fov);
  if (ods::has_lens(setting.kind) && (setting.pan != named.pan || setting.tilt != named.tilt)) {
    add(words, "--lens-direction", fmt::format("{},{}", setting.pan, setting.tilt));
  }
  if (setting.kind == ods::kPerspective && setting.aspect != named.aspect) {
    add(words, "--height", fmt::format("{}", natural_height(setting, width)));
  }
  if (setting.kind != ods::kFisheyePolynomial) return;
  if (setting.polynomial != named.polynomial) {
    add(words, "--lens-polynomial", fmt::format("{}", fmt::join(setting.polynomial, ",")));
  }
  if (setting.sensor != named.sensor) add(words, "--sensor", fmt::format("{},{}", setting.sensor.x, setting.sensor.y));
}

}  // namespace

std::vector<std::string> camera_words(const StereoCamera& camera, int width, const std::string& maps) {
  const StereoCamera usual = usual_camera();
  Words words;
  add(words, "--position", text(camera.position));
  add(words, "--yaw", fmt::format("{}", camera.yaw));
  add_if_changed(words, "--pitch", camera.pitch, usual.pitch);
  add_if_changed(words, "--roll", camera.roll, usual.roll);
  add_if_changed(words, "--ipd", camera.ipd, usual.ipd);
  add_eyes(words, camera, usual, maps);
  if (camera.convergence != usual.convergence) {
    add(words, "--convergence",
        fmt::format("{},{}", ods::convergence_name(camera.convergence), camera.convergence_distance));
  }
  add_if_changed(words, "--eye-to-neck", camera.neck, usual.neck);
  if (camera.axis) add(words, "--axis", text(*camera.axis));
  if (camera.lens_radius > 0.0f) add(words, "--lens", fmt::format("{},{}", camera.lens_radius, camera.focus_distance));
  if (camera.mirrored) words.emplace_back("--left-handed");
  add_projection(words, camera.projection, width);
  return words;
}

std::vector<std::string> save_maps(const StereoCamera& camera, const std::string& maps) {
  std::vector<std::string> ends;
  if (has_merge_map(camera)) save_map(*camera.merge_map, maps + ends.emplace_back(kMergeMapEnd));
  if (camera.head_tilt_map) save_map(*camera.head_tilt_map, maps + ends.emplace_back(kTiltMapEnd));
  return ends;
}

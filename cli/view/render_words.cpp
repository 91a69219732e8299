// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/render_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/options/camera_options.h"

using ods::PoleMergeSetting, ods::ProjectionSetting, ods::StereoCamera, ods::vec2, ods::vec3;

namespace {

using Words = std::vector<std::string>;

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

void add_merges(Words& words, const StereoCamera& camera, const StereoCamera& usual) {
  if (camera.top == camera.bottom) {
    if (camera.top != usual.top) add(words, "--merge", text(camera.top));
    return;
  }
  add(words, "--merge-top", text(camera.top));
  add(words, "--merge-bottom", text(camera.bottom));
}

void add_projection(Words& words, const ProjectionSetting& setting) {
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
  if (setting.kind != ods::kFisheyePolynomial) return;
  if (setting.polynomial != named.polynomial) {
    add(words, "--lens-polynomial", fmt::format("{}", fmt::join(setting.polynomial, ",")));
  }
  if (setting.sensor != named.sensor) add(words, "--sensor", fmt::format("{},{}", setting.sensor.x, setting.sensor.y));
}

}  // namespace

std::vector<std::string> camera_words(const StereoCamera& camera) {
  const StereoCamera usual = usual_camera();
  Words words;
  add(words, "--position", text(camera.position));
  add(words, "--yaw", fmt::format("{}", camera.yaw));
  add_if_changed(words, "--pitch", camera.pitch, usual.pitch);
  add_if_changed(words, "--roll", camera.roll, usual.roll);
  add_if_changed(words, "--ipd", camera.ipd, usual.ipd);
  add_merges(words, camera, usual);
  if (camera.convergence != usual.convergence) {
    add(words, "--convergence",
        fmt::format("{},{}", ods::convergence_name(camera.convergence), camera.convergence_distance));
  }
  add_if_changed(words, "--eye-to-neck", camera.neck, usual.neck);
  if (camera.axis) add(words, "--axis", text(*camera.axis));
  if (camera.lens_radius > 0.0f) add(words, "--lens", fmt::format("{},{}", camera.lens_radius, camera.focus_distance));
  if (camera.mirrored) words.emplace_back("--left-handed");
  add_projection(words, camera.projection);
  return words;
}

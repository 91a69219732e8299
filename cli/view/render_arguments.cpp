// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/render_arguments.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/options/camera_options.h"
#include "ods/camera/camera_fields.h"
#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"

using ods::StereoCamera;

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

void add(Words& words, const std::string& option, const std::string& value) {
  words.insert(words.end(), {option, value});
}

bool has_merge_map(const StereoCamera& camera) {
  return camera.top.mode == ods::kMergeMap || camera.bottom.mode == ods::kMergeMap;
}

}  // namespace

std::vector<std::string> camera_arguments(const StereoCamera& camera, int width, const std::string& maps) {
  const std::string projection(ods::projection_name(camera.projection));
  StereoCamera usual = usual_camera();
  usual.projection = ods::find_projection(projection)->setting;
  Words words;
  if (projection != "lat-long") add(words, "--projection", projection);
  const std::vector<ods::CameraSetting> settings = camera_settings(camera), defaults = camera_settings(usual);
  const bool one_merge = same_merge(camera.top, camera.bottom);
  for (size_t i = 0; i < settings.size(); i++) {
    const auto& [name, value] = settings[i];
    const bool is_place = name == "position" || name == "yaw";  // otherwise the scene's
    if ((value == defaults[i].value && !is_place) || (one_merge && name == "merge-bottom")) continue;
    if (name == "aspect") {
      add(words, "--height", fmt::format("{}", natural_height(camera.projection, width)));
    } else {
      add(words, one_merge && name == "merge-top" ? "--merge" : fmt::format("--{}", name), value);
    }
  }
  if (has_merge_map(camera)) add(words, "--merge-map", maps + kMergeMapEnd);
  if (camera.head_tilt_map) add(words, "--head-tilt-map", maps + kTiltMapEnd);
  if (camera.mirrored) words.emplace_back("--left-handed");
  return words;
}

std::vector<std::string> save_maps(const StereoCamera& camera, const std::string& maps) {
  std::vector<std::string> ends;
  if (has_merge_map(camera)) save_map(*camera.merge_map, maps + ends.emplace_back(kMergeMapEnd));
  if (camera.head_tilt_map) save_map(*camera.head_tilt_map, maps + ends.emplace_back(kTiltMapEnd));
  return ends;
}

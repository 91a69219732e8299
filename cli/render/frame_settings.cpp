// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/frame_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "ods/base/text.h"
#include "ods/camera/camera_fields.h"
#include "ods/files/confined_file.h"
#include "ods/files/md5.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/gltf/gltf.h"

namespace {

using ods::Settings;

void add(Settings& settings, const std::string& option, const std::string& value) {
  settings.push_back({option, ods::one_line(value), ""});
}

void add_number(Settings& settings, const std::string& option, double value) {
  settings.push_back({option, fmt::format("{}", value), ""});
}

void add_float(Settings& settings, const std::string& option, float value) {
  settings.push_back({option, fmt::format("{}", value), ""});
}

void add_flag(Settings& settings, const std::string& option, bool value) {
  settings.push_back({option, value ? "on" : "off", ""});
}

std::string text_of(const ods::vec3& point) {
  return fmt::format("{},{},{}", point.x, point.y, point.z);
}

// A missing file is reported by whatever reads it.
void add_file(Settings& settings, const std::string& option, const std::string& path, const std::string& confine = {}) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    settings.push_back({option, "missing", ods::one_line(path)});
    return;
  }
  const std::string sum = ods::ConfinedFile(path, confine).read(ods::md5_of_file);
  settings.push_back({option, sum, ods::one_line(path)});
}

void add_environment(Settings& settings, const std::string& option, const std::string& word,
                     const std::string& fallback, const std::string& confined_to) {
  const std::string file = environment_file(option, word);
  if (!file.empty()) return add_file(settings, option, file, confined_to);
  add(settings, option, word.empty() ? fallback : word);
}

void add_light(Settings& settings, const LightOptions& light, const std::string& confined_to) {
  const auto& [environment, lamp, background, unlit, lamp_unit] = light;
  add_environment(settings, "--env", environment, "of the scene", confined_to);
  add(settings, "--lamp", lamp.empty() ? "auto" : lamp);
  add_environment(settings, "--background", background, "env", confined_to);
  add_flag(settings, "--unlit", unlit);
  add(settings, "--light-unit", std::string(name_in(ods::kLampUnitTable, lamp_unit)));
}

void add_scene(Settings& settings, const SceneSource& source) {
  const auto& [name, scene, light, catchers, confine, variant, solid_glass, portable, unit, blender, foreign, taken_for,
               up, camera, has_places] = source;
  const std::string confined_to = confining_folder(source);
  std::error_code error;
  const bool is_file = !ods::find_builtin(name) && std::filesystem::is_regular_file(name, error);
  if (is_file) {
    add_file(settings, "SCENE", name, confined_to);
    const std::filesystem::path folder = std::filesystem::path(name).parent_path();
    const std::vector<std::string> files = foreign ? std::vector<std::string>() : ods::gltf_files(name, confined_to);
    for (const std::string& file : files) {
      add_file(settings, fmt::format("SCENE's file {}", ods::one_line(file)), (folder / file).native(), confined_to);
    }
    if (foreign) add_number(settings, "--bake", blender.bake);
  } else {
    add(settings, "SCENE", name);
  }
  add(settings, "--scene", scene.empty() ? "of the file" : scene);
  add(settings, "--variant", variant.empty() ? "of the file" : variant);
  add_flag(settings, "--solid-glass", solid_glass);
  add_flag(settings, "--portable", portable);
  add_light(settings, light, confined_to);
  add(settings, "--unit", unit);
  add(settings, "--as", std::string(name_in(ods::kTakenForTable, taken_for)));
  add(settings, "--up", std::string(name_in(ods::kUpAxisTable, up)));
  add(settings, "--shadow-catcher", fmt::format("{}", fmt::join(catchers, ", ")));
}

void add_map(Settings& settings, const std::string& option, const std::shared_ptr<const ods::Image>& map,
             const std::string& path) {
  if (!map) return;
  const std::string_view bytes(reinterpret_cast<const char*>(map->pixels.data()), map->pixels.size() * sizeof(float));
  settings.push_back(
      {option, ods::md5(fmt::format("{}x{}", map->width, map->height) + std::string(bytes)), ods::one_line(path)});
}

// place_camera() replaces the rig's position and angles for every scene.
bool is_of_place(std::string_view setting) {
  return setting == "position" || setting == "yaw" || setting == "pitch" || setting == "roll";
}

void add_camera(Settings& settings, const CameraOptions& camera) {
  const auto& [rig, merge_map, merge_map_inverted, may_follow_depth, merge_limit, head_tilt_map, view_point, position,
               yaw, pitch, roll] = camera;
  const auto chosen = [](const std::optional<float>& angle, const char* fallback) {
    return angle ? fmt::format("{}", *angle) : fallback;
  };
  add(settings, "--camera", view_point.empty() ? "the first" : view_point);
  add(settings, "--position", position ? text_of(*position) : "of the scene");
  add(settings, "--yaw", chosen(yaw, "of the scene"));
  add(settings, "--pitch", chosen(pitch, "0"));
  add(settings, "--roll", chosen(roll, "0"));
  add(settings, "--projection", std::string(ods::projection_name(rig.projection)));
  for (const auto& [name, value] : camera_settings(rig)) {
    if (is_of_place(name)) continue;
    add(settings, name == "aspect" ? "width over height" : fmt::format("--{}", name), value.empty() ? "none" : value);
  }
  if (merge_limit) {
    add_number(settings, "--merge auto", double{*merge_limit});  // the map follows from the scene
  } else {
    add_map(settings, "--merge-map", rig.merge_map, merge_map);
  }
  add_map(settings, "--head-tilt-map", rig.head_tilt_map, head_tilt_map);
  add_flag(settings, "--left-handed", rig.mirrored);
}

void add_time(Settings& settings, const TimeOptions& options) {
  const auto& [file, time, animation, frames, only, fps, duration, move, shutter, own_grain, skip_existing, is_video] =
      options;
  const auto& [seconds, turns, pivot, fly_to] = move;
  add(settings, "--time", time ? fmt::format("{}", *time) : "0");
  add(settings, "--animation", animation.empty() ? "all" : animation);
  add_float(settings, "--fps", fps);
  add_float(settings, "--shutter", shutter);
  add(settings, "--grain", own_grain ? std::string(grain_name(*own_grain)) : "by default");
  add(settings, "--turntable", fmt::format("{}{}", turns, pivot ? "," + text_of(*pivot) : ""));
  std::vector<std::string> places;
  for (const ods::vec3& place : fly_to) places.push_back(text_of(place));
  add(settings, "--fly-to", places.empty() ? "nowhere" : fmt::format("{}", fmt::join(places, ";")));
  const bool lasts = duration && ods::moves(move);  // otherwise it only sets the number of frames
  add(settings, "--duration", lasts ? fmt::format("{}", *duration) : "of the scene");
}

void add_render(Settings& settings, const ods::RenderOptions& options) {
  const auto& [width, height, samples, noise, noise_exposure, time_limit, part, even_noise, bounces, clamp, caustics,
               indirect, cache_paths, eyes, share_paths, filter, layers, transparent, statistics, seed, threads,
               light_sampling, last_tile_first] = options;
  add_number(settings, "--width", width);
  add_number(settings, "--height", height);
  add_number(settings, "--samples", samples);
  add_float(settings, "--noise", noise);
  add_number(settings, "--time-limit", time_limit);
  add_flag(settings, "even noise", even_noise);
  add_flag(settings, "shared paths", share_paths);
  add_number(settings, "--bounces", bounces);
  add_float(settings, "--clamp", clamp);
  add(settings, "--caustics", std::string(ods::caustics_name(caustics)));
  add(settings, "--indirect", std::string(ods::indirect_name(indirect)));
  add(settings, "--eyes", std::string(ods::eyes_name(eyes)));
  add(settings, "--filter", std::string(ods::pixel_filter_name(filter)));
  add_flag(settings, "layers", layers);
  add_flag(settings, "--transparent", transparent);
  add_flag(settings, "statistics", statistics);
  add(settings, "--seed", fmt::format("{}", seed));
}

// A frame is scene-linear: exposure, tone and quality belong to the video.
void add_save(Settings& settings, const ods::SaveOptions& save) {
  const auto& [layout, exposure, tone, jpeg_quality, rows_alone, has_checksum, attributes, sidecar] = save;
  add(settings, "--layout", std::string(ods::layout_name(layout)));
}

}  // namespace

Settings frame_settings(const RenderJob& job) {
  Settings settings;
  add(settings, "version of ods", ODS_VERSION);
  add_scene(settings, job.scene);
  add_camera(settings, job.camera);
  add_time(settings, job.time);
  add_render(settings, job.render);
  add_save(settings, job.save);
  add(settings, "--denoise", job.denoise ? std::string(ods::name_in(ods::kDenoiserTable, *job.denoise)) : "by default");
  return settings;
}

Settings sample_settings(const RenderJob& job) {
  Settings settings = frame_settings(job);
  std::erase_if(settings, [](const ods::Setting& s) { return s.name == "--time-limit" || s.name == "--layout"; });
  add(settings, kPartSetting, ods::part_text(job.render.part));
  return settings;
}

Settings stitch_settings(const std::string& rig_file, const std::string& views, const ods::SaveOptions& save) {
  Settings settings;
  add(settings, "version of ods", ODS_VERSION);
  add_file(settings, "--rig", rig_file);
  add(settings, "VIEWS", views);
  add_save(settings, save);
  return settings;
}

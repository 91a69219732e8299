// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/console/console.h"
#include "cli/options/picture_options.h"
#include "cli/render/first_look.h"
#include "ods/base/text.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/sequence/identity.h"

namespace {

// A video's frames are .exr, but viewers see the video. One sample does not have a variance.
ods::Denoiser denoiser_of(const RenderJob& job) {
  const bool is_shown = job.time.is_video || !keeps_light(job.output);
  const auto denoiser = job.denoise.value_or(is_shown ? ods::Denoiser::kOwn : ods::Denoiser::kNone);
  return denoiser == ods::Denoiser::kOwn && job.render.samples == 1 ? ods::Denoiser::kNone : denoiser;
}

// Built-in scenes in their own light are made for exposure 0.
bool has_known_light(const RenderJob& job) {
  return ods::find_builtin(job.scene.name) && job.scene.light == LightOptions();
}

// Returns nullopt if look_first() must choose, also for a scene-linear file if its noise is judged.
std::optional<float> exposure_of(const RenderJob& job) {
  if (job.exposure) return job.exposure;
  const bool needs_look = (is_shown_to_viewers(job) || job.render.noise > 0.0f) && !has_known_light(job);
  return needs_look ? std::nullopt : std::optional(0.0f);
}

void add_environment(ods::Settings& settings, const std::string& option, const std::string& word,
                     const std::string& fallback, const std::string& confined_to) {
  const std::string file = environment_file("--" + option, word);
  const std::string name = fmt::format("`{}`", option);
  settings.push_back(file.empty() ? ods::Setting{name, ods::one_line(word.empty() ? fallback : word), ""}
                                  : ods::file_setting(name, file, confined_to));
}

// The objects in one line: their names, what their files contain, and their places.
std::string objects_text(const ObjectOptions& objects, const std::string& confined_to) {
  std::string text;
  for (const PlacedObject& object : placed_objects(objects)) {
    const bool is_builtin = ods::find_builtin(object.file) != nullptr;
    const ods::Settings files = is_builtin || is_foreign_scene(object.file)
                                    ? ods::Settings{ods::file_setting("", object.file, confined_to)}
                                    : ods::scene_settings(object.file, confined_to);
    text += fmt::format("{}{}", text.empty() ? "" : "; ", object.file);
    for (const ods::Setting& file : files) text += is_builtin ? "" : " " + file.value;
    const ods::vec3 at = object.at.value_or(ods::vec3(0.0f));
    text += fmt::format(" at {},{},{} turned {}", at.x, at.y, at.z, object.turn);
  }
  return text;
}

ods::Settings scene_settings(const SceneSource& source, const std::string& animation) {
  const auto& [name, scene, light, catchers, confine, variant, solid_glass, portable, unit, blender, foreign, taken_for,
               up, camera, objects, has_places] = source;
  const std::string confined_to = confining_folder(source);
  const bool is_foreign = !ods::find_builtin(name) && is_foreign_scene(name);
  ods::Settings settings = is_foreign ? ods::Settings{ods::file_setting("SCENE", name, confined_to)}
                                      : ods::scene_settings(name, confined_to);
  const auto add = [&](const std::string& option, std::string_view value) {
    settings.push_back({fmt::format("`{}`", option), ods::one_line(std::string(value)), ""});
  };
  const auto flag = [](bool value) { return value ? "on" : "off"; };
  if (is_foreign) add("bake", fmt::format("{}", blender.bake));
  add("scene", scene.empty() ? "of the file" : scene);
  add("variant", variant.empty() ? "of the file" : variant);
  add("solid-glass", flag(solid_glass));
  add("portable", flag(portable));
  add_environment(settings, "env", light.environment, "of the scene", confined_to);
  add("env-turn", fmt::format("{}", light.turn));
  add("env-strength", fmt::format("{}", light.strength));
  add("lamp", light.lamp.empty() ? "auto" : light.lamp);
  add_environment(settings, "background", light.background, "env", confined_to);
  add("unlit", flag(light.unlit));
  add("light-unit", name_in(ods::kLampUnitTable, light.lamp_unit));
  add("unit", unit);
  add("as", name_in(ods::kTakenForTable, taken_for));
  add("up", name_in(ods::kUpAxisTable, up));
  add("shadow-catcher", fmt::format("{}", fmt::join(catchers, ", ")));
  add("animation", animation.empty() ? "all" : animation);
  const std::string with = objects_text(objects, confined_to);
  if (!with.empty()) add("with", with);
  return settings;
}

}  // namespace

RenderPlan plan(const RenderJob& job, const TimeOptions& time) {
  RenderPlan plan;
  ods::SequenceOptions& sequence = plan.sequence;
  sequence.camera = scene_camera(job.camera);
  sequence.camera.move = time.move;
  sequence.merge_limit = job.camera.changes.merge_limit;
  sequence.fps = double{time.fps};
  sequence.first_frame = time.file.first;
  if (makes_video(time) || time.time) sequence.shutter = double{time.shutter};
  if (time.grain) sequence.changing_grain = *time.grain == Grain::kChanging;
  sequence.exposure = exposure_of(job);
  sequence.brighter = job.brighter;
  sequence.render = job.render;
  sequence.finish = {denoiser_of(job), job.save};
  sequence.draws_on_neighbours = !job.cycles && job.time.is_video && sequence.finish.denoiser == ods::Denoiser::kOwn;
  sequence.warn = warn;
  plan.sampled = options_to_finish(job.render, sequence.finish.denoiser);
  plan.sampled.layers |= job.part.has_value();
  plan.sampled.statistics |= job.part.has_value() || job.save_unfinished;
  return plan;
}

ods::SequenceOptions identified(const RenderJob& job) {
  ods::SequenceOptions sequence = plan(job).sequence;
  sequence.scene = scene_settings(job.scene, job.time.animation);
  sequence.camera.move.seconds = job.time.duration ? double{*job.time.duration} : 0.0;  // 0: the scene decides
  return sequence;
}

ods::Settings stitch_identity(const std::string& rig_file, const std::string& views, ods::Layout layout) {
  return {{"version of ods", ODS_VERSION, ""},
          ods::file_setting("`rig`", rig_file),
          {"VIEWS", ods::one_line(views), ""},
          {"`layout`", std::string(ods::layout_name(layout)), ""}};
}

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/scene_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/console/console.h"
#include "ods/base/error.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/files/confined_file.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/catchers.h"
#include "ods/scene/load/environment.h"
#include "ods/scene/load/load.h"
#include "ods/stage/place.h"

using ods::Scene, ods::vec3;

static void add_confine_option(Options& options, SceneSource& source) {
  options.text("--confine", "DIR", source.confine,
               "read no file outside this folder, wherever paths and links in the scene lead: for untrusted scenes");
}

static void add_unit_option(Options& options, SceneSource& source) {
  options.text(
      "--unit", "auto|UNIT|METRES", source.unit,
      "the unit of lengths in the file: m, cm, mm, in, ft, km, or how many metres it has. auto: metres, unless "
      "nothing that people meet has that size");
}

// None: auto.
static std::optional<float> parse_unit(const std::string& word) {
  if (word == "auto") return std::nullopt;
  if (const auto unit = ods::find_in(ods::kUnitTable, word)) return ods::row_in(ods::kUnitTable, *unit).metres;
  const std::vector<float> numbers = parse_numbers(word);
  if (numbers.size() == 1 && numbers[0] >= ods::kLeastUnit && numbers[0] <= ods::kMostUnit) return numbers[0];
  throw UsageError(fmt::format("--unit is auto, {}, or the unit in metres (0.000001 to a million), not '{}'",
                               fmt::join(ods::names_of(ods::kUnitTable), ", "), word));
}

void add_scene_argument(Options& options, SceneSource& source) {
  options.argument("SCENE", source.name, "a .glb or .gltf file, or a built-in scene (ods scenes lists them)");
  options.offer("SCENE", ods::names_of(ods::builtin_scenes()));
  options.group("Scene");
  options.number("--scene", source.scene, 0, 1000000,
                 "number of the scene in the file, counted from 0; by default the file's default scene");
  add_unit_option(options, source);
  add_confine_option(options, source);
}

void add_scene_option(Options& options, SceneSource& source, const char* help) {
  options.text("--scene", "SCENE", source.name, help);
  add_unit_option(options, source);
  add_confine_option(options, source);
}

void add_light_options(Options& options, SceneSource& source) {
  options.text("--env", "FILE|R,G,B|X", source.environment,
               "sky light: a lat-long picture (.hdr, .exr, ...), a colour or a brightness; 0 switches the sky off. "
               "Replaces the scene's own sky. A scene without lights gets 1");
}

// A name that may have been meant, or else the list of names.
static std::string suggestion(const Scene& scene, const std::string& name) {
  const std::vector<std::string> names = ods::object_names(scene);
  if (names.empty()) return "; it names no objects and materials";
  const std::string near = ods::did_you_mean(name, names);
  if (!near.empty()) return near;
  const size_t kMax = 12;
  const auto end = names.begin() + static_cast<ptrdiff_t>(std::min(names.size(), kMax));
  return fmt::format("; it has {}{}", fmt::join(names.begin(), end, ", "), end == names.end() ? "" : ", ...");
}

std::string confining_folder(const SceneSource& source) {
  if (source.confine.empty()) return "";
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::canonical(source.confine, error);
  if (error || !std::filesystem::is_directory(folder, error)) {
    throw ods::Error(ods::ErrorKind::kInput, fmt::format("--confine: there is no folder '{}'", source.confine));
  }
  return folder.native();
}

static std::string unit_word(float metres) {
  for (const ods::UnitRow& row : ods::kUnitTable) {
    if (row.metres == metres) return std::string(row.name);
  }
  return fmt::format("{:g}", metres);
}

// Built-in scenes are in metres and have a view point.
static void settle_scene(Scene& scene, const SceneSource& source, ods::Settled* result) {
  const std::optional<float> unit = parse_unit(source.unit);
  if (ods::find_builtin(source.name)) return ods::scale_scene(scene, unit.value_or(1.0f));
  const ods::Settled settled = ods::settle(scene, unit, !source.has_places);
  if (result) *result = settled;
  if (settled.unit_reason.empty()) return;
  note(fmt::format("{} (--unit {}; --unit m keeps its size)", settled.unit_reason, unit_word(settled.metres_per_unit)));
}

Scene open_scene(const SceneSource& source, ods::Settled* settled) {
  Scene scene = ods::load_scene(source.name, {.scene = source.scene.value_or(-1), .confine = confining_folder(source)});
  for (const std::string& warning : scene.warnings) warn(warning);
  for (const std::string& name : source.catchers) {
    if (make_catchers(scene, name)) continue;
    throw UsageError(
        fmt::format("--shadow-catcher: nothing in the scene is called '{}'{}", name, suggestion(scene, name)));
  }
  settle_scene(scene, source, settled);
  return scene;
}

static void add_environment(Scene& scene, const SceneSource& source) {
  if (source.environment.empty()) {
    if (ods::has_light(scene)) return;
    note(
        "the scene has no lamps: an even white sky lights it (--env sky.hdr is another one, --env 0 none, --exposure 1 "
        "doubles the light)");
    scene.environment.radiance = vec3(1.0f);
    return;
  }
  std::vector<float> numbers = parse_numbers(source.environment);
  if (numbers.empty()) {
    const std::string confined_to = confining_folder(source);
    // Confined, the message is the same whether or not a file outside exists.
    if (confined_to.empty() && !std::filesystem::exists(source.environment)) {
      throw ods::Error(ods::ErrorKind::kInput, "--env: no such file as '" + source.environment +
                                                   "'; a colour is written R,G,B, as 0.5,0.6,0.8");
    }
    std::string color_fault;
    const ods::ConfinedFile file(source.environment, confined_to);
    scene.environment =
        file.read([&](const std::string& opened) { return ods::load_environment(opened, &color_fault); });
    if (!color_fault.empty()) warn(fmt::format("'{}': {}", source.environment, color_fault));
    if (scene.environment.width != 2 * scene.environment.height) {
      note("--env: a sky is a lat-long picture, twice as wide as high; this one is stretched to that");
    }
    return;
  }
  bool legal = numbers.size() == 1 || numbers.size() == 3;
  for (float number : numbers) legal = legal && number >= 0.0f && number <= 1e6f;
  if (!legal)
    throw UsageError("--env is a file, R,G,B or one brightness, from 0 to 1e6, not '" + source.environment + "'");
  scene.environment = {};
  scene.environment.radiance = numbers.size() == 1 ? vec3(numbers[0]) : vec3(numbers[0], numbers[1], numbers[2]);
}

Scene open_lit_scene(const SceneSource& source) {
  Scene scene = open_scene(source);
  if (scene.instances.empty()) {
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("'{}' has nothing to render: no triangles in the scene that is shown (ods info says "
                                 "what there is)",
                                 source.name));
  }
  add_environment(scene, source);
  return scene;
}

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/scene_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/console.h"
#include "ods/base/error.h"
#include "ods/base/suggest.h"
#include "ods/scene/catchers.h"
#include "ods/scene/environment.h"
#include "ods/scene/load.h"

using ods::Scene, ods::vec3;

void add_scene_argument(Options& options, SceneSource& source) {
  options.argument("SCENE", source.name, "a .glb or .gltf file, or a built-in scene (ods scenes lists them)");
  options.group("Scene");
  options.number("--scene", source.scene, 0, 1000000,
                 "which of several scenes in the file, from 0; its own choice by default");
}

void add_light_options(Options& options, SceneSource& source) {
  options.text(
      "--env", "FILE|R,G,B|X", source.environment,
      "light from all around: a lat-long picture (.hdr, .exr, ...), a colour or a brightness; replaces the scene's "
      "own. A scene without lamps gets 1");
}

// What may have been meant, or else what there is.
static std::string suggestion(const Scene& scene, const std::string& name) {
  const std::vector<std::string> names = ods::object_names(scene);
  if (names.empty()) return "; it names no objects and materials";
  const std::string near = ods::did_you_mean(name, names);
  if (!near.empty()) return near;
  const size_t kMost = 12;
  const auto end = names.begin() + static_cast<ptrdiff_t>(std::min(names.size(), kMost));
  return fmt::format("; it has {}{}", fmt::join(names.begin(), end, ", "), end == names.end() ? "" : ", ...");
}

Scene open_scene(const SceneSource& source) {
  Scene scene = ods::load_scene(source.name, {.scene = source.scene.value_or(-1)});
  for (const std::string& warning : scene.warnings) warn(warning);
  for (const std::string& name : source.catchers) {
    if (make_catchers(scene, name)) continue;
    throw UsageError(fmt::format("--catch: nothing in the scene is called '{}'{}", name, suggestion(scene, name)));
  }
  return scene;
}

void add_environment(Scene& scene, const SceneSource& source) {
  if (source.environment.empty()) {
    if (ods::has_light(scene)) return;
    note("the scene has no lamps; a white sky lights it (--env sets another, --env 0 none)");
    scene.environment.radiance = vec3(1.0f);
    return;
  }
  std::vector<float> numbers = parse_numbers(source.environment);
  if (numbers.empty()) {
    if (!std::filesystem::exists(source.environment)) {
      throw ods::Error(ods::ErrorKind::kInput, "--env: no such file as '" + source.environment +
                                                   "'; a colour is written R,G,B, as 0.5,0.6,0.8");
    }
    std::string color_fault;
    scene.environment = ods::load_environment(source.environment, &color_fault);
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

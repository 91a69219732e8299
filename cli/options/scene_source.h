// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that say which scene, and in what light. Shared by the commands that read one.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/console/options.h"
#include "ods/scene/scene.h"

struct SceneSource {
  std::string name;          // a file, or a built-in scene
  std::optional<int> scene;  // which of the file's scenes, when not the one it opens with
  std::string environment;
  std::vector<std::string> catchers;
  std::string confine;  // --confine
};

void add_scene_argument(Options& options, SceneSource& source);
// The scene as an option, for commands that can do without.
void add_scene_option(Options& options, SceneSource& source, const char* help);
void add_light_options(Options& options, SceneSource& source);

// The folder of --confine without links; empty where there is none. Throws Error(kInput): there is no such folder.
std::string confining_folder(const SceneSource& source);

// Reads the scene, makes catchers of what is named so, and notes what of it is not rendered.
ods::Scene open_scene(const SceneSource& source);

// The same, to be rendered: in the environment asked for. A scene without lamps gets a white sky, and a note. Throws
// Error(kInput) where it has nothing to render.
ods::Scene open_lit_scene(const SceneSource& source);

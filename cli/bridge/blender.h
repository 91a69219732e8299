// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Blender, started to convert a scene. No Python of the scene runs there.
#pragma once
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "cli/console/programs.h"

struct BlenderOptions {
  std::string program;   // --blender; empty: as PATH finds it
  std::string scene;     // --scene: which of a file's scenes, by name or number; empty: the active one
  int bake = 0;          // --bake: pixels of the pictures that are made of computed materials; 0: none
  float seconds = 1800;  // --blender-limit, of each program
};

// Describes the inputs of a conversion besides the file: the Blender, the exporter and the options.
std::string describe(const BlenderOptions& options);

// Throws Error(kInput): the program has not converted the scene within its limit.
[[noreturn]] void fail_in_time(const char* program, const std::string& scene, float seconds);

// The program to start; empty: there is none. Throws Error(kInput) if --blender does not name a program.
std::string find_blender(const BlenderOptions& options);

// Blender with one of our scripts (blender/omnistereo/bridge), which are written into the folder `scripts`. flags: before
// the script. Throws as find_blender() does.
Program blender_program(const BlenderOptions& options, const std::vector<std::string>& flags,
                        const std::string& scripts, const char* script, const std::vector<std::string>& arguments);

// The beginning of a film: its first frames alone, for rendering before the rest is converted.
struct FilmBeginning {
  int count = 0;                              // of frames
  std::optional<std::pair<int, int>> frames;  // the first and the last of the film; absent: all of the file
};

// A conversion, seen from another thread.
struct ConversionWatch {
  std::function<void()> slow;  // called when following what moves is found to take long; may be empty
  std::stop_token stop;        // ends Blender; the conversion throws Error(kInput)
};

// Leaves scene.glb, bridge.json and perhaps world.exr in the folder. beginning: convert this alone. Throws Error(kInput)
// if Blender reports an error, fails, ends early or takes too long.
void run_blender(const BlenderOptions& options, const std::string& scene, const std::string& folder,
                 const ConversionWatch& watch = {}, const std::optional<FilmBeginning>& beginning = {});

// Installs and enables our add-on in the user's Blender. Throws as run_blender() does.
void install_add_on(const BlenderOptions& options);

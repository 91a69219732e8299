// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes of other programs, which Blender or Assimp converts to glTF. Each is converted once and kept while it stays as
// it is (cli/bridge/scene_cache.h).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/bridge/blender.h"
#include "ods/picture/metadata/sidecar.h"

// The frames of a file as the program that made it counts them.
struct FileFrames {
  int first = 0;
  int count = 0;  // 0: nothing moves
  int saved = 0;  // at which the file was saved
};

// A scene as Blender or Assimp has converted it.
struct ForeignScene {
  std::string file;                    // .glb
  std::string environment;             // as --env has it; empty: the scene has none of its own
  std::string background;              // as --background has it; empty: the environment
  std::optional<ods::Sidecar> camera;  // of a Blender file
  bool has_stereo = false;             // the camera's eyes and merge are the file's, too
  std::optional<float> fps;
  float shutter = 0.0f;      // angle, degrees
  float unit = 1.0f;         // metres
  FileFrames frames;
  bool is_blender_file = false;
  std::vector<std::string> warnings;
};

// Whether a file is such a scene, by its extension.
bool is_foreign_scene(const std::string& path);

// Converts it, unless that is kept; a note says so. Two processes convert it once. Throws Error(kInput): there is no
// program for it, or that fails; Error(kOutput).
ForeignScene convert_foreign_scene(const std::string& path, const BlenderOptions& options);

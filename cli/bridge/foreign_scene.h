// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes of other programs, which Blender or Assimp converts to glTF. Each is converted once and kept until it changes
// (cli/bridge/scene_cache.h).
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
  std::string environment;             // a value of --env; empty: the scene does not have one
  std::string background;              // a value of --background; empty: the environment
  std::optional<ods::Sidecar> camera;  // of a Blender file
  bool has_stereo = false;             // the camera's eyes and merge are the file's, too
  std::optional<float> fps;
  float shutter = 0.0f;  // angle, degrees
  float unit = 1.0f;     // metres
  FileFrames frames;
  bool is_blender_file = false;
  std::vector<std::string> warnings;
};

// Returns whether a file is such a scene, by its extension.
bool is_foreign_scene(const std::string& path);
// Returns whether it is one of Blender.
bool is_blend(const std::string& path);

// Reads bridge.json, which our scripts in Blender leave in a folder. Throws Error(kInput) if it is damaged.
ForeignScene read_bridge(const std::string& folder);

// Converts it with a note, or returns the kept conversion. Two processes convert it once. Throws Error(kInput) if there
// is no program for it, or the program fails; Error(kOutput).
ForeignScene convert_foreign_scene(const std::string& path, const BlenderOptions& options,
                                   const ConversionWatch& watch = {});

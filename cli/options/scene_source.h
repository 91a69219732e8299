// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that choose a scene and its light, shared by the commands that read one.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/bridge/foreign_scene.h"
#include "cli/console/options.h"
#include "cli/options/light_options.h"
#include "ods/scene/scene.h"
#include "ods/stage/place.h"
#include "ods/stage/upright.h"

// The words of --with, --at and --turn, which may be repeated.
struct ObjectOptions {
  std::vector<std::string> files;
  std::vector<std::string> places;
  std::vector<std::string> turns;
};

// An object that is put into a scene.
struct PlacedObject {
  std::string file;  // or a built-in scene
  std::optional<ods::vec3> at;
  float turn = 0.0f;  // degrees
};

struct SceneSource {
  std::string name;   // a file or a built-in scene
  std::string scene;  // which of the file's scenes, by name or number; empty: its default scene
  LightOptions light;
  std::vector<std::string> catchers;
  std::string confine;  // --confine
  std::string variant;  // of the file's materials; empty: its default
  bool solid_glass = false;
  bool portable = false;
  std::string unit = "auto";
  BlenderOptions blender;
  std::optional<ForeignScene> foreign;  // the converted scene of another program: read_foreign()
  ods::TakenFor taken_for = ods::TakenFor::kAuto;
  ods::UpAxis up = ods::UpAxis::kAuto;
  std::string camera;  // as CameraOptions::view_point
  ObjectOptions objects;
  bool has_places = false;  // other options give places in the scene: an object is not shown as a model then
};

void add_scene_argument(Options& options, SceneSource& source);
// Adds the scene as an option, for commands that work without one.
void add_scene_option(Options& options, SceneSource& source, const char* help);

// Adds --with, --at and --turn. what: "the scene", into which they are put.
void add_object_options(Options& options, ObjectOptions& objects, const std::string& what);

// Throws UsageError if the numbers of the options differ, or a value is invalid. All have a place, or none.
std::vector<PlacedObject> placed_objects(const ObjectOptions& objects);

// Throws UsageError as placed_objects(), or if objects have no place.
void check_objects(const ObjectOptions& objects);

// Opens an object as open_scene() does. Throws Error(kInput) if it has no triangles.
ods::Scene open_object(const std::string& file, const std::string& confine);

// The options for converting it: `blender`, and the scene to show.
BlenderOptions blender_options(const SceneSource& source);

// Converts a scene of another program, unless that has been done. Throws UsageError, and as
// convert_foreign_scene().
void read_foreign(SceneSource& source);

// The folder of --confine with links resolved; empty if the option was not given. Throws Error(kInput) if there is no
// such folder.
std::string confining_folder(const SceneSource& source);

// Returns the light that the options specify; a scene of another program brings its world. Throws as read_foreign() and
// read_choices().
ods::LightChoices choices_for(SceneSource& source, bool transparent);

// Reads the scene, turns the named objects into catchers, makes glass solid if asked to, and notes what the renderer
// does not support. A file's scene is measured: it gets its size in metres and a place for the viewer
// (ods/stage/place.h), and the assumptions are noted; settled, if not null, gets the result, and look is called as
// ods::settle() does (neither for built-in scenes).
ods::Scene open_scene(const SceneSource& source, ods::Settled* settled = nullptr, const ods::LookAround& look = {});

// Throws Error(kInput) if the scene has nothing to render. Notes that everything is hidden while it is at rest.
void expect_content(const ods::Scene& scene, const std::string& name);

// Opens a scene for rendering, with light: light_scene(). Notes glass that would look different if it were solid.
// Throws Error(kInput) if there is nothing to render.
ods::Scene open_lit_scene(const SceneSource& source, bool transparent);

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/scene_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/console/console.h"
#include "cli/options/camera_options.h"
#include "ods/base/error.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/files/confined_file.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/catchers.h"
#include "ods/scene/load/join.h"
#include "ods/scene/load/load.h"
#include "ods/scene/motion.h"
#include "ods/scene/sheet_glass.h"
#include "ods/stage/outlines.h"

using ods::Scene;

static void add_confine_option(Options& options, SceneSource& source) {
  options.text("--confine", ValueKind::input_folder(), source.confine,
               "read no file outside this folder, wherever paths and links in the scene lead: for untrusted scenes");
}

static void add_unit_option(Options& options, SceneSource& source) {
  options.text("--unit", "auto|UNIT|METRES", source.unit,
               "the unit of lengths in the file: m, cm, mm, in, ft, km, or its length in metres. auto: metres, unless "
               "that is implausible");
}

static void add_shape_options(Options& options, SceneSource& source) {
  add_unit_option(options, source);
  options.choice(
      "--as", source.taken_for, ods::kTakenForTable,
      "what the scene is: an object, seen from outside, or a place, where the viewer stands. auto: rays decide");
  options.choice("--up", source.up, ods::kUpAxisTable,
                 "the axis of the file that points up. auto: y, as in glTF, unless things stand on a floor with z up");
}

// Parses the value of --unit. Returns nullopt for auto.
static std::optional<float> parse_unit(const std::string& word) {
  if (word == "auto") return std::nullopt;
  if (const auto unit = ods::find_in(ods::kUnitTable, word)) return ods::row_in(ods::kUnitTable, *unit).metres;
  const std::vector<float> numbers = parse_numbers(word);
  if (numbers.size() == 1 && numbers[0] >= ods::kMinUnit && numbers[0] <= ods::kMaxUnit) return numbers[0];
  throw UsageError(fmt::format("--unit is auto, {}, or the unit in metres (0.000001 to a million), not '{}'",
                               fmt::join(ods::names_of(ods::kUnitTable), ", "), word));
}

// A file, unless it is built in.
static ValueKind scene_kind() {
  return ValueKind::input_file("SCENE", [](const std::string& name) { return !ods::find_builtin(name); });
}

static void add_blender_options(Options& options, SceneSource& source) {
  options.text("--blender", "PROGRAM", source.blender.program,
               "the Blender that converts .blend files and files of other programs; by default the one on PATH");
  options.number(
      "--bake", source.blender.bake, 0, 8192,
      "for these files: bake what nodes of materials compute into pictures this many pixels wide; 0: do not bake");
  options.number("--blender-limit", source.blender.seconds, 0.1f, 1e6f,
                 "the seconds that Blender, or Assimp in its place, may take to convert the file");
}

void add_scene_argument(Options& options, SceneSource& source) {
  options.group("Scene");
  add_blender_options(options, source);
  add_confine_option(options, source);
  options.text(
      "--scene", "NAME|NUMBER", source.scene,
      "which of the file's scenes, by its name or its number, counted from 0; by default the file's own choice");
  options.argument(
      scene_kind(), source.name,
      "a .glb or .gltf file, a .blend file or another that Blender reads (.fbx, .obj, .usd, ...), or a built-in scene "
      "(ods scenes lists them)");
  options.offer("SCENE", ods::names_of(ods::builtin_scenes()));
  options.text(
      "--variant", "NAME", source.variant,
      "which of the file's material variants to show (ods info lists them); by default each mesh's own material");
  options.flag("--solid-glass", source.solid_glass,
               "refract light in closed glass meshes that have no volume in the file, such as those of Blender");
  add_shape_options(options, source);
  options.flag("--portable", source.portable,
               "trace rays in the same way on every processor: nearly the same bits on all of them, but slower");
}

void add_scene_option(Options& options, SceneSource& source, const char* help) {
  options.text("--scene", scene_kind(), source.name, help);
  add_shape_options(options, source);
  add_confine_option(options, source);
}

void add_object_options(Options& options, ObjectOptions& objects, const std::string& what) {
  const auto kind = ValueKind::input_file("FILE", [](const std::string& name) { return !ods::find_builtin(name); });
  options.texts("--with", kind, objects.files, "put another scene into " + what + ", as an object");
  options.texts("--at", "X,Y,Z", objects.places, "where the object's own origin is put, metres, one for each --with");
  options.texts("--turn", "DEGREES", objects.turns,
                "turn the object about its vertical axis, counter-clockwise as seen from above, one for each --with");
}

std::vector<PlacedObject> placed_objects(const ObjectOptions& objects) {
  const auto check_count = [&](const char* name, size_t count) {
    if (count == 0 || count == objects.files.size()) return;
    throw UsageError(fmt::format("{} is given {} times and --with {} times: each object needs its own", name, count,
                                 objects.files.size()));
  };
  check_count("--at", objects.places.size());
  check_count("--turn", objects.turns.size());
  std::vector<PlacedObject> placed;
  for (size_t i = 0; i < objects.files.size(); i++) {
    PlacedObject& object = placed.emplace_back();
    object.file = objects.files[i];
    if (!objects.places.empty()) object.at = parse_point("--at", objects.places[i]);
    if (objects.turns.empty()) continue;
    const std::vector<float> turn = parse_numbers(objects.turns[i]);
    if (turn.size() != 1 || !(std::abs(turn[0]) <= 36000.0f)) {
      throw UsageError(fmt::format("--turn is a number of degrees within 36000, not '{}'", objects.turns[i]));
    }
    object.turn = turn[0];
  }
  return placed;
}

void check_objects(const ObjectOptions& objects) {
  for (const PlacedObject& object : placed_objects(objects)) {
    if (!object.at) throw UsageError("--with needs --at X,Y,Z, the object's place");
  }
}

// A name that may have been meant, or else the list of names.
static std::string suggestion(const Scene& scene, const std::string& name) {
  const std::vector<std::string> names = ods::object_names(scene);
  if (names.empty()) return "; it names no objects or materials";
  const std::string near = ods::did_you_mean(name, names);
  if (!near.empty()) return near;
  const size_t kMax = 12;
  const auto end = names.begin() + static_cast<ptrdiff_t>(std::min(names.size(), kMax));
  return fmt::format("; it has {}{}", fmt::join(names.begin(), end, ", "), end == names.end() ? "" : ", ...");
}

BlenderOptions blender_options(const SceneSource& source) {
  BlenderOptions options = source.blender;
  options.scene = source.scene;
  return options;
}

void read_foreign(SceneSource& source) {
  if (source.foreign || ods::find_builtin(source.name) || !is_foreign_scene(source.name)) return;
  if (!source.confine.empty()) {
    throw UsageError(
        fmt::format("--confine does not hold for '{}': Blender reads all files that it names", source.name));
  }
  source.blender = blender_options(source);
  source.foreign = convert_foreign_scene(source.name, source.blender);
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
  const ods::UnitRow* const row = ods::unit_of(metres);
  return row ? std::string(row->name) : fmt::format("{:g}", metres);
}

static void set_lamp_unit(Scene& scene, const SceneSource& source) {
  const bool guessed = source.light.lamp_unit == ods::LampUnit::kAuto && ods::lamps_are_in_watts(scene);
  if (!guessed && source.light.lamp_unit != ods::LampUnit::kWatt) return;
  ods::scale_lamps(scene, 1.0 / ods::kLumensPerWatt);
  if (guessed) {
    note(
        "Blender writes lamps 683 times as bright as emission: they are divided by 683 (--light-unit watt; "
        "--light-unit "
        "candela keeps them)");
  }
}

// Built-in scenes are in metres and have a view point.
static void settle_scene(Scene& scene, const SceneSource& source, ods::Settled* result, const ods::LookAround& look) {
  std::optional<float> unit = parse_unit(source.unit);
  if (!unit && source.foreign && source.foreign->is_blender_file) unit = source.foreign->unit;
  if (ods::find_builtin(source.name)) return ods::scale_scene(scene, unit.value_or(1.0f));
  const ods::SettleOptions options{unit, !source.has_places, source.taken_for, ods::camera_choice(source.camera)};
  const ods::Settled settled = ods::settle(scene, options, look);
  if (result) *result = settled;
  if (!settled.camera_reason.empty()) {
    note(fmt::format("{}: it is not used (--camera '{}' uses it)", settled.camera_reason,
                     scene.view_points.front().name));
  }
  if (!settled.unit_reason.empty()) {
    note(fmt::format("{} (--unit {}; --unit m keeps its size)", settled.unit_reason,
                     unit_word(settled.metres_per_unit)));
  }
  if (settled.doubted) note(settle_doubt(settled.kind));
}

// The scene as --up has it.
static Scene load_upright(const SceneSource& source) {
  const std::string& file = source.foreign ? source.foreign->file : source.name;
  const bool is_number = std::ranges::all_of(source.scene, [](char c) { return c >= '0' && c <= '9'; }) &&
                         !source.scene.empty() && source.scene.size() < 8;
  ods::SceneOptions options{
      .scene = is_number && !source.foreign ? std::atoi(source.scene.c_str()) : -1,
      .scene_name = is_number || source.foreign ? "" : source.scene,
      .confine = source.foreign ? "" : confining_folder(source),
      .variant = source.variant,
      .camera = ods::camera_choice(source.camera) == ods::CameraChoice::kNamed ? source.camera : "",
      .z_up = source.up == ods::UpAxis::kZ,
      .finds_origin = !(source.foreign && source.foreign->is_blender_file)};  // its camera has the file's coordinates
  Scene scene = ods::load_scene(file, options);
  const bool is_upright = ods::find_builtin(source.name) || (source.foreign && source.foreign->is_blender_file);
  const std::string sign = source.up != ods::UpAxis::kAuto || is_upright ? "" : ods::why_on_its_back(scene);
  if (sign.empty()) return scene;
  note(fmt::format("{}: z is taken as up (--up z; --up y turns this off)", sign));
  options.z_up = true;
  return ods::load_scene(file, options);
}

// Treats a Blender file as Cycles does, for which all closed glass is solid and no face is culled, and other files as
// real-time programs do.
static Scene load(const SceneSource& source) {
  Scene scene = load_upright(source);
  const bool is_blender_file = source.foreign && source.foreign->is_blender_file;
  if (is_blender_file) {
    make_glass_solid(scene);
  } else if (!ods::find_builtin(source.name)) {
    make_sheets_thin(scene);
    mark_outlines(scene);
  }
  if (!source.foreign) return scene;
  const ForeignScene& foreign = *source.foreign;
  scene.name = std::filesystem::path(source.name).stem().string();
  scene.warnings.insert(scene.warnings.begin(), foreign.warnings.begin(), foreign.warnings.end());
  return scene;
}

Scene open_scene(const SceneSource& given, ods::Settled* settled, const ods::LookAround& look) {
  SceneSource source = given;
  read_foreign(source);
  Scene scene = load(source);
  scene.portable = source.portable;
  for (const std::string& name : source.catchers) {
    if (make_catchers(scene, name)) continue;
    throw UsageError(
        fmt::format("--shadow-catcher: nothing in the scene is called '{}'{}", name, suggestion(scene, name)));
  }
  const bool is_solid = source.foreign && source.foreign->is_blender_file;
  if (source.solid_glass && !is_solid && make_glass_solid(scene) == 0) {
    note("--solid-glass changes nothing: no closed mesh has glass without a volume");
  }
  if (scene.origin != glm::dvec3(0.0)) {
    note(fmt::format("the scene is far from its file's origin: positions count from {:.0f},{:.0f},{:.0f} there",
                     scene.origin.x, scene.origin.y, scene.origin.z));
  }
  set_lamp_unit(scene, source);
  settle_scene(scene, source, settled, look);
  for (const std::string& loss : scene.losses) note(loss);
  for (const std::string& warning : scene.warnings) warn(warning);
  return scene;
}

Scene open_object(const std::string& file, const std::string& confine) {
  SceneSource source;
  source.name = file;
  source.confine = confine;
  source.taken_for = ods::TakenFor::kObject;
  source.has_places = true;  // beside other things, a ring stays as small as it is
  Scene object = open_scene(source);
  if (object.instances.empty()) {
    throw ods::Error(ods::ErrorKind::kInput, fmt::format("--with '{}' has no triangles that could be shown", file));
  }
  return object;
}

static void add_objects(Scene& scene, const SceneSource& source) {
  check_objects(source.objects);
  for (const PlacedObject& object : placed_objects(source.objects)) {
    join(scene, open_object(object.file, source.confine), ods::place_of_object(*object.at, object.turn));
  }
}

void expect_content(const Scene& scene, const std::string& name) {
  const auto nothing = [&](const char* why) {
    return ods::Error(ods::ErrorKind::kInput,
                      fmt::format("'{}' has nothing to render: {} (ods info lists its contents)", name, why));
  };
  if (scene.instances.empty()) throw nothing("no triangles are visible in the scene that is shown");
  if (!is_ever_visible(scene)) throw nothing("everything in it is always hidden");
  if (!is_anything_visible(scene)) {
    note("everything is hidden while the scene is at rest; --time or --frames shows it moving");
  }
}

// Warns if every surface is transparent, as in files written with the opposite meaning of Collada's transparency.
static void warn_of_invisible(const Scene& scene) {
  const bool is_invisible = std::ranges::all_of(scene.instances, [&](const ods::Instance& instance) {
    const int material = scene.meshes[static_cast<size_t>(instance.mesh)].material;
    const ods::Material& its = scene.materials[static_cast<size_t>(material)];
    return its.alpha_mode != ods::kAlphaOpaque && its.base_color.w == 0.0f;
  });
  if (is_invisible) warn("all surfaces of the scene are entirely transparent: the picture shows none of it");
}

static void note_sheet_glass(const Scene& scene) {
  std::vector<ods::SheetGlass> glass = find_sheet_glass(scene);
  std::erase_if(glass, [](const ods::SheetGlass& each) { return each.closed_meshes == 0; });
  if (glass.empty()) return;
  const size_t others = glass.size() - 1;
  note(
      fmt::format("glass '{}'{} rendered as thin sheets, because the file gives it no volume; --solid-glass makes it "
                  "refract",
                  glass.front().name,
                  others == 0 ? " is" : fmt::format(" and {} other material{} are", others, others == 1 ? "" : "s")));
}

ods::LightChoices choices_for(SceneSource& source, bool transparent) {
  read_foreign(source);
  if (source.foreign && source.light.environment.empty()) {
    source.light.environment = source.foreign->environment;
    if (source.light.background.empty()) source.light.background = source.foreign->background;
  }
  return read_choices(source.light, transparent, confining_folder(source));
}

Scene open_lit_scene(const SceneSource& given, bool transparent) {
  SceneSource source = given;
  const ods::LightChoices choices = choices_for(source, transparent);
  const std::string confined_to = confining_folder(source);
  PlannedLight planned;
  Scene scene = open_scene(source, nullptr, [&](const ods::SceneRays& rays, const ods::Survey& survey) {
    planned = {survey, ods::plan_light(rays, survey, choices)};
  });
  expect_content(scene, source.name);
  add_objects(scene, source);
  warn_of_invisible(scene);
  note_sheet_glass(scene);
  light_scene(scene, source.light, choices, ods::find_builtin(source.name) != nullptr, confined_to, std::move(planned));
  return scene;
}

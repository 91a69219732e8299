// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/identity.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <tuple>
#include <type_traits>
#include <utility>

#include "ods/base/text.h"
#include "ods/camera/camera_fields.h"
#include "ods/files/confined_file.h"
#include "ods/files/md5.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/gltf/gltf.h"

namespace ods {
namespace {

// --- values as text --------------------------------------------------------------------------------------------------

std::string text_of(const vec3& point) {
  return fmt::format("{},{},{}", point.x, point.y, point.z);
}

std::string text_of(const std::vector<vec3>& points) {
  std::vector<std::string> texts;
  for (const vec3& point : points) texts.push_back(text_of(point));
  return fmt::format("{}", fmt::join(texts, ";"));
}

std::string text_of(const std::string& text) {
  return text;
}

std::string text_of(const Part& part) {
  return part_text(part);
}

template <typename Value>
requires(!std::is_class_v<Value>) std::string text_of(Value value) {
  if constexpr (std::is_same_v<Value, bool>) return value ? "on" : "off";
  if constexpr (std::is_same_v<Value, Caustics>) return std::string(caustics_name(value));
  if constexpr (std::is_same_v<Value, Indirect>) return std::string(indirect_name(value));
  if constexpr (std::is_same_v<Value, Eyes>) return std::string(eyes_name(value));
  if constexpr (std::is_same_v<Value, PixelFilter>) return std::string(pixel_filter_name(value));
  if constexpr (std::is_same_v<Value, Layout>) return std::string(layout_name(value));
  if constexpr (std::is_same_v<Value, Denoiser>) return std::string(name_in(kDenoiserTable, value));
  if constexpr (std::is_enum_v<Value>) return fmt::format("{}", static_cast<int>(value));
  if constexpr (std::is_arithmetic_v<Value>) return fmt::format("{}", value);
}

template <typename Value>
std::string text_of(const std::optional<Value>& value) {
  return value ? text_of(*value) : "";
}

// --- the table -------------------------------------------------------------------------------------------------------

enum class Changes {
  kNothing,  // neither samples nor the file of a frame
  kFile,     // the file of a frame; the samples of a still picture may be continued with another value
  kSamples,
};
using enum Changes;

template <typename Struct, typename Member>
struct Field {
  Member Struct::*member;
  std::string_view name;  // of the setting; empty where nothing is changed
  Changes changes;
  std::string_view why;
  std::string_view otherwise = {};                        // instead of an empty text
  bool (*matters)(const SequenceOptions& all) = nullptr;  // else any value will do; null: it always does
};
template <typename Struct, typename Member, typename... Rest>
Field(Member Struct::*, Rest...) -> Field<Struct, Member>;

constexpr std::string_view kAim = "aims the rays", kPaths = "other paths", kPixels = "which pixels there are";
constexpr std::string_view kCount = "how many there are", kSums = "which sums are kept", kSameBits = "the same bits";
constexpr std::string_view kRows = "its members have rows",
                           kVideo = "affects only the video: its frames are scene-linear";

bool judges_noise(const SequenceOptions& all) {
  return all.render.noise > 0.0f;
}

bool lasts(const SequenceOptions& all) {
  return moves(all.camera.move) && all.camera.move.seconds > 0.0;
}

constexpr std::tuple kSequenceFields = {
    Field{&SequenceOptions::scene, "", kNothing, "its settings are listed"},
    Field{&SequenceOptions::camera, "", kNothing, kRows},
    Field{&SequenceOptions::merge_limit, "`merge`", kSamples, "finds the merge", "given"},
    Field{&SequenceOptions::fps, "`fps`", kSamples, "when a frame is"},
    Field{&SequenceOptions::first_frame, "first frame", kSamples, "when a frame is"},
    Field{&SequenceOptions::shutter, "`shutter`", kSamples, "when samples are"},
    Field{&SequenceOptions::changing_grain, "`grain`", kSamples, "the seed of a frame", "by default"},
    // Blocks of pixels stop sampling according to it. Those of a still picture are judged again.
    Field{&SequenceOptions::exposure, kExposureSetting, kFile, "noise is judged at it", kByFirstLook, judges_noise},
    Field{&SequenceOptions::brighter, "`brighter`", kFile, "noise is judged at it", "", judges_noise},
    Field{&SequenceOptions::render, "", kNothing, kRows},
    Field{&SequenceOptions::finish, "", kNothing, kRows},
    Field{&SequenceOptions::draws_on_neighbours, "frames denoised together", kFile, "what the denoiser sees"},
    Field{&SequenceOptions::warn, "", kNothing, "messages"},
};
constexpr std::tuple kCameraFields = {
    Field{&SceneCamera::stereo, "", kNothing, "add_stereo() lists it"},
    Field{&SceneCamera::view_point, "`camera`", kSamples, kAim, "the first"},
    Field{&SceneCamera::position, "`position`", kSamples, kAim, "of the scene"},
    Field{&SceneCamera::yaw, "`yaw`", kSamples, kAim, "of the scene"},
    Field{&SceneCamera::pitch, "`pitch`", kSamples, kAim, "0"},
    Field{&SceneCamera::roll, "`roll`", kSamples, kAim, "0"},
    Field{&SceneCamera::move, "", kNothing, kRows},
};
constexpr std::tuple kMoveFields = {
    Field{&CameraMove::turns, "`turntable`", kSamples, kAim},
    Field{&CameraMove::pivot, "the turntable's axis", kSamples, kAim, "none"},
    Field{&CameraMove::fly_to, "`fly-to`", kSamples, kAim, "nowhere"},
    Field{&CameraMove::seconds, "`duration`", kSamples, "the speed of a move", "", lasts},
};
constexpr std::tuple kRenderFields = {
    Field{&RenderOptions::width, "`width`", kSamples, kPixels},
    Field{&RenderOptions::height, "`height`", kSamples, kPixels},
    Field{&RenderOptions::samples, "`samples`", kSamples, kCount},
    Field{&RenderOptions::noise, "`noise`", kSamples, kCount},
    Field{&RenderOptions::noise_exposure, "", kNothing, "SequenceOptions::exposure decides it"},
    Field{&RenderOptions::time_limit, "`time-limit`", kFile, "how many there are; a still picture may get more"},
    Field{&RenderOptions::part, kPartSetting, kSamples, "which samples there are"},
    Field{&RenderOptions::even_noise, "even noise", kSamples, kCount},
    Field{&RenderOptions::bounces, "`bounces`", kSamples, kPaths},
    Field{&RenderOptions::clamp, "`clamp`", kSamples, kPaths},
    Field{&RenderOptions::caustics, "`caustics`", kSamples, kPaths},
    Field{&RenderOptions::indirect, "`indirect`", kSamples, kPaths},
    Field{&RenderOptions::cache_paths, "paths of the light cache", kSamples, kPaths},
    Field{&RenderOptions::eyes, "`eyes`", kSamples, kPixels},
    Field{&RenderOptions::share_paths, "shared paths", kSamples, kPaths},
    Field{&RenderOptions::filter, "`filter`", kSamples, "where in a pixel samples are"},
    Field{&RenderOptions::layers, "layers", kSamples, kSums},
    Field{&RenderOptions::transparent, "`transparent`", kSamples, kSums},
    Field{&RenderOptions::statistics, "statistics", kSamples, kSums},
    Field{&RenderOptions::seed, "`seed`", kSamples, kPaths},
    Field{&RenderOptions::threads, "", kNothing, kSameBits},
    Field{&RenderOptions::gpu, "", kNothing, "samples of devices can be mixed"},
    Field{&RenderOptions::shader_cache, "", kNothing, kSameBits},
    Field{&RenderOptions::light_sampling, "light sampling", kSamples, kPaths},
    Field{&RenderOptions::last_tile_first, "", kNothing, kSameBits},
};
constexpr std::tuple kFinishFields = {
    Field{&FinishOptions::denoiser, "`denoise`", kSamples, kSums},
    Field{&FinishOptions::save, "", kNothing, kRows},
};
constexpr std::tuple kSaveFields = {
    Field{&SaveOptions::layout, "`layout`", kFile, "where the eyes are in it"},
    Field{&SaveOptions::exposure, "", kNothing, kVideo},
    Field{&SaveOptions::tone, "", kNothing, kVideo},
    Field{&SaveOptions::jpeg_quality, "", kNothing, kVideo},
    Field{&SaveOptions::rows_alone, "", kNothing, "the same pixels"},
    Field{&SaveOptions::has_checksum, "", kNothing, "the same pixels"},
    Field{&SaveOptions::attributes, "", kNothing, "the same pixels"},
    Field{&SaveOptions::exif, "", kNothing, "the same pixels"},
    Field{&SaveOptions::sidecar, "", kNothing, "a file of its own"},
};

// Every member has its row: as many can be initialised as there are rows, and no more.
struct Anything {
  template <typename Member>
  operator Member() const {
    std::abort();  // never called
  }
};
template <typename Struct, size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
  return requires {
    Struct{(static_cast<void>(I), Anything{})...};
  };
}
template <typename Struct, typename... Members>
constexpr bool has_all_rows(const std::tuple<Field<Struct, Members>...>&) {
  constexpr size_t count = sizeof...(Members);
  return takes<Struct>(std::make_index_sequence<count>{}) && !takes<Struct>(std::make_index_sequence<count + 1>{});
}
static_assert(has_all_rows(kSequenceFields) && has_all_rows(kCameraFields) && has_all_rows(kMoveFields));
static_assert(has_all_rows(kRenderFields) && has_all_rows(kFinishFields) && has_all_rows(kSaveFields));

// --- the settings ----------------------------------------------------------------------------------------------------

void add(Settings& settings, std::string_view name, const std::string& value) {
  settings.push_back({std::string(name), one_line(value), ""});
}

// Adds the fields of one structure whose effect is at least `minimum`.
template <typename Struct, typename... Members>
void add_fields(Settings& settings, const std::tuple<Field<Struct, Members>...>& fields, const Struct& of,
                const SequenceOptions& all, Changes minimum) {
  const auto add_field = [&](const auto& field) {
    if constexpr (requires { text_of(of.*field.member).empty(); }) {
      if (field.name.empty() || field.changes < minimum) return;
      const std::string text = !field.matters || field.matters(all) ? text_of(of.*field.member) : "any";
      add(settings, field.name, text.empty() ? std::string(field.otherwise) : text);
    }
  };
  std::apply([&](const auto&... field) { (add_field(field), ...); }, fields);
}

void add_map(Settings& settings, std::string_view name, const std::shared_ptr<const Image>& map) {
  if (!map) return;
  const std::string_view bytes(reinterpret_cast<const char*>(map->pixels.data()), map->pixels.size() * sizeof(float));
  add(settings, name, md5(fmt::format("{}x{}", map->width, map->height) + std::string(bytes)));
}

// The camera's place comes from the scene, or has rows of its own.
void add_stereo(Settings& settings, const SequenceOptions& options) {
  const StereoCamera& stereo = options.camera.stereo;
  assert(!stereo.texel_rays);  // textures are not frames
  add(settings, "`projection`", std::string(projection_name(stereo.projection)));
  for (const auto& [name, value] : camera_settings(stereo)) {
    if (name == "position" || name == "yaw" || name == "pitch" || name == "roll") continue;
    add(settings, name == "aspect" ? "width over height" : fmt::format("`{}`", name), value.empty() ? "none" : value);
  }
  if (options.merge_limit) {
    add(settings, kMergeSetting, std::string(kByFirstLook));
  } else {
    add_map(settings, "`merge-map`", stereo.merge_map);
  }
  add_map(settings, "`head-tilt-map`", stereo.head_tilt_map);
  add(settings, "`left-handed`", text_of(stereo.mirrored));
}

Settings identity(const SequenceOptions& options, Changes minimum) {
  Settings settings = {{"version of ods", ODS_VERSION, ""}};
  settings.insert(settings.end(), options.scene.begin(), options.scene.end());
  add_fields(settings, kCameraFields, options.camera, options, minimum);
  add_stereo(settings, options);
  add_fields(settings, kSequenceFields, options, options, minimum);
  add_fields(settings, kMoveFields, options.camera.move, options, minimum);
  add_fields(settings, kRenderFields, options.render, options, minimum);
  add_fields(settings, kSaveFields, options.finish.save, options, minimum);
  add_fields(settings, kFinishFields, options.finish, options, minimum);
  return settings;
}

}  // namespace

Settings frame_identity(const SequenceOptions& options) {
  return identity(options, Changes::kFile);
}

Settings sample_identity(const SequenceOptions& options, double seconds) {
  Settings settings = identity(options, Changes::kSamples);
  add(settings, "`time`", text_of(seconds));
  return settings;
}

Settings render_settings(const RenderOptions& options) {
  Settings settings = {{"version of ods", ODS_VERSION, ""}};
  add_fields(settings, kRenderFields, options, {}, Changes::kSamples);
  return settings;
}

Setting file_setting(const std::string& name, const std::string& path, const std::string& confine) {
  std::error_code error;
  const bool is_there = std::filesystem::is_regular_file(path, error);
  return {name, is_there ? ConfinedFile(path, confine).read(md5_of_file) : "missing", one_line(path)};
}

Settings scene_settings(const std::string& name_or_path, const std::string& confine) {
  std::error_code error;
  if (find_builtin(name_or_path) || !std::filesystem::is_regular_file(name_or_path, error)) {
    return {{"SCENE", one_line(name_or_path), ""}};
  }
  Settings settings = {file_setting("SCENE", name_or_path, confine)};
  const std::filesystem::path folder = std::filesystem::path(name_or_path).parent_path();
  for (const std::string& file : gltf_files(name_or_path, confine)) {
    settings.push_back(file_setting(fmt::format("SCENE's file {}", one_line(file)), (folder / file).native(), confine));
  }
  return settings;
}

}  // namespace ods

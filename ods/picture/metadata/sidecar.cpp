// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/metadata/sidecar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "ods/base/decimal.h"
#include "ods/base/error.h"
#include "ods/base/json_reader.h"
#include "ods/base/quote.h"
#include "ods/camera/camera_fields.h"
#include "ods/camera/file_names.h"
#include "ods/files/atomic_file.h"
#include "ods/files/read_file.h"

namespace ods {
namespace {

constexpr size_t kLargestFile = 1u << 30u;  // bytes; enough for two of the largest maps

// --- writing ---------------------------------------------------------------------------------------------------------

// The object and the key of a place: "lens.radius" is `radius` of `lens`, "yaw" is a key of the file itself.
struct Place {
  std::string object;
  std::string key;
};

Place place_of(std::string_view text) {
  const size_t dot = text.find('.');
  if (dot == std::string_view::npos) return {"", std::string(text)};
  return {std::string(text.substr(0, dot)), std::string(text.substr(dot + 1))};
}

Json& at(Json& json, std::string_view text) {
  const Place place = place_of(text);
  return place.object.empty() ? json[place.key] : json[place.object][place.key];
}

Json to_json(const std::vector<float>& values) {
  if (values.size() == 1) return decimal(values[0]);
  Json json = Json::array();
  for (const float value : values) json.push_back(decimal(value));
  return json;
}

Json to_json(const Image& map) {
  Json values = Json::array();
  for (float value : map.pixels) values.push_back(decimal(value));
  return {{"width", map.width}, {"height", map.height}, {"values", values}};
}

Json conventions() {
  return {{"lengths", "metres"},
          {"angles", "degrees"},
          {"world", "right-handed, +Y up; at yaw 0 the middle of the picture looks along -Z and +X is to the right"},
          {"attitude", "roll clockwise, then pitch up, then yaw to the right"},
          {"ipd", "the full distance between the eyes"},
          {"merge", "from start to end degrees of elevation; 0 is the horizon"}};
}

// --- reading ---------------------------------------------------------------------------------------------------------

// Reads the fields in the tables of a camera from one object of the file; "" is the file itself.
void read_object(JsonReader& in, std::string_view object, StereoCamera& camera) {
  for (const CameraModeRow& row : camera_modes()) {
    const Place place = place_of(row.place);
    if (place.object != object) continue;
    const std::string word = in.word(place.key);
    const auto named = std::ranges::find(row.names, word, &NameRow<int>::name);
    if (named != row.names.end()) row.value(camera) = named->member;
    if (named == row.names.end() && !word.empty()) in.fail(place.key, fmt::format("is unknown: '{}'", word));
  }
  for (const CameraFieldRow& row : camera_fields()) {
    const Place place = place_of(row.place);
    if (place.object != object) continue;
    const std::vector<float*> numbers = row.numbers(camera);
    std::vector<float> values;
    if (numbers.size() == 1) in.number(place.key, *numbers[0], row.range.minimum, row.range.maximum);
    if (numbers.size() < 2 || !in.numbers(place.key, values, numbers.size(), row.range.minimum, row.range.maximum))
      continue;
    for (size_t i = 0; i < values.size(); i++) *numbers[i] = values[i];
  }
}

void read_merge(JsonReader& in, std::string_view object, StereoCamera& camera, const PoleMergeSetting& merge) {
  read_object(in, object, camera);
  if (merge.start >= merge.end) in.fail("start", "must be below its end");
}

void read_projection(JsonReader& in, StereoCamera& camera) {
  const std::string name = in.word("name");
  const NamedProjection* named = find_projection(name.empty() ? "lat-long" : name);
  if (!named) in.fail("name", fmt::format("is unknown: '{}'", name));
  camera.projection = named->setting;
  read_object(in, "projection", camera);
  const std::string fault = projection_fault(camera.projection);
  if (!fault.empty()) in.fail("", "is impossible: " + fault);
}

// An axis of null is an axis that is not set.
void read_pose(JsonReader& in, StereoCamera& camera) {
  if (in.find("axis") && !in.is_null("axis")) camera.axis = vec3(0.0f);
  read_object(in, "", camera);
  if (camera.axis && !(length(*camera.axis) > 1e-6f)) in.fail("axis", "must be a direction");
  in.flag("mirrored", camera.mirrored);
}

std::shared_ptr<const Image> read_map(JsonReader& in) {
  int width = 0, height = 0;
  in.integer("width", width, 1, 1 << 15);
  in.integer("height", height, 1, 1 << 15);
  const int64_t texels = int64_t{width} * height;
  std::vector<float> values;
  if (texels < 1 || texels > kLargestMap || !in.numbers("values", values, static_cast<size_t>(texels), 0.0f, 1.0f)) {
    in.fail("values", "must be width times height numbers");
  }
  auto map = std::make_shared<Image>(width, height, 1);
  map->pixels = std::move(values);
  return map;
}

void read_picture(JsonReader& in, Sidecar& file) {
  in.integer("eye_width", file.eye.width, 0, 1 << 20);
  in.integer("eye_height", file.eye.height, 0, 1 << 20);
  const std::string layout = in.word("layout");
  if (!layout.empty()) {
    const auto known = layout_of(layout);
    if (!known) in.fail("layout", fmt::format("is unknown: '{}'", layout));
    file.layout = *known;
  }
  const Json* eyes = in.find("eyes");
  if (!eyes) return;
  for (const std::vector<int>& legal : {std::vector{kLeft, kRight}, {kLeft}, {kRight}, {kMono}}) {
    Json names = Json::array();
    for (int eye : legal) names.push_back(eye_name(eye));
    if (*eyes != names) continue;
    file.eyes = legal;
    return;
  }
  in.fail("eyes", R"(must be ["left", "right"], ["left"], ["right"] or ["mono"])");
}

}  // namespace

std::string write_sidecar(const Sidecar& file) {
  const StereoCamera& camera = file.camera;
  Json eyes = Json::array();
  for (int eye : file.eyes) eyes.push_back(eye_name(eye));
  Json json = {{"omnistereo_camera", kSidecarVersion},
               {"made_by", "ods " ODS_VERSION},
               {"conventions", conventions()},
               {"picture",
                {{"eye_width", file.eye.width},
                 {"eye_height", file.eye.height},
                 {"layout", layout_name(file.layout)},
                 {"eyes", eyes}}},
               {"projection", {{"name", projection_name(camera.projection)}}}};
  for (const CameraModeRow& row : camera_modes()) at(json, row.place) = mode_of(camera, row);
  for (const CameraFieldRow& row : camera_fields()) {
    const std::vector<float> values = values_of(camera, row);
    if (!values.empty()) at(json, row.place) = to_json(values);
  }
  if (!camera.axis) json["axis"] = nullptr;
  json["merge_map"] = camera.merge_map ? to_json(*camera.merge_map) : Json(nullptr);
  json["head_tilt_map"] = camera.head_tilt_map ? to_json(*camera.head_tilt_map) : Json(nullptr);
  json["mirrored"] = camera.mirrored;
  return json_document(json, 2) + "\n";
}

Sidecar read_sidecar(std::string_view text, const std::string& name, std::vector<std::string>& warnings) {
  const Json json = parse_json(text, name, "camera");
  JsonReader in(json, name, "camera", "", warnings);
  in.version("omnistereo_camera", kSidecarVersion);
  in.find("made_by");
  in.find("conventions");
  Sidecar file;
  StereoCamera& camera = file.camera;
  read_pose(in, camera);
  in.part("projection", [&](JsonReader& part) { read_projection(part, camera); });
  file.layout = default_layout(camera.projection);
  in.part("picture", [&](JsonReader& part) { read_picture(part, file); });
  in.part("merge_top", [&](JsonReader& part) { read_merge(part, "merge_top", camera, camera.top); });
  in.part("merge_bottom", [&](JsonReader& part) { read_merge(part, "merge_bottom", camera, camera.bottom); });
  for (const char* object : {"convergence", "lens"}) {
    in.part(object, [&](JsonReader& part) { read_object(part, object, camera); });
  }
  for (const auto& [key, map] :
       {std::pair{"merge_map", &camera.merge_map}, std::pair{"head_tilt_map", &camera.head_tilt_map}}) {
    if (!in.is_null(key)) in.part(key, [&map = map](JsonReader& part) { *map = read_map(part); });
  }
  in.finish();
  if (!camera.merge_map && (camera.top.mode == kMergeMap || camera.bottom.mode == kMergeMap)) {
    in.fail("merge_map", "is missing, but a merge uses it");
  }
  return file;
}

Sidecar load_sidecar(const std::string& path, std::vector<std::string>& warnings) {
  const std::vector<unsigned char> bytes = read_file(path, kLargestFile);
  return read_sidecar({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path, warnings);
}

void save_sidecar(const Sidecar& file, const std::string& path) {
  write_file(path, write_sidecar(file));
}

std::string sidecar_path(const std::string& picture) {
  std::string stem = picture;
  for (const size_t count : {size_t{2}, kFaceCount}) {
    if (words_in_braces(picture, count)) stem = without_words(picture);
  }
  const size_t slash = stem.rfind('/');
  const size_t name = slash == std::string::npos ? 0 : slash + 1;
  const size_t dot = stem.rfind('.');
  if (dot != std::string::npos && dot > name) stem.resize(dot);
  for (const std::string eye : {"_%V", "_%v", ".%V", ".%v", "%V", "%v"}) {
    const size_t at = stem.find(eye, name);
    if (at != std::string::npos && stem.size() - name > eye.size()) stem.erase(at, eye.size());
  }
  return stem + ".camera.json";
}

}  // namespace ods

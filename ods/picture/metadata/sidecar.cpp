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
#include "ods/camera/camera_fields.h"
#include "ods/files/atomic_file.h"
#include "ods/files/read_file.h"

namespace ods {
namespace {

constexpr size_t kLargestFile = 1u << 30u;  // bytes; room for two of the largest maps

// --- writing ---------------------------------------------------------------------------------------------------------

Json numbers(std::initializer_list<float> values) {
  Json json = Json::array();
  for (float value : values) json.push_back(decimal(value));
  return json;
}

Json to_json(vec2 v) {
  return numbers({v.x, v.y});
}

Json to_json(vec3 v) {
  return numbers({v.x, v.y, v.z});
}

Json to_json(const PoleMergeSetting& merge) {
  return {{"mode", merge_name(merge.mode)},
          {"start", decimal(merge.start)},
          {"end", decimal(merge.end)},
          {"exponent", decimal(merge.exponent)}};
}

Json to_json(const ProjectionSetting& setting) {
  Json json = {{"name", projection_name(setting)},      {"longitude", to_json(setting.longitude)},
               {"latitude", to_json(setting.latitude)}, {"fov", decimal(setting.fov)},
               {"aspect", decimal(setting.aspect)},     {"pan", decimal(setting.pan)},
               {"tilt", decimal(setting.tilt)}};
  if (setting.kind == kFisheyePolynomial) {
    json["sensor"] = to_json(setting.sensor);
    json["polynomial"] = Json::array();
    for (const float k : setting.polynomial) json["polynomial"].push_back(decimal(k));
  }
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

void read_number(JsonReader& in, const char* key, float& value, CameraField field) {
  in.number(key, value, range_of(field).least, range_of(field).most);
}

template <class Vector>
bool read_vector(JsonReader& in, const char* key, Vector& value, CameraField field) {
  return in.vector(key, value, range_of(field).least, range_of(field).most);
}

void read_merge(JsonReader& in, PoleMergeSetting& merge) {
  const std::string mode = in.word("mode");
  if (!mode.empty()) {
    const auto known = merge_of(mode);
    if (!known) in.fail("mode", fmt::format("is unknown: '{}'", mode));
    merge.mode = *known;
  }
  read_number(in, "start", merge.start, CameraField::kMergeStart);
  read_number(in, "end", merge.end, CameraField::kMergeEnd);
  read_number(in, "exponent", merge.exponent, CameraField::kMergeExponent);
  if (merge.start >= merge.end) in.fail("start", "must be below its end");
}

void read_projection(JsonReader& in, ProjectionSetting& setting) {
  const std::string name = in.word("name");
  const NamedProjection* named = find_projection(name.empty() ? "lat-long" : name);
  if (!named) in.fail("name", fmt::format("is unknown: '{}'", name));
  setting = named->setting;
  read_vector(in, "longitude", setting.longitude, CameraField::kLongitude);
  read_vector(in, "latitude", setting.latitude, CameraField::kLatitude);
  read_number(in, "fov", setting.fov, CameraField::kFov);
  read_number(in, "aspect", setting.aspect, CameraField::kAspect);
  read_number(in, "pan", setting.pan, CameraField::kPan);
  read_number(in, "tilt", setting.tilt, CameraField::kTilt);
  read_vector(in, "sensor", setting.sensor, CameraField::kSensor);
  const FieldRange range = range_of(CameraField::kPolynomial);
  std::vector<float> k;
  if (in.numbers("polynomial", k, setting.polynomial.size(), range.least, range.most)) {
    std::copy(k.begin(), k.end(), setting.polynomial.begin());
  }
  const std::string fault = projection_fault(setting);
  if (!fault.empty()) in.fail("", "is impossible: " + fault);
}

void read_convergence(JsonReader& in, StereoCamera& camera) {
  const std::string mode = in.word("mode");
  const std::optional<int> convergence = find_in(kConvergenceTable, mode);
  if (convergence) camera.convergence = *convergence;
  if (!convergence && !mode.empty()) in.fail("mode", fmt::format("is unknown: '{}'", mode));
  read_number(in, "distance", camera.convergence_distance, CameraField::kConvergenceDistance);
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

void read_pose(JsonReader& in, StereoCamera& camera) {
  read_vector(in, "position", camera.position, CameraField::kPosition);
  read_number(in, "yaw", camera.yaw, CameraField::kYaw);
  read_number(in, "pitch", camera.pitch, CameraField::kPitch);
  read_number(in, "roll", camera.roll, CameraField::kRoll);
  read_number(in, "ipd", camera.ipd, CameraField::kIpd);
  read_number(in, "neck", camera.neck, CameraField::kNeck);
  in.flag("mirrored", camera.mirrored);
  vec3 axis(0.0f);
  if (!in.is_null("axis") && read_vector(in, "axis", axis, CameraField::kAxis)) {
    if (!(length(axis) > 1e-6f)) in.fail("axis", "must be a direction");
    camera.axis = axis;
  }
}

void read_lens(JsonReader& in, StereoCamera& camera) {
  read_number(in, "radius", camera.lens_radius, CameraField::kLensRadius);
  read_number(in, "focus_distance", camera.focus_distance, CameraField::kFocusDistance);
}

}  // namespace

std::string write_sidecar(const Sidecar& file) {
  const StereoCamera& camera = file.camera;
  Json eyes = Json::array();
  for (int eye : file.eyes) eyes.push_back(eye_name(eye));
  const Json json = {
      {"omnistereo_camera", kSidecarVersion},
      {"made_by", "ods " ODS_VERSION},
      {"conventions", conventions()},
      {"picture",
       {{"eye_width", file.eye.width},
        {"eye_height", file.eye.height},
        {"layout", layout_name(file.layout)},
        {"eyes", eyes}}},
      {"projection", to_json(camera.projection)},
      {"position", to_json(camera.position)},
      {"yaw", decimal(camera.yaw)},
      {"pitch", decimal(camera.pitch)},
      {"roll", decimal(camera.roll)},
      {"ipd", decimal(camera.ipd)},
      {"neck", decimal(camera.neck)},
      {"merge_top", to_json(camera.top)},
      {"merge_bottom", to_json(camera.bottom)},
      {"merge_map", camera.merge_map ? to_json(*camera.merge_map) : Json(nullptr)},
      {"head_tilt_map", camera.head_tilt_map ? to_json(*camera.head_tilt_map) : Json(nullptr)},
      {"convergence",
       {{"mode", convergence_name(camera.convergence)}, {"distance", decimal(camera.convergence_distance)}}},
      {"axis", camera.axis ? to_json(*camera.axis) : Json(nullptr)},
      {"lens", {{"radius", decimal(camera.lens_radius)}, {"focus_distance", decimal(camera.focus_distance)}}},
      {"mirrored", camera.mirrored}};
  return json.dump(2) + "\n";
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
  in.part("projection", [&](JsonReader& reader) { read_projection(reader, camera.projection); });
  file.layout = default_layout(camera.projection);
  in.part("picture", [&](JsonReader& reader) { read_picture(reader, file); });
  in.part("merge_top", [&](JsonReader& reader) { read_merge(reader, camera.top); });
  in.part("merge_bottom", [&](JsonReader& reader) { read_merge(reader, camera.bottom); });
  for (const auto& [key, map] :
       {std::pair{"merge_map", &camera.merge_map}, std::pair{"head_tilt_map", &camera.head_tilt_map}}) {
    if (!in.is_null(key)) in.part(key, [&map = map](JsonReader& reader) { *map = read_map(reader); });
  }
  in.part("convergence", [&](JsonReader& reader) { read_convergence(reader, camera); });
  in.part("lens", [&](JsonReader& reader) { read_lens(reader, camera); });
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

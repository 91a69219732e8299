// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/camera_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "ods/base/atomic_file.h"
#include "ods/base/decimal.h"
#include "ods/base/error.h"
#include "ods/base/read_file.h"
#include "ods/base/suggest.h"

namespace ods {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDeepest = 16;                  // levels of brackets; our own files have four
constexpr int64_t kLargestMap = 1 << 24;      // texels
constexpr size_t kLargestFile = 512u << 20u;  // bytes; what such a map may take

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
  return {{"name", projection_name(setting)},      {"longitude", to_json(setting.longitude)},
          {"latitude", to_json(setting.latitude)}, {"fov", decimal(setting.fov)},
          {"aspect", decimal(setting.aspect)},     {"pan", decimal(setting.pan)},
          {"tilt", decimal(setting.tilt)}};
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
          {"ipd", "the whole distance between the eyes"},
          {"merge", "from start to end degrees of elevation; 0 is the horizon"}};
}

// --- reading ---------------------------------------------------------------------------------------------------------

// One object of the file, and where it lies in it: "merge_top".
class Reader {
 public:
  Reader(const Json& json, std::string file, std::string place, std::vector<std::string>& warnings)
      : json_(json), file_(std::move(file)), place_(std::move(place)), warnings_(warnings) {
    if (!json_.is_object()) fail("", "is an object {...}");
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  [[noreturn]] void fail(const std::string& key, const std::string& wanted) const {
    const std::string name = place_ + (place_.empty() || key.empty() ? "" : ".") + key;
    throw Error(ErrorKind::kInput,
                fmt::format("'{}' is no camera: {} {}", file_, name.empty() ? "the file" : name, wanted));
  }

  // The value of a key, nothing when it is missing or null.
  const Json* find(const std::string& key) {
    known_.push_back(key);
    const auto found = json_.find(key);
    return found == json_.end() || found->is_null() ? nullptr : &*found;
  }

  void number(const std::string& key, float& value, float low, float high) {
    if (const Json* json = find(key)) value = number(*json, key, low, high);
  }

  void integer(const std::string& key, int& value, int low, int high) {
    const Json* json = find(key);
    if (!json) return;
    const bool legal = json->is_number_integer() && *json >= low && *json <= high;
    if (!legal) fail(key, fmt::format("is a whole number from {} to {}", low, high));
    value = json->get<int>();
  }

  void flag(const std::string& key, bool& value) {
    const Json* json = find(key);
    if (json && !json->is_boolean()) fail(key, "is true or false");
    if (json) value = json->get<bool>();
  }

  // At most 64 letters: what stands in messages.
  std::string word(const std::string& key) {
    const Json* json = find(key);
    if (json && !json->is_string()) fail(key, "is a word in quotes");
    return json ? json->get<std::string>().substr(0, 64) : "";
  }

  template <int kCount>
  bool vector(const std::string& key, glm::vec<kCount, float>& value, float low, float high) {
    const Json* json = find(key);
    if (!json) return false;
    if (!json->is_array() || json->size() != kCount) fail(key, fmt::format("is a list of {} numbers", kCount));
    for (int i = 0; i < kCount; i++) value[i] = number((*json)[static_cast<size_t>(i)], key, low, high);
    return true;
  }

  float number(const Json& json, const std::string& key, float low, float high) const {
    const double value = json.is_number() ? json.get<double>() : NAN;
    if (!(value >= static_cast<double>(low) && value <= static_cast<double>(high))) {
      fail(key, fmt::format("is a number from {:g} to {:g}", low, high));
    }
    return static_cast<float>(value);
  }

  // Names the keys that nobody asked for. They may be anything: shown short.
  void finish() {
    for (const auto& [key, value] : json_.items()) {
      if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
      if (warnings_.size() == 16) break;
      warnings_.push_back(fmt::format("'{}': nothing is known of '{}{}{}'{}", file_, place_, place_.empty() ? "" : ".",
                                      key.substr(0, 64), did_you_mean(key.substr(0, 64), known_)));
    }
  }

 private:
  const Json& json_;
  std::string file_;
  std::string place_;
  std::vector<std::string>& warnings_;
  std::vector<std::string> known_;
};

void read_merge(Reader& in, PoleMergeSetting& merge) {
  const std::string mode = in.word("mode");
  if (!mode.empty()) {
    const auto known = merge_of(mode);
    if (!known) in.fail("mode", fmt::format("is no merge '{}'", mode));
    merge.mode = *known;
  }
  in.number("start", merge.start, 0.0f, 90.0f);
  in.number("end", merge.end, 0.0f, 90.0f);
  in.number("exponent", merge.exponent, 1e-6f, 100.0f);
  if (merge.start >= merge.end) in.fail("start", "is below its end");
}

void read_projection(Reader& in, ProjectionSetting& setting) {
  const std::string name = in.word("name");
  const NamedProjection* named = find_projection(name.empty() ? "lat-long" : name);
  if (!named) in.fail("name", fmt::format("is no projection '{}'", name));
  setting = named->setting;
  in.vector("longitude", setting.longitude, -36000.0f, 36000.0f);
  in.vector("latitude", setting.latitude, -90.0f, 90.0f);
  in.number("fov", setting.fov, 1.0f, 360.0f);
  in.number("aspect", setting.aspect, 0.0f, 100.0f);
  in.number("pan", setting.pan, -36000.0f, 36000.0f);
  in.number("tilt", setting.tilt, -90.0f, 90.0f);
  const std::string fault = projection_fault(setting);
  if (!fault.empty()) in.fail("", "cannot be: " + fault);
}

void read_convergence(Reader& in, CameraRig& rig) {
  const std::string mode = in.word("mode");
  bool known = mode.empty();
  for (int convergence : kConvergences) {
    if (mode == convergence_name(convergence)) rig.convergence = convergence, known = true;
  }
  if (!known) in.fail("mode", fmt::format("is no convergence '{}'", mode));
  in.number("distance", rig.convergence_distance, 1e-3f, 1e6f);
}

void read_map(Reader& in, CameraRig& rig) {
  int width = 0, height = 0;
  in.integer("width", width, 1, 1 << 15);
  in.integer("height", height, 1, 1 << 15);
  const Json* values = in.find("values");
  const int64_t texels = int64_t{width} * height;
  const bool legal = values && values->is_array() && texels > 0 && texels <= kLargestMap &&
                     values->size() == static_cast<size_t>(texels);
  if (!legal) in.fail("values", "are width times height numbers");
  auto map = std::make_shared<Image>(width, height, 1);
  for (size_t i = 0; i < map->pixels.size(); i++) map->pixels[i] = in.number((*values)[i], "values", 0.0f, 1.0f);
  rig.merge_map = map;
}

void read_picture(Reader& in, CameraFile& file) {
  in.integer("eye_width", file.eye.width, 0, 1 << 20);
  in.integer("eye_height", file.eye.height, 0, 1 << 20);
  const std::string layout = in.word("layout");
  if (!layout.empty()) {
    const auto known = layout_of(layout);
    if (!known) in.fail("layout", fmt::format("is no layout '{}'", layout));
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
  in.fail("eyes", R"(are ["left", "right"], ["left"], ["right"] or ["mono"])");
}

void read_rig(Reader& in, CameraRig& rig) {
  in.vector("position", rig.position, -1e6f, 1e6f);
  in.number("yaw", rig.yaw, -36000.0f, 36000.0f);
  in.number("pitch", rig.pitch, -36000.0f, 36000.0f);
  in.number("roll", rig.roll, -36000.0f, 36000.0f);
  in.number("ipd", rig.ipd, 0.0f, 1e4f);
  in.number("neck", rig.neck, -10.0f, 10.0f);
  in.flag("mirrored", rig.mirrored);
  vec3 axis(0.0f);
  if (in.vector("axis", axis, -1e6f, 1e6f)) {
    if (!(length(axis) > 1e-6f)) in.fail("axis", "is a direction");
    rig.axis = axis;
  }
}

void read_lens(Reader& in, CameraRig& rig) {
  in.number("radius", rig.lens_radius, 0.0f, 10.0f);
  in.number("focus_distance", rig.focus_distance, 1e-3f, 1e6f);
}

Json parse(std::string_view text, const std::string& name) {
  const auto shallow = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kDeepest) throw Error(ErrorKind::kInput, fmt::format("'{}' is no camera: too many brackets", name));
    return true;
  };
  try {
    return Json::parse(text, shallow);
  } catch (const nlohmann::json::parse_error& error) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' is not JSON (byte {} of {})", name, error.byte, text.size()));
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' is no camera: a number in it is too large", name));
  }
}

}  // namespace

std::string write_camera(const CameraFile& file) {
  const CameraRig& rig = file.rig;
  Json eyes = Json::array();
  for (int eye : file.eyes) eyes.push_back(eye_name(eye));
  const Json json = {
      {"omnistereo_camera", kCameraFileVersion},
      {"made_by", "ods " ODS_VERSION},
      {"conventions", conventions()},
      {"picture",
       {{"eye_width", file.eye.width},
        {"eye_height", file.eye.height},
        {"layout", layout_name(file.layout)},
        {"eyes", eyes}}},
      {"projection", to_json(rig.projection)},
      {"position", to_json(rig.position)},
      {"yaw", decimal(rig.yaw)},
      {"pitch", decimal(rig.pitch)},
      {"roll", decimal(rig.roll)},
      {"ipd", decimal(rig.ipd)},
      {"neck", decimal(rig.neck)},
      {"merge_top", to_json(rig.top)},
      {"merge_bottom", to_json(rig.bottom)},
      {"merge_map", rig.merge_map ? to_json(*rig.merge_map) : Json(nullptr)},
      {"convergence", {{"mode", convergence_name(rig.convergence)}, {"distance", decimal(rig.convergence_distance)}}},
      {"axis", rig.axis ? to_json(*rig.axis) : Json(nullptr)},
      {"lens", {{"radius", decimal(rig.lens_radius)}, {"focus_distance", decimal(rig.focus_distance)}}},
      {"mirrored", rig.mirrored}};
  return json.dump(2) + "\n";
}

CameraFile read_camera(std::string_view text, const std::string& name, std::vector<std::string>& warnings) {
  const Json json = parse(text, name);
  Reader in(json, name, "", warnings);
  int version = 0;
  in.integer("omnistereo_camera", version, 1, 1 << 30);
  if (version == 0) in.fail("", R"(lacks its mark, "omnistereo_camera": 1)");
  if (version > kCameraFileVersion) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' was written by a newer ods (camera version {}, this one reads {})",
                                               name, version, kCameraFileVersion));
  }
  in.find("made_by");
  in.find("conventions");
  CameraFile file;
  CameraRig& rig = file.rig;
  const auto part = [&](const std::string& key, const auto& read) {
    const Json* found = in.find(key);
    if (!found) return;
    Reader reader(*found, name, key, warnings);
    read(reader);
    reader.finish();
  };
  read_rig(in, rig);
  part("picture", [&](Reader& reader) { read_picture(reader, file); });
  part("projection", [&](Reader& reader) { read_projection(reader, rig.projection); });
  part("merge_top", [&](Reader& reader) { read_merge(reader, rig.top); });
  part("merge_bottom", [&](Reader& reader) { read_merge(reader, rig.bottom); });
  part("merge_map", [&](Reader& reader) { read_map(reader, rig); });
  part("convergence", [&](Reader& reader) { read_convergence(reader, rig); });
  part("lens", [&](Reader& reader) { read_lens(reader, rig); });
  in.finish();
  if (!rig.merge_map && (rig.top.mode == kMergeMap || rig.bottom.mode == kMergeMap)) {
    in.fail("merge_map", "is missing, and a merge is its");
  }
  return file;
}

CameraFile load_camera(const std::string& path, std::vector<std::string>& warnings) {
  const std::vector<unsigned char> bytes = read_file(path, kLargestFile);
  return read_camera({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path, warnings);
}

void save_camera(const CameraFile& file, const std::string& path) {
  AtomicFile out(path);
  const std::string text = write_camera(file);
  std::fwrite(text.data(), 1, text.size(), out.stream());
  out.commit();
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

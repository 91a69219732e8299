// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/file/layers_info.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "ods/base/bytes.h"
#include "ods/base/decimal.h"
#include "ods/base/quote.h"
#include "ods/files/file_input.h"

namespace ods {

constexpr const char* kMark = "omnistereo";

static Json numbers(const vec3& v) {
  return {decimal(v.x), decimal(v.y), decimal(v.z)};
}

static Json light_metadata(const LayerLightInfo& light, std::optional<size_t> probes) {
  Json json = {{"exposure", decimal(light.exposure)}, {"tone", tone_curve_name(light.tone)}};
  if (!probes) return json;
  const glm::ivec3 count = light.probes.count;
  json["probes"] = {{"origin", numbers(light.probes.origin)},
                    {"step", numbers(light.probes.step)},
                    {"count", {count.x, count.y, count.z}},
                    {"bufferView", *probes}};
  return json;
}

Json layers_metadata(const LayeredScene& scene, std::optional<size_t> probes) {
  Json json = {{"layers", kLayeredVersion},
               {"center", numbers(scene.box.center)},
               {"box", numbers(scene.box.size)},
               {"yaw", decimal(std::remainder(scene.yaw, 360.0f))},
               {"width", scene.width}};
  if (!scene.fallback.empty()) json["fallback"] = scene.fallback;
  if (!scene.name.empty()) json["scene"] = scene.name;
  json["light"] = light_metadata(scene.light, probes);
  for (const float time : scene.film.light_times) json["film"]["lights"].push_back(decimal(time));
  return json;
}

// The JSON of a GLB; empty if the file is not one, or if its JSON is larger than ours can be.
static std::string json_of_glb(const FileInput& file) {
  constexpr size_t kHeaders = 20, kLargest = size_t{4} << 20;
  if (file.size() < kHeaders) return "";
  const std::string head = file.read(0, kHeaders);
  const auto field = [&](size_t at) { return get_number(head, at, 4, std::endian::little); };
  if (!head.starts_with("glTF") || field(4) != 2 || head.substr(16) != "JSON") return "";
  const uint64_t size = field(12);
  return size <= kLargest && size <= file.size() - kHeaders ? file.read(kHeaders, size) : "";
}

// Null if the text is not JSON: the reader of scenes says what is wrong with it.
static Json parse(const std::string& text, const std::string& path) {
  try {
    return parse_json(text, path, "scene");
  } catch (const Error&) {
    return nullptr;
  }
}

static vec3 read_vector(JsonReader& in, const std::string& key, float low, float high) {
  std::vector<float> found;
  if (!in.numbers(key, found, 3, low, high)) in.fail(key, "is missing");
  return {found[0], found[1], found[2]};
}

// A name without a folder: it must not lead out of the file's own.
static std::string read_name(JsonReader& in, const std::string& key) {
  const Json* json = in.find(key);
  if (!json) return "";
  const std::string name = json->is_string() ? json->get<std::string>() : "";
  if (name.empty() || name == "." || name == ".." || name.size() > 255 || !is_quotable(name) ||
      name.find_first_of("/\\") != std::string::npos) {
    in.fail(key, "must be a name without a folder");
  }
  return name;
}

static void read_probes(JsonReader& in, LightProbes& probes) {
  constexpr float kFar = 1e9f, kSmallest = 1e-6f, kLargest = 1e6f, kMost = 64.0f;
  probes.origin = read_vector(in, "origin", -kFar, kFar);
  probes.step = read_vector(in, "step", kSmallest, kLargest);
  probes.count = glm::ivec3(read_vector(in, "count", 1.0f, kMost));
  int view = -1;
  in.integer("bufferView", view, 0, 1 << 20);
  if (view < 0) in.fail("bufferView", "is missing");
}

static void read_light(JsonReader& in, LayerLightInfo& light) {
  constexpr float kMostStops = 100.0f;
  in.number("exposure", light.exposure, -kMostStops, kMostStops);
  const std::string tone = in.word("tone");
  const std::optional<ToneCurve> found = find_in(kToneCurveTable, tone);
  if (!tone.empty() && !found) in.fail("tone", "must be the name of a tone curve");
  light.tone = found.value_or(light.tone);
  in.part("probes", [&](JsonReader& part) { read_probes(part, light.probes); });
}

std::optional<LayersInfo> read_layers_info(const std::string& path) {
  const FileInput file(path);
  const std::string text = json_of_glb(file);
  if (text.find(kMark) == std::string::npos) return std::nullopt;
  const Json json = parse(text, path);
  const Json::json_pointer place(std::string("/asset/extras/") + kMark);
  if (!json.is_object() || !json.contains(place) || !json.at(place).is_object()) return std::nullopt;
  const Json& found = json.at(place);
  if (!found.contains("layers")) return std::nullopt;
  std::vector<std::string> warnings;  // none: a later ods may have added keys
  JsonReader in(found, path, "layered scene", kMark, warnings);
  in.version("layers", kLayeredVersion);
  constexpr float kFar = 1e9f, kSmallest = 0.001f, kLargest = 1000.0f;
  LayersInfo info;
  info.box.center = read_vector(in, "center", -kFar, kFar);
  info.box.size = read_vector(in, "box", kSmallest, kLargest);
  in.number("yaw", info.yaw, -360.0f, 360.0f);
  in.integer("width", info.width, 1, 1 << 20);
  if (info.width == 0) in.fail("width", "is missing");
  info.fallback = read_name(in, "fallback");
  info.scene = read_name(in, "scene");
  in.part("light", [&](JsonReader& part) { read_light(part, info.light); });
  return info;
}

}  // namespace ods

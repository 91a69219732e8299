// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Cameras that many programs can read: USD, glTF, CSV.
// Sources: OpenUSD, UsdGeomCamera and UsdGeomXformOp; Khronos, glTF 2.0 section 3.10 (cameras), 3.11 (animations) and
// appendix C (interpolation of keys).
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "ods/base/base64.h"
#include "ods/base/quote.h"
#include "ods/camera/layout.h"
#include "ods/export/rig_writers.h"

namespace ods {

RigExport rig_to_usd(const SlitRig& rig, const std::string& name) {
  RigExport result;
  const glm::dvec2 half = half_size(rig);
  constexpr double kAperture = 36.0;  // tenths of a unit, like the focal length
  std::string text = "#usda 1.0\n(\n    defaultPrim = \"ods\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n";
  text += fmt::format("    startTimeCode = 1\n    endTimeCode = {}\n", rig.views.size());
  text += "    timeCodesPerSecond = 24\n    framesPerSecond = 24\n)\n";
  text += commented(
      "#",
      head_lines(rig, name,
                 {"USD",
                  "views/####.exr",
                  true,
                  {"Time code n is view n. The scene must not know that time: where it moves, write it as it is at",
                   "one time first. With the camera and the scene in one stage:",
                   fmt::format("  usdrecord --camera /ods --imageWidth {} --frames 1:{} stage.usda views/####.exr",
                               rig.view.width, rig.views.size()),
                   "Noise: give every view a seed of its own, the same each time."}},
                 result.warnings));
  text += "def Camera \"ods\"\n{\n    token projection = \"perspective\"\n    float2 clippingRange = (0.01, 10000)\n";
  text += fmt::format(
      "    float horizontalAperture = {:.9g}\n    float verticalAperture = {:.9g}\n    float focalLength = {:.9g}\n",
      kAperture, kAperture * half.y / half.x, 0.5 * kAperture / half.x);
  text += "    double shutter:open = 0\n    double shutter:close = 0\n";
  text += "    matrix4d xformOp:transform.timeSamples = {\n";
  for (size_t i = 0; i < rig.views.size(); i++) {  // USD's vectors are rows
    const ViewPose pose = pose_of(rig.views[i]);
    text += fmt::format("        {}: ( ({}, 0), ({}, 0), ({}, 0), ({}, 1) ),\n", i + 1, list(pose.right), list(pose.up),
                        list(pose.back), list(pose.place));
  }
  text += "    }\n    uniform token[] xformOpOrder = [\"xformOp:transform\"]\n}\n";
  result.scripts.push_back({".usda", text});
  return result;
}

// --- glTF -----------------------------------------------------------------------------------------------------------

namespace {

constexpr double kFramesPerSecond = 24.0;

// The numbers of the animation, in sequence.
struct Keys {
  std::vector<float> times, places, turns;
};

// A view's key is half a frame before its time, so that rounding of times cannot show the previous view.
Keys keys_of(const SlitRig& rig) {
  Keys keys;
  for (size_t i = 0; i < rig.views.size(); i++) {
    const ViewPose pose = pose_of(rig.views[i]);
    const glm::dquat turn = normalize(glm::quat_cast(glm::dmat3(pose.right, pose.up, pose.back)));
    keys.times.push_back(static_cast<float>((static_cast<double>(i) + 0.5) / kFramesPerSecond));
    for (int k = 0; k < 3; k++) keys.places.push_back(static_cast<float>(pose.place[k]));
    for (const double part : {turn.x, turn.y, turn.z, turn.w}) keys.turns.push_back(static_cast<float>(part));
  }
  return keys;
}

// Each array gets its own buffer view and accessor.
void add_buffer(const Keys& keys, nlohmann::ordered_json& json) {
  std::vector<unsigned char> bytes;
  const auto add = [&](const std::vector<float>& values, const char* type, size_t parts) {
    const size_t start = bytes.size(), size = values.size() * sizeof(float);
    bytes.resize(start + size);
    std::memcpy(bytes.data() + start, values.data(), size);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", start}, {"byteLength", size}});
    json["accessors"].push_back({{"bufferView", json["accessors"].size()},
                                 {"componentType", 5126},
                                 {"count", values.size() / parts},
                                 {"type", type}});
  };
  add(keys.times, "SCALAR", 1);
  json["accessors"][0]["min"] = {keys.times.front()}, json["accessors"][0]["max"] = {keys.times.back()};
  add(keys.places, "VEC3", 3);
  add(keys.turns, "VEC4", 4);
  const std::string_view letters(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  json["buffers"].push_back(
      {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + encode_base64(letters)}});
}

}  // namespace

RigExport rig_to_gltf(const SlitRig& rig, const std::string& name) {
  RigExport result;
  const glm::dvec2 half = half_size(rig);
  nlohmann::ordered_json json;
  json["asset"] = {{"version", "2.0"}, {"generator", "ods " ODS_VERSION}};
  json["asset"]["extras"]["comments"] = head_lines(
      rig, name,
      {"glTF",
       "views/####.exr",
       true,
       {"At n/24 s the camera is that of view n: frame n, at 24 frames a second. The scene stands still meanwhile.",
        "Noise: give every view a seed of its own, the same each time."}},
      result.warnings);
  json["scene"] = 0;
  json["scenes"] = {{{"nodes", {0}}}};
  const Keys keys = keys_of(rig);
  nlohmann::ordered_json node = {{"name", "ods"}, {"camera", 0}};
  node["translation"] = std::vector<float>(keys.places.begin(), keys.places.begin() + 3);
  node["rotation"] = std::vector<float>(keys.turns.begin(), keys.turns.begin() + 4);
  json["nodes"].push_back(node);
  json["cameras"].push_back(
      {{"name", "ods"},
       {"type", "perspective"},
       {"perspective",
        {{"yfov", 2.0 * std::atan(half.y)}, {"aspectRatio", half.x / half.y}, {"znear", 0.01}, {"zfar", 10000.0}}}});
  add_buffer(keys, json);
  nlohmann::ordered_json animation = {{"name", "ods views"}};
  for (const auto& [path, output] : {std::pair("translation", 1), std::pair("rotation", 2)}) {
    animation["channels"].push_back({{"sampler", output - 1}, {"target", {{"node", 0}, {"path", path}}}});
    animation["samplers"].push_back({{"input", 0}, {"output", output}, {"interpolation", "STEP"}});
  }
  json["animations"].push_back(animation);
  result.scripts.push_back({".gltf", json_document(json, 1) + "\n"});
  return result;
}

// --- CSV ------------------------------------------------------------------------------------------------------------

// The file has no comment, because programs that read CSV would read it as a line of data.
RigExport rig_to_csv(const SlitRig& rig, const std::string&) {
  const glm::dvec2 half = half_size(rig);
  std::string text = "number,eye,slit,pitch,x,y,z";
  for (const char* axis : {"right", "up", "back"}) text += fmt::format(",{0}_x,{0}_y,{0}_z", axis);
  text += ",hfov,vfov,width,height\n";
  for (size_t i = 0; i < rig.views.size(); i++) {
    const size_t pitches = static_cast<size_t>(rig.options.pitches), slits = static_cast<size_t>(rig.options.slits);
    const size_t column = i / pitches;
    const ViewPose pose = pose_of(rig.views[i]);
    text += fmt::format("{},{},{},{}", i + 1, eye_name(rig.eyes[column / slits]), column % slits, i % pitches);
    for (const glm::dvec3& v : {pose.place, pose.right, pose.up, pose.back}) {
      text += fmt::format(",{:.8g},{:.8g},{:.8g}", v.x + 0.0, v.y + 0.0, v.z + 0.0);
    }
    text +=
        fmt::format(",{:.9g},{:.9g},{},{}\n", degrees_of(half.x), degrees_of(half.y), rig.view.width, rig.view.height);
  }
  return {{{".csv", text}}, {}};
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/slit_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "ods/base/decimal.h"
#include "ods/base/error.h"
#include "ods/base/json_reader.h"
#include "ods/base/quote.h"
#include "ods/files/atomic_file.h"
#include "ods/files/read_file.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/sidecar.h"

namespace ods {

namespace {

constexpr size_t kLargestFile = 512u << 20u;  // bytes
constexpr float kFarthest = 1e6f;             // metres

// --- writing --------------------------------------------------------------------------------------------------------

Json matrix_of(const SlitRig& rig, size_t view) {
  Json rows = Json::array();
  for (const float value : view_matrix(rig, view)) rows.push_back(decimal(value));
  return rows;
}

Json conventions() {
  return {{"lengths", "metres"},
          {"matrix",
           "row-major, view to world; the view looks along its -Z, +X is right, +Y up; the world is "
           "right-handed, +Y up"},
          {"fov", "degrees, horizontal and vertical"},
          {"order", "eye by eye, slit by slit from the left, pitch by pitch from the top"},
          {"time", "all views are of one moment: same frame, same seeds"}};
}

float vertical_fov(const StereoCamera& view) {
  const double half = std::tan(glm::radians(0.5 * static_cast<double>(view.projection.fov)));
  return static_cast<float>(glm::degrees(2.0 * std::atan(half / static_cast<double>(view.projection.aspect))));
}

}  // namespace

std::vector<float> view_matrix(const SlitRig& rig, size_t view) {
  if (!rig.matrices.empty()) return rig.matrices[view];
  const Camera camera = make_camera(rig.views[view]);
  std::vector<float> rows;
  for (int row = 0; row < 3; row++) {
    for (const vec3 column : {camera.right, camera.up, camera.back, camera.center}) rows.push_back(column[row]);
  }
  rows.insert(rows.end(), {0.0f, 0.0f, 0.0f, 1.0f});
  return rows;
}

std::string write_slit_rig(const SlitRig& rig) {
  const SlitOptions& options = rig.options;
  const Sidecar camera{rig.camera, rig.eye, rig.layout, rig.eyes};
  Json json = {{"omnistereo_slits", kSlitFileVersion},
               {"made_by", "ods " ODS_VERSION},
               {"conventions", conventions()},
               {"slits", options.slits},
               {"pitches", options.pitches},
               {"caps", options.caps},
               {"blend", decimal(options.blend)},
               {"padding", options.padding},
               {"scale", decimal(options.scale)},
               {"depth", view_depth_name(options.depth)},
               {"view",
                {{"width", rig.view.width},
                 {"height", rig.view.height},
                 {"fov", {decimal(rig.views[0].projection.fov), decimal(vertical_fov(rig.views[0]))}}}},
               {"camera", Json::parse(write_sidecar(camera))}};
  std::string text = json_document(json, 2);
  text.resize(text.size() - 2);  // the closing bracket; views follow, one per line
  text += ",\n  \"views\": [";
  for (size_t i = 0; i < rig.views.size(); i++) {
    const size_t pitch = i % static_cast<size_t>(options.pitches), column = i / static_cast<size_t>(options.pitches);
    const size_t slits = static_cast<size_t>(options.slits);
    const Json view = {{"number", i + 1},
                       {"eye", eye_name(rig.eyes[column / slits])},
                       {"slit", column % slits},
                       {"pitch", pitch},
                       {"matrix", matrix_of(rig, i)}};
    text += fmt::format("{}\n    {}", i == 0 ? "" : ",", json_document(view));
  }
  return text + "\n  ]\n}\n";
}

// --- reading --------------------------------------------------------------------------------------------------------

namespace {

ViewDepth depth_of(JsonReader& in) {
  if (!in.find("depth")) return ViewDepth::kNone;
  const std::string word = in.word("depth");
  if (const std::optional<ViewDepth> depth = find_in(kViewDepthTable, word)) return *depth;
  in.fail("depth", "must be none, ray or plane");
}

// Orientation and position, if the matrix contains nothing else.
bool set_pose(const std::vector<float>& m, StereoCamera& view) {
  const auto column = [&](size_t i) { return glm::dvec3(m[i], m[4 + i], m[8 + i]); };
  const glm::dvec3 right = column(0), up = column(1), back = column(2);
  constexpr double kNear = 1e-4;
  for (const glm::dvec3& axis : {right, up, back}) {
    if (std::abs(glm::length(axis) - 1.0) > kNear) return false;
  }
  if (glm::length(glm::cross(right, up) - back) > kNear) return false;
  if (m[12] != 0.0f || m[13] != 0.0f || m[14] != 0.0f || m[15] != 1.0f) return false;
  const ViewAngles angles = view_angles(-back, up);
  view.yaw = angles.yaw, view.pitch = angles.pitch, view.roll = angles.roll;
  view.position = vec3(column(3));
  return true;
}

void read_view(const Json& json, const std::string& name, size_t index, std::vector<std::string>& warnings,
               SlitRig& rig) {
  JsonReader in(json, name, "rig", fmt::format("views[{}]", index), warnings);
  int number = 0;
  in.integer("number", number, 1, 1 << 30);
  if (static_cast<size_t>(number) != index + 1) in.fail("number", fmt::format("must be {} here", index + 1));
  for (const char* known : {"eye", "slit", "pitch"}) in.find(known);
  std::vector<float> matrix;
  if (!in.numbers("matrix", matrix, 16, -kFarthest, kFarthest) || !set_pose(matrix, rig.views[index])) {
    in.fail("matrix", "must be a rigid transform: 16 numbers in rows, without scale or mirroring");
  }
  rig.matrices.push_back(std::move(matrix));
  in.finish();
}

void read_options(JsonReader& in, SlitOptions& options) {
  options.slits = 0;
  in.integer("slits", options.slits, 1, kMaxSide);
  in.integer("pitches", options.pitches, 1, 64);
  in.flag("caps", options.caps);
  in.number("blend", options.blend, 0.0f, 1.0f);
  in.integer("padding", options.padding, 0, 4096);
  in.number("scale", options.scale, 0.01f, 16.0f);
  options.depth = depth_of(in);
}

}  // namespace

SlitRig read_slit_rig(std::string_view text, const std::string& name, std::vector<std::string>& warnings) {
  const Json json = parse_json(text, name, "rig");
  JsonReader in(json, name, "rig", "", warnings);
  in.version("omnistereo_slits", kSlitFileVersion);
  for (const char* known : {"made_by", "conventions"}) in.find(known);
  SlitOptions options;
  read_options(in, options);
  const Json* camera = in.find("camera");
  if (!camera || !camera->is_object()) in.fail("camera", "must be an object {...}: the picture's camera");
  const Sidecar file = read_sidecar(json_document(*camera), name, warnings);
  const std::string fault = slit_fault(file.camera, file.eye, options);
  if (!fault.empty()) in.fail("", "describes an impossible rig: " + fault);
  SlitRig rig = make_slit_rig(file.camera, file.eye, file.eyes, options);
  rig.layout = file.layout;
  in.part("view", [&](JsonReader& view) {
    view.integer("width", rig.view.width, 1, kMaxSide);
    view.integer("height", rig.view.height, 1, kMaxSide);
    vec2 fov(0.0f);
    if (!view.vector("fov", fov, 0.001f, 170.0f)) view.fail("fov", "must be two numbers");
    for (StereoCamera& each : rig.views) {
      each.projection.fov = fov.x;
      each.projection.aspect = std::tan(0.5f * glm::radians(fov.x)) / std::tan(0.5f * glm::radians(fov.y));
    }
  });
  const Json* views = in.find("views");
  if (!views || !views->is_array() || views->size() != rig.views.size()) {
    in.fail("views", fmt::format("must be a list of {}: {} eyes, {} slits, {} pitches", rig.views.size(),
                                 rig.eyes.size(), options.slits, options.pitches));
  }
  for (size_t i = 0; i < rig.views.size(); i++) read_view((*views)[i], name, i, warnings, rig);
  in.finish();
  return rig;
}

SlitRig load_slit_rig(const std::string& path, std::vector<std::string>& warnings) {
  const std::vector<unsigned char> bytes = read_file(path, kLargestFile);
  return read_slit_rig({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path, warnings);
}

void save_slit_rig(const SlitRig& rig, const std::string& path) {
  write_file(path, write_slit_rig(rig));
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/export/rig_export.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "ods/base/text.h"
#include "ods/export/rig_writers.h"
#include "ods/export/writers.h"

namespace ods {

RigExport export_rig(const SlitRig& rig, RigTarget target, const std::string& file_name) {
  const std::string name = terminal_text(one_line(file_name));
  switch (target) {
    case RigTarget::kBlender:
      return rig_to_blender(rig, name);
    case RigTarget::kPovray:
      return rig_to_povray(rig, name);
    case RigTarget::kThree:
      return rig_to_three(rig, name);
    case RigTarget::kUsd:
      return rig_to_usd(rig, name);
    case RigTarget::kGltf:
      return rig_to_gltf(rig, name);
    case RigTarget::kUnity:
      return rig_to_unity(rig, name);
    case RigTarget::kUnreal:
      return rig_to_unreal(rig, name);
    case RigTarget::kCsv:
      return rig_to_csv(rig, name);
  }
  return {};
}

// --- shared by the writers -------------------------------------------------------------------------------------------

ViewPose pose_of(const StereoCamera& view) {
  const std::array<glm::dvec3, 4> columns = placement(view);
  return {columns[0], columns[1], columns[2], columns[3]};
}

ViewPose turned(const ViewPose& pose, Turn turn) {
  return {turn(pose.right), turn(pose.up), turn(pose.back), turn(pose.place)};
}

glm::dvec3 turn_z_up(glm::dvec3 v) {
  return {v.x, -v.z, v.y};
}

glm::dvec3 turn_left_handed(glm::dvec3 v) {
  return {v.x, v.y, -v.z};
}

glm::dvec2 half_size(const SlitRig& rig) {
  const ProjectionSetting& setting = rig.views[0].projection;
  const double across = std::tan(glm::radians(0.5 * static_cast<double>(setting.fov)));
  return {across, across * rig.view.height / rig.view.width};
}

double degrees_of(double half) {
  return glm::degrees(2.0 * std::atan(half));
}

std::string list(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += fmt::format("{}{:.8g}", text.empty() ? "" : ", ", number + 0.0);
  return text;
}

std::string list(glm::dvec3 v) {
  return list({v.x, v.y, v.z});
}

std::string matrix_rows(const ViewPose& pose) {
  std::string text;
  for (int row = 0; row < 3; row++) {
    text += row == 0 ? "" : ", ";
    text += list({pose.right[row], pose.up[row], pose.back[row], pose.place[row]});
  }
  return text;
}

std::string mark_literal(const SlitRig& rig) {
  std::string literal = "\"";
  for (const char c : mark_file_text(rig_mark(rig))) {
    literal += c == '\n' ? std::string("\\n") : c == '"' ? std::string("\\\"") : std::string(1, c);
  }
  return literal + "\"";
}

std::vector<std::string> head_lines(const SlitRig& rig, const std::string& name, const ScriptHead& head,
                                    std::vector<std::string>& warnings) {
  if (rig.options.depth != ViewDepth::kNone && !head.has_depth) {
    warnings.push_back(
        fmt::format("this export writes no depth '{}', which the rig requires: the error is ten times as large",
                    view_depth_name(rig.options.depth)));
  }
  std::vector<std::string> lines{
      fmt::format("{}: {} views of {}x{} pixels for {}.json.", head.title, rig.views.size(), rig.view.width,
                  rig.view.height, name),
      "All views show the same moment: nothing in the scene may move from the first view to the last."};
  lines.insert(lines.end(), head.own_lines.begin(), head.own_lines.end());
  lines.emplace_back(
      "Effects on finished pictures (bloom, glare, vignette, automatic exposure) belong on the stitched");
  lines.push_back(fmt::format(
      "picture. Effects that spread light by at most {} pixels are allowed: a border of that width is cropped",
      rig.options.padding));
  lines.emplace_back("(ods rig --padding).");
  lines.push_back(fmt::format("Then: ods stitch {}.json '{}' -o picture.exr", name, head.views));
  for (const std::string& warning : warnings) lines.push_back("Unsupported: " + warning + ".");
  return lines;
}

std::string commented(const std::string& mark, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += mark + " " + line + "\n";
  return text;
}

}  // namespace ods

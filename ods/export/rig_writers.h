// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Code shared by the writers of ods/export/rig_export.h.
#pragma once
#include <glm/glm.hpp>

#include "ods/export/rig_export.h"
#include "ods/stitch/rig_mark.h"

namespace ods {

// A view's axes and position, in some program's world.
struct ViewPose {
  glm::dvec3 right, up, back, place;
};
ViewPose pose_of(const StereoCamera& view);  // in our world: right-handed, metres, +Y up

// Converts a vector to the world of another program.
using Turn = glm::dvec3 (*)(glm::dvec3);
ViewPose turned(const ViewPose& pose, Turn turn);
glm::dvec3 turn_z_up(glm::dvec3 v);         // Blender: right-handed, +Z up
glm::dvec3 turn_left_handed(glm::dvec3 v);  // POV-Ray, Unity: z points the other way

// Tangents of half the field of view of all views, horizontal and vertical.
glm::dvec2 half_size(const SlitRig& rig);
double degrees_of(double half);  // the whole angle, degrees

// "0.5, -1, 0": the shortest form with at most eight digits, without -0.
std::string list(std::initializer_list<double> numbers);
std::string list(glm::dvec3 v);
std::string matrix_rows(const ViewPose& pose);  // 12 numbers: three rows of right, up, back, position

// The text of the folder's mark (ods/stitch/rig_mark.h) as a string literal for Python, JavaScript and C#.
std::string mark_literal(const SlitRig& rig);

// The head of every script: its purpose, the things that must not move, and the next step. `views` are the names of the
// files that it writes, with a placeholder for the number.
struct ScriptHead {
  std::string title;
  std::string views = "views/####.png";
  bool has_depth = false;              // the script writes depth in the form that the rig needs
  std::vector<std::string> own_lines;  // lines of this target alone
};
std::vector<std::string> head_lines(const SlitRig& rig, const std::string& name, const ScriptHead& head,
                                    std::vector<std::string>& warnings);
std::string commented(const std::string& mark, const std::vector<std::string>& lines);

RigExport rig_to_blender(const SlitRig& rig, const std::string& name);
RigExport rig_to_povray(const SlitRig& rig, const std::string& name);
RigExport rig_to_three(const SlitRig& rig, const std::string& name);
RigExport rig_to_usd(const SlitRig& rig, const std::string& name);
RigExport rig_to_gltf(const SlitRig& rig, const std::string& name);
RigExport rig_to_unity(const SlitRig& rig, const std::string& name);
RigExport rig_to_unreal(const SlitRig& rig, const std::string& name);
RigExport rig_to_csv(const SlitRig& rig, const std::string& name);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Exports a rig of slits to another renderer: scripts that render its views under the file names that ods stitch
// expects, or cameras that a program can read. docs/slits.md explains each of them.
//
// View n of the rig is frame n of a script, and the scene does not move meanwhile. If a world has other axes than ours,
// the views are rotated in the way that the program's glTF importer rotates a scene.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/names.h"
#include "ods/stitch/slit_rig.h"

namespace ods {

enum class RigTarget {
  kBlender,  // Python for 2.83 to 5.x: renders all views
  kPovray,   // POV-Ray 3.7: an include file, and options
  kThree,    // a module for a three.js page
  kUsd,      // a moving camera: time code n is view n
  kGltf,     // a moving camera: view n is shown at n/24 s
  kUnity,    // C# for the editor
  kUnreal,   // Python for the editor
  kCsv,      // for spreadsheets and unknown programs: one line per view
};

struct RigTargetRow {
  RigTarget member;
  std::string_view name;
  bool tested = true;  // in the program itself
};

inline constexpr RigTargetRow kRigTargetTable[] = {
    {RigTarget::kBlender, "blender"},      {RigTarget::kPovray, "povray"}, {RigTarget::kThree, "three"},
    {RigTarget::kUsd, "usd", false},       {RigTarget::kGltf, "gltf"},     {RigTarget::kUnity, "unity", false},
    {RigTarget::kUnreal, "unreal", false}, {RigTarget::kCsv, "csv"},
};
static_assert(has_every_member(kRigTargetTable));
inline constexpr auto kRigTargets = members_of(kRigTargetTable);
constexpr std::string_view rig_target_name(RigTarget target) {
  return name_in(kRigTargetTable, target);
}

struct RigScript {
  std::string ending;  // appended to the rig's name: ".blender.py"
  std::string text;
};

struct RigExport {
  std::vector<RigScript> scripts;
  // Limitations of the target for this rig, one line each; the text includes them too.
  std::vector<std::string> warnings;
};

// Exports a rig. name: of the rig's file, without folder and without .json. The scripts refer to the rig and to each
// other by it.
RigExport export_rig(const SlitRig& rig, RigTarget target, const std::string& name);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Exports a camera to another renderer: describes it in that system's terms. Unsupported properties become comments in
// the text and entries of `warnings`.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/names.h"
#include "ods/picture/metadata/sidecar.h"

namespace ods {

enum class CameraTarget {
  kPovray,      // POV-Ray 3.8: user_defined
  kPovrayFork,  // Clodo76/povray: spherical with ods keywords
  kBlender,     // Python for 3.4 to 5.x
  kOsl,         // a camera shader for Cycles 5
  kArnold,      // an .ass node
  kMtoa,        // setAttr lines for Maya
  kGlsl,
  kHlsl,
  kPython,
  kJson,     // the sidecar
  kNumbers,  // for users and spreadsheets
};

struct CameraTargetRow {
  CameraTarget member;
  std::string_view name;
  bool tested = true;  // in the program itself
};

inline constexpr CameraTargetRow kCameraTargetTable[] = {
    {CameraTarget::kPovray, "povray"},
    {CameraTarget::kPovrayFork, "povray-fork", false},
    {CameraTarget::kBlender, "blender"},
    {CameraTarget::kOsl, "osl", false},
    {CameraTarget::kArnold, "arnold", false},
    {CameraTarget::kMtoa, "mtoa", false},
    {CameraTarget::kGlsl, "glsl"},
    {CameraTarget::kHlsl, "hlsl"},
    {CameraTarget::kPython, "python"},
    {CameraTarget::kJson, "json"},
    {CameraTarget::kNumbers, "numbers"},
};
static_assert(has_every_member(kCameraTargetTable));
inline constexpr auto kCameraTargets = members_of(kCameraTargetTable);
constexpr std::string_view camera_target_name(CameraTarget target) {
  return name_in(kCameraTargetTable, target);
}

struct CameraExport {
  std::string text;
  std::vector<std::string> warnings;  // properties that the target lacks, one line each
  std::string refusal;                // the reason why there is no text; empty if there is
};

CameraExport export_camera(const Sidecar& file, CameraTarget target);

}  // namespace ods

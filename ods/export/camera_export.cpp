// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/export/camera_export.h"

#include <fmt/format.h>

#include <cassert>

#include "ods/export/writers.h"

namespace ods {

std::string_view camera_target_name(CameraTarget target) {
  switch (target) {
    case CameraTarget::kPovray:
      return "povray";
    case CameraTarget::kPovrayFork:
      return "povray-fork";
    case CameraTarget::kBlender:
      return "blender";
    case CameraTarget::kOsl:
      return "osl";
    case CameraTarget::kOspray:
      return "ospray";
    case CameraTarget::kArnold:
      return "arnold";
    case CameraTarget::kMtoa:
      return "mtoa";
    case CameraTarget::kUnity:
      return "unity";
    case CameraTarget::kUnreal:
      return "unreal";
    case CameraTarget::kGlsl:
      return "glsl";
    case CameraTarget::kHlsl:
      return "hlsl";
    case CameraTarget::kPython:
      return "python";
    case CameraTarget::kJson:
      return "json";
    case CameraTarget::kNumbers:
      return "numbers";
  }
  return {};
}

CameraExport export_camera(const CameraFile& file, CameraTarget target) {
  switch (target) {
    case CameraTarget::kPovray:
      return to_povray(file);
    case CameraTarget::kPovrayFork:
      return to_povray_fork(file);
    case CameraTarget::kBlender:
      return to_blender(file);
    case CameraTarget::kOsl:
      return to_osl(file);
    case CameraTarget::kOspray:
      return to_ospray(file);
    case CameraTarget::kArnold:
      return to_arnold(file);
    case CameraTarget::kMtoa:
      return to_mtoa(file);
    case CameraTarget::kUnity:
      return to_unity(file);
    case CameraTarget::kUnreal:
      return to_unreal(file);
    case CameraTarget::kGlsl:
      return to_glsl(file);
    case CameraTarget::kHlsl:
      return to_hlsl(file);
    case CameraTarget::kPython:
      return to_python(file);
    case CameraTarget::kJson:
      return {write_camera(file), {}, ""};
    case CameraTarget::kNumbers:
      return to_numbers(file);
  }
  return {};
}

// --- what the writers share ------------------------------------------------------------------------------------------

bool is_plain_cosine(const PoleMergeSetting& merge) {
  return merge.mode == kMergeCosine && merge.end == 90.0f && merge.exponent == 1.0f;
}

std::string one_merge(const PoleMergeSetting& merge) {
  if (merge.mode == kMergeNone) return "none";
  return fmt::format("{} from {} to {} degrees{}", merge_name(merge.mode), merge.start, merge.end,
                     merge.exponent == 1.0f ? "" : fmt::format(" to the power {}", merge.exponent));
}

std::string merge_text(const CameraRig& rig) {
  if (same_merge(rig.top, rig.bottom)) return one_merge(rig.top);
  return fmt::format("{} above, {} below", one_merge(rig.top), one_merge(rig.bottom));
}

std::string camera_title(const CameraFile& file) {
  const std::string projection(projection_name(file.rig.projection));
  if (file.eyes.size() == 2) return fmt::format("both eyes, {}, {}", layout_name(file.layout), projection);
  return fmt::format("{}, {}",
                     file.eyes[0] == kMono   ? "mono"
                     : file.eyes[0] == kLeft ? "left eye"
                                             : "right eye",
                     projection);
}

Extent picture_size(const CameraFile& file) {
  const int count = static_cast<int>(file.eyes.size());
  return packed_size(file.layout, squeezed_eye(file.layout, file.eye, count), count);
}

std::string yaw_pitch_roll(const CameraRig& rig) {
  return fmt::format("yaw {}, pitch {}, roll {}", rig.yaw, rig.pitch, rig.roll);
}

std::vector<std::string> lacking(const CameraFile& file, const Abilities& can) {
  const CameraRig& rig = file.rig;
  std::vector<std::string> list;
  const auto lacks = [&](bool wanted, const std::string& what) {
    if (wanted) list.push_back(fmt::format("{} has no {}", can.system, what));
  };
  const bool level = rig.pitch == 0.0f && rig.roll == 0.0f;
  const bool upright = !rig.axis || (level && *rig.axis == vec3(0.0f, 1.0f, 0.0f));
  lacks(!can.tilt && !level, fmt::format("pitch and roll ({})", yaw_pitch_roll(rig)));
  lacks(!upright, "axis of the eyes but the camera's up");
  lacks(!can.neck && rig.neck != 0.0f, fmt::format("eye-to-neck distance ({} m)", rig.neck));
  lacks(!can.toe_in && rig.convergence == kToeIn, fmt::format("toe-in ({} m)", rig.convergence_distance));
  lacks(rig.convergence == kShift, fmt::format("shift to a convergence distance ({} m)", rig.convergence_distance));
  lacks(rig.lens_radius > 0.0f, "blur like our lens, which stands about the displaced eye");
  lacks(rig.mirrored, "mirrored world");
  const bool partial = rig.projection.kind == kLatLong && !is_full_lat_long(rig.projection);
  lacks(!can.partial && partial, "part of a lat-long");
  return list;
}

std::string comment_block(const std::string& mark, const std::string& title, const std::vector<std::string>& warnings) {
  std::string text = fmt::format("{} {}\n", mark, title);
  for (const std::string& warning : warnings) text += fmt::format("{} Not as asked: {}.\n", mark, warning);
  return text;
}

std::array<glm::dvec3, 4> placement(const CameraRig& rig) {
  const Camera camera = make_camera(rig);
  std::array<glm::dvec3, 4> columns{glm::dvec3(camera.right), glm::dvec3(camera.up),
                                    glm::dvec3(rig.mirrored ? -camera.back : camera.back), glm::dvec3(camera.center)};
  for (glm::dvec3& column : columns) {
    for (int i = 0; i < 3; i++) column[i] = std::abs(column[i]) < 1e-7 ? 0.0 : column[i];
  }
  return columns;
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/export/camera_export.h"

#include <fmt/format.h>

#include <cassert>

#include "ods/export/writers.h"

namespace ods {

CameraExport export_camera(const Sidecar& file, CameraTarget target) {
  switch (target) {
    case CameraTarget::kPovray:
      return to_povray(file);
    case CameraTarget::kPovrayFork:
      return to_povray_fork(file);
    case CameraTarget::kBlender:
      return to_blender(file);
    case CameraTarget::kOsl:
      return to_osl(file);
    case CameraTarget::kArnold:
      return to_arnold(file);
    case CameraTarget::kMtoa:
      return to_mtoa(file);
    case CameraTarget::kGlsl:
      return to_glsl(file);
    case CameraTarget::kHlsl:
      return to_hlsl(file);
    case CameraTarget::kPython:
      return to_python(file);
    case CameraTarget::kJson:
      return {write_sidecar(file), {}, ""};
    case CameraTarget::kNumbers:
      return to_numbers(file);
  }
  return {};
}

// --- shared by the writers -------------------------------------------------------------------------------------------

bool is_plain_cosine(const PoleMergeSetting& merge) {
  return merge.mode == kMergeCosine && merge.end == 90.0f && merge.exponent == 1.0f;
}

std::string one_merge(const PoleMergeSetting& merge) {
  if (merge.mode == kMergeNone) return "none";
  return fmt::format("{} from {} to {} degrees{}", merge_name(merge.mode), merge.start, merge.end,
                     merge.exponent == 1.0f ? "" : fmt::format(" to the power {}", merge.exponent));
}

std::string merge_text(const StereoCamera& stereo) {
  if (same_merge(stereo.top, stereo.bottom)) return one_merge(stereo.top);
  return fmt::format("{} above, {} below", one_merge(stereo.top), one_merge(stereo.bottom));
}

std::string camera_title(const Sidecar& file) {
  const std::string projection(projection_name(file.camera.projection));
  if (file.eyes.size() == 2) return fmt::format("both eyes, {}, {}", layout_name(file.layout), projection);
  return fmt::format("{}, {}",
                     file.eyes[0] == kMono   ? "mono"
                     : file.eyes[0] == kLeft ? "left eye"
                                             : "right eye",
                     projection);
}

Extent picture_size(const Sidecar& file) {
  const int count = static_cast<int>(file.eyes.size());
  return packed_size(file.layout, squeezed_eye(file.layout, file.eye, count), count);
}

std::string yaw_pitch_roll(const StereoCamera& stereo) {
  return fmt::format("yaw {}, pitch {}, roll {}", stereo.yaw, stereo.pitch, stereo.roll);
}

std::vector<std::string> lacking(const Sidecar& file, const Abilities& can) {
  const StereoCamera& stereo = file.camera;
  std::vector<std::string> list;
  const auto lacks = [&](bool wanted, const std::string& what) {
    if (wanted) list.push_back(fmt::format("{} has no {}", can.system, what));
  };
  const bool level = stereo.pitch == 0.0f && stereo.roll == 0.0f;
  const bool upright = !stereo.axis || (level && *stereo.axis == vec3(0.0f, 1.0f, 0.0f));
  lacks(!can.tilt && !level, fmt::format("pitch and roll ({})", yaw_pitch_roll(stereo)));
  lacks(!upright, "axis of the eyes but the camera's up");
  lacks(!can.neck && stereo.neck != 0.0f, fmt::format("eye-to-neck distance ({} m)", stereo.neck));
  lacks(!can.toe_in && stereo.convergence == kToeIn, fmt::format("toe-in ({} m)", stereo.convergence_distance));
  lacks(stereo.convergence == kShift,
        fmt::format("shift to a convergence distance ({} m)", stereo.convergence_distance));
  lacks(stereo.lens_radius > 0.0f, "blur like our lens, which stands about the displaced eye");
  lacks(stereo.mirrored, "mirrored world");
  lacks(stereo.head_tilt_map != nullptr, "head-tilt map");
  const bool partial = stereo.projection.kind == kLatLong && !is_full_lat_long(stereo.projection);
  lacks(!can.partial && partial, "part of a lat-long");
  return list;
}

std::string comment_block(const std::string& mark, const std::string& title, const std::vector<std::string>& warnings) {
  std::string text = fmt::format("{} {}\n", mark, title);
  for (const std::string& warning : warnings) text += fmt::format("{} Unsupported: {}.\n", mark, warning);
  return text;
}

std::array<glm::dvec3, 4> placement(const StereoCamera& stereo) {
  const Camera camera = make_camera(stereo);
  std::array<glm::dvec3, 4> columns{glm::dvec3(camera.right), glm::dvec3(camera.up),
                                    glm::dvec3(stereo.mirrored ? -camera.back : camera.back),
                                    glm::dvec3(camera.center)};
  for (glm::dvec3& column : columns) {
    for (int i = 0; i < 3; i++) column[i] = std::abs(column[i]) < 1e-7 ? 0.0 : column[i];
  }
  return columns;
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/cycles_camera.h"

namespace ods {

std::string cycles_lacks(const StereoCamera& camera) {
  const auto is_cosine = [](const PoleMergeSetting& merge) {
    return merge.mode == kMergeNone || (merge.mode == kMergeCosine && merge.exponent == 1.0f && merge.start >= 0.0f);
  };
  if (!is_cosine(camera.top) || !is_cosine(camera.bottom)) return "only merges by a plain cosine (`merge` cosine)";
  if (!same_merge(camera.top, camera.bottom)) return "the same `merge` at both poles";
  if (camera.neck != 0.0f) return "eyes on the neck's axis (no `eye-to-neck`)";
  if (camera.axis) return "a viewing circle square to the camera's up (no `axis`)";
  if (camera.head_tilt_map) return "a level head (no `head-tilt-map`)";
  if (camera.mirrored) return "a right-handed world";
  if (camera.convergence == kShift) return "eyes that look ahead or toe in (`convergence`)";
  return "";
}

bool cycles_projects(const ProjectionSetting& projection) {
  return projection.kind == kLatLong && projection.pan == 0.0f && projection.tilt == 0.0f;
}

StereoCamera lat_long_of(StereoCamera camera) {
  camera.projection = ProjectionSetting();
  return camera;
}

}  // namespace ods

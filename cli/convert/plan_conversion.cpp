// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/plan_conversion.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/options/eye_options.h"
#include "cli/options/projection_options.h"
#include "ods/picture/stereo_file.h"
#include "ods/video/container/video_file.h"

using ods::Eyes, ods::StereoCamera;

namespace {

StereoCamera base_camera(const ods::StoredPicture& header, const ConvertOptions& options) {
  StereoCamera camera = header.camera;
  const bool becomes_stereo = !options.depth.path.empty() && header.eyes.size() == 1 && !header.has_ipd;
  if (becomes_stereo) camera.top = camera.bottom = ods::kUsualMerge;
  return camera;
}

std::vector<int> requested_eyes(const ods::StoredPicture& header, const ConvertOptions& options) {
  const std::optional<Eyes> given = options.form.given_eyes();
  if (options.mono || given == Eyes::kMonoEye) return {ods::kMono};
  if (given) return ods::eye_list(*given);
  const bool makes_two = !options.depth.path.empty() && header.eyes.size() == 1;
  return makes_two ? std::vector<int>{ods::kLeft, ods::kRight} : same_format(header).eyes;
}

// The projection that the output's name says, where the input's would mislead players. A window stays one.
void take_named_projection(const ods::ProjectionSetting& own, const ConvertOptions& options, StereoCamera& camera) {
  const ods::NamedProjection* named = ods::read_name(options.output).projection;
  const bool is_open = !options.camera.changes.projection.any() && own.kind != ods::kPerspective;
  if (named && is_open && named->setting.kind != own.kind) camera.projection = named->setting;
}

// A mono picture is one of the existing eyes, wherever the eyes are to move.
bool moves_one_eye(const ods::StoredPicture& header, const ods::ConvertTarget& target, bool merges_by_depth) {
  StereoCamera requested = target.camera;
  const StereoCamera& own = header.camera;
  requested.yaw = own.yaw, requested.pitch = own.pitch, requested.roll = own.roll;
  return target.eyes[0] == ods::kMono && (merges_by_depth || !ods::same_eyes(requested, own));
}

bool records_no_distance(const ods::StoredPicture& header, const ConvertOptions& options) {
  const bool is_flat = header.camera.projection.kind == ods::kPerspective;
  return ods::stereo_file(options.output) == ods::StereoFile::kSpatial && is_flat && header.eyes.size() == 2 &&
         !header.has_ipd && options.depth.path.empty();
}

}  // namespace

void take_stated_distance(const ConvertOptions& options, ods::StoredPicture& picture) {
  const auto& numbers = options.camera.changes.numbers;
  const auto stated = numbers.find(ods::CameraField::kIpd);
  if (!records_no_distance(picture, options) || stated == numbers.end() || !stated->second) return;
  picture.camera.ipd = *stated->second;
  picture.has_ipd = true;
}

ConversionPlan plan_conversion(const ods::StoredPicture& header, const ConvertOptions& options) {
  ConversionPlan plan;
  const CameraOptions& by = options.camera;
  ods::ConvertTarget& target = plan.target;
  StereoCamera& stereo = target.camera = changed(base_camera(header, options), by.changes);
  take_named_projection(header.camera.projection, options, stereo);
  turn(stereo, by.yaw.value_or(0.0f), by.pitch.value_or(0.0f), by.roll.value_or(0.0f));
  target.holes = options.holes;
  target.right = options.right;
  target.eyes = requested_eyes(header, options);
  if (options.form.given_eyes() == Eyes::kRightEye) target.mono_from = ods::kRight;
  if (moves_one_eye(header, target, by.changes.merge_limit.has_value())) {
    plan.notes.emplace_back("--ipd, --merge, --head-tilt-map and --eye-to-neck have no effect on one eye");
  }
  if (records_no_distance(header, options)) {
    plan.notes.push_back(
        fmt::format("'{}' does not record how far apart its cameras were: 65 mm; --ipd states another "
                    "distance",
                    options.input));
  }
  plan.save.sidecar = options.sidecar;
  save_as_it_was(header, stereo.projection, options.output, options.form.given_layout(), options.display, plan.save);
  if (options.display.exposure && keeps_light(options.output)) {
    plan.notes.emplace_back("--exposure does not affect .exr and .hdr");
  }
  target.eye = ods::fitting_extent(header, stereo.projection);
  if (const int width = options.form.given_width().value_or(0); width > 0) {
    target.eye = {width, options.form.given_height().value_or(0)};
  }
  finish_projection(stereo.projection, target.eye.width, target.eye.height);
  return plan;
}

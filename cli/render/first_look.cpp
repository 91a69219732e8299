// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/first_look.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/options/eye_options.h"
#include "cli/options/picture_options.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/sheet_glass.h"
#include "ods/sequence/looks.h"
#include "ods/stage/exposure.h"
#include "ods/stage/judge_scene.h"
#include "ods/stage/place.h"

namespace {

// Warns about a camera that the user or the file has placed where there is nothing to see. Our own choice is in free
// space.
void check_view(const RenderJob& job, const ods::Scene& scene, ods::vec3 eye) {
  const bool own_choice = !job.camera.position &&
                          ods::camera_choice(job.camera.view_point) != ods::CameraChoice::kNamed &&
                          !uses_own_camera(scene);
  const bool made_for_it = !job.camera.position && ods::find_builtin(job.scene.name);
  if (own_choice || made_for_it) return;
  const std::string fault = ods::view_fault(ods::SceneRays(scene), eye);
  if (fault.empty()) return;
  std::string remedy = "--position X,Y,Z moves it";
  if (job.camera.position && scene.viewing) {
    const ods::vec3 better = scene.viewing->view.position;
    remedy = fmt::format("without --position it would be at {:.4g},{:.4g},{:.4g}", better.x, better.y, better.z);
  } else if (scene.viewing) {
    const ods::vec3 better = scene.viewing->view.position;
    remedy = fmt::format("--position {:.4g},{:.4g},{:.4g} is in free space", better.x, better.y, better.z);
  }
  warn(fmt::format("the camera {}; {}, or the scene has another unit (--unit cm)", fault, remedy));
}

// Notes which solid glass --caustics straight simplifies.
void note_straight_light(const RenderJob& job, const ods::Scene& scene) {
  if (job.render.caustics != ods::Caustics::kStraight) return;
  const std::vector<std::string> solids = ods::smooth_solids(scene);
  if (solids.empty()) return;
  const std::string others = solids.size() == 1 ? "" : fmt::format(" and {} more", solids.size() - 1);
  note(fmt::format("light passes through solid glass ('{}'{}) without refraction; --caustics path refracts it",
                   solids.front(), others));
}

}  // namespace

bool is_shown_to_viewers(const RenderJob& job) {
  return job.time.is_video || job.part || !keeps_light(job.output);
}

float unmeasured_exposure(const RenderJob& job) {
  return ods::brightened(job.exposure.value_or(0.0f), job.brighter);
}

void note_unmeasured_light(const RenderJob& job) {
  if (job.exposure || keeps_light(job.output)) return;
  note(fmt::format("exposure {:g}: with --rig the light is not measured (--exposure STOPS changes it)",
                   unmeasured_exposure(job)));
}

void report_viewpoint(const RenderJob& job, ods::FrameRenderer& renderer, const ods::SequenceFrame& first) {
  const ods::StereoCamera camera = renderer.set(first).camera();
  note_camera(job.camera, renderer.scene(), camera);
  check_view(job, renderer.scene(), camera.position);
  note_straight_light(job, renderer.scene());
}

void report_look(const RenderJob& job, const ods::SequenceOptions& options, const ods::FirstLook& look) {
  if (options.merge_limit) note(merge_by_depth_text(*options.camera.stereo.merge_map));
  const bool is_shown = is_shown_to_viewers(job);
  switch (look.reason) {
    case ods::ExposureReason::kKnown:
      return;
    case ods::ExposureReason::kPainted:
      if (is_shown)
        note(fmt::format("exposure {:g}{}, since the colours are shown as they are painted (--exposure, --tone)",
                         look.exposure, job.tone ? "" : " and no tone curve"));
      return;
    case ods::ExposureReason::kDark:
      return warn(
          "the picture is black: no light reaches the camera (--env 1 lights the scene, --position X,Y,Z moves it)");
    case ods::ExposureReason::kRecorded:
      return note(
          fmt::format("exposure {:+} stops, as in the existing frames (--restart chooses a new one)", look.exposure));
    case ods::ExposureReason::kLight: {
      if (!is_shown)
        return note(fmt::format("noise is judged at {:+} stops, as the picture will be viewed", look.exposure));
      const std::string brighter = job.brighter == 0.0f ? "" : fmt::format(" --brighter {}", job.brighter);
      note(fmt::format("exposure {:+} stops, from a first look at the light{} (--exposure {}{})", look.exposure,
                       brighter.empty() ? "" : " and" + brighter, look.chosen, brighter));
    }
  }
}

// One line for all frames, and none for a part of a picture: the others would repeat it.
void warn_of_strain(const RenderJob& job, ods::FrameRenderer& renderer, const std::vector<ods::SequenceFrame>& all) {
  constexpr double kLongSamples = 2e7;  // in all pixels: rendering takes more than a few seconds
  const double samples =
      1.0 * job.render.width * job.render.width * job.render.samples * static_cast<double>(all.size());
  if (samples < kLongSamples || job.part || ods::eye_list(job.render.eyes).size() < 2) return;
  for (const size_t i : ods::sampled_frames(all, ods::kLooks)) {
    const ods::Shot shot = renderer.set(all[i]);
    const ods::JudgedPicture judged = ods::judge_scene(renderer.renderer(), renderer.scene(), shot.camera());
    const std::string line = ods::strain_line(judged.verdict, ods::ComfortLevel::kError);
    if (line.empty()) continue;
    return warn(line + (job.camera.changes.merge_limit ? "" : ", or --merge auto or a smaller --ipd") +
                "; ods comfort has more");
  }
}

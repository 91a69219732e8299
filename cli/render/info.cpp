// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods info: shows the contents of a scene, as text or JSON.
#include "ods/scene/info.h"

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/options/camera_options.h"
#include "cli/options/scene_source.h"
#include "cli/render/info_report.h"
#include "ods/render/cpu/render.h"
#include "ods/stage/judge_scene.h"
#include "ods/stage/light/supply.h"

using ods::SceneInfo, ods::vec3;

namespace {

constexpr const char* kInfoExamples =
    "  ods info scene.glb\n"
    "  ods info scene.glb --position 0,1.6,0      the nearest surface from there\n"
    "  ods info scene.glb --json";

struct InfoJob {
  SceneSource source;
  CameraOptions camera;
  bool json = false;
};

InfoJob parse_info(Options& options) {
  InfoJob job;
  options.describe("Shows what is in a scene, and which parts of it are not rendered.", kInfoExamples);
  add_scene_argument(options, job.source);
  add_place_options(options, job.camera);
  options.group("Console");
  options.flag("--json", job.json, "print JSON");
  add_console_options(options);
  options.parse();
  job.source.has_places = job.camera.position.has_value();
  job.source.camera = job.camera.view_point;
  return job;
}

void show_info(const InfoJob& job) {
  SceneSource source = job.source;
  read_foreign(source);
  console.quiet = true;  // notes on the scene would repeat the result
  const CameraOptions& camera = job.camera;
  const ods::LightChoices choices = choices_for(source, false);
  SceneFindings found;
  const ods::Scene scene =
      open_scene(source, &found.settled, [&](const ods::SceneRays& rays, const ods::Survey& survey) {
        if (survey.kind == ods::SceneKind::kClosedRoom) found.advice = plan_light(rays, survey, choices).advice;
      });
  found.viewing = scene.viewing;
  const vec3 position = place_camera(camera, scene).position;
  SceneInfo info = describe(scene, position);
  if (info.nearest_surface >= 0.0f) {
    const ods::JudgedPicture judged = ods::judge_scene(ods::CpuRenderer(scene), scene, place_camera(camera, scene));
    found.strain = ods::strain_line(judged.verdict, ods::ComfortLevel::kWarning);
  }
  info.has_environment |= choices.given.radiance != vec3(0.0f);
  found.advice = with_options(found.advice), found.settled.unit_reason = with_options(found.settled.unit_reason);
  for (std::string& loss : info.losses) loss = with_options(loss);
  for (std::string& warning : info.warnings) warning = with_options(warning);
  for (ods::UsedExtension& extension : info.extensions) extension.how = with_options(extension.how);
  job.json ? print_json(info, found, position) : print_text(info, found, position);
}

}  // namespace

extern const Command kInfo = make_command<parse_info, show_info>("info", "show what is in a scene");

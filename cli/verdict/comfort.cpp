// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods comfort: judges how a picture, a video, or a scene before it is rendered, strains its viewer's eyes.
#include <chrono>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/verdict/comfort_job.h"
#include "cli/verdict/comfort_page.h"
#include "cli/verdict/comfort_report.h"
#include "cli/verdict/comfort_video_report.h"
#include "ods/comfort/heat.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/files/atomic_file.h"
#include "ods/picture/save.h"
#include "ods/render/cpu/render.h"
#include "ods/stage/judge_scene.h"

namespace {

ods::JudgedPicture judge_scene(const ComfortJob& job) {
  const ods::Scene scene = open_scene(job.scene);
  expect_content(scene, job.scene.name);
  ods::StereoCamera camera = place_camera(job.camera, scene);
  const ods::CpuRenderer renderer(scene);
  if (job.camera.changes.merge_limit) {
    ods::use_merge_map(camera, ods::merge_map_of(ods::shares_seen(renderer, camera, *job.camera.changes.merge_limit)));
  }
  return ods::judge_scene(renderer, scene, camera, job.width, job.comfort);
}

ods::JudgedPicture judge_picture(const ComfortJob& job) {
  const std::string& output = job.heat.empty() ? job.html : job.heat;
  const std::string scratch = output.empty() ? "" : ods::existing_folder_of(output);
  return ods::judge_picture(job.scene.name, {job.comfort, job.format, !output.empty(), scratch});
}

ods::ComfortLevel judge_still(const ComfortJob& job) {
  const ods::JudgedPicture judged = job.input == ComfortInput::kPicture ? judge_picture(job) : judge_scene(job);
  for (const std::string& text : judged.notes) note(text);
  for (const std::string& text : judged.warnings) warn(text);
  job.json ? print_json(job, judged) : print_text(job, judged);
  if (!job.heat.empty()) {
    for (const std::string& file : ods::save_picture(ods::heat_picture(judged), judged.camera, {}, job.heat)) {
      announce_file(file);
    }
  }
  if (!job.html.empty()) save_page(job, judged);
  return judged.verdict.level;
}

ods::ComfortLevel judge_video(const ComfortJob& job) {
  ods::VideoComfort video;
  run_long_job(job.progress, 0, [&](ProgressLines& lines) {
    const auto start = std::chrono::steady_clock::now();
    ods::Progress progress;
    progress.report = [&](double done) { lines.report(done, seconds_since(start), {"comfort", 0, 0, job.scene.name}); };
    video = ods::judge_video(job.scene.name, {job.comfort, job.format}, progress);
  });
  for (const std::string& text : video.notes) note(text);
  job.json ? print_json(job, video) : print_text(job, video);
  if (!job.html.empty()) save_page(job, video);
  return video.level;
}

ExitCode comfort(ComfortJob job) {
  settle_input(job);
  const ods::ComfortLevel level = job.input == ComfortInput::kVideo ? judge_video(job) : judge_still(job);
  return level == ods::ComfortLevel::kError ? kExitFault : kExitOk;
}

}  // namespace

extern const Command kComfort = make_command<parse_comfort, comfort>("comfort", "find what strains a viewer's eyes");

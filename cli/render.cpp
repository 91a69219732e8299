// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods render: a scene becomes a stereo 360 picture.
#include "ods/cpu/render.h"

#include <fmt/format.h>

#include <chrono>
#include <iostream>

#include "cli/console.h"
#include "cli/form_options.h"
#include "cli/long_job.h"
#include "cli/render_job.h"

namespace {

void render_to_file(const RenderJob& job, ProgressLines& lines) {
  ods::check_output(job.output, job.save, ods::eye_list(job.render.eyes), {job.render.width, job.render.height});
  note_misleading_name(job.output, job.save, ods::eye_list(job.render.eyes).size(), job.camera.rig.projection);
  ods::Scene scene = open_scene(job.scene);
  add_environment(scene, job.scene);
  ods::CameraRig rig = place_camera(job.camera, scene);

  auto start = std::chrono::steady_clock::now();
  ods::Progress progress;
  progress.report = [&](double done) { lines.report(done, seconds_since(start)); };
  ods::Picture picture = ods::render_cpu(scene, rig, job.render, progress);
  double seconds = seconds_since(start);
  lines.clear();

  std::vector<std::string> files = ods::save_picture(picture, rig, job.save, job.output);
  for (const std::string& file : files) std::cout << file << std::endl;
  double samples = 1.0 * job.render.width * job.render.height * job.render.samples;
  samples *= static_cast<double>(picture.eyes.size());
  note(fmt::format("{} in {}, {:.3g} Msamples/s", files.front(), duration_text(seconds), samples / seconds * 1e-6));
}

void render(int argc, char** argv) {
  RenderJob job;
  if (!read_render_job(job, argc, argv)) return;
  run_long_job(job.progress, job.render.threads, [&](ProgressLines& lines) { render_to_file(job, lines); });
}

}  // namespace

extern "C" int ods_render(int argc, char** argv) {
  return run_command([=] { render(argc, argv); });
}

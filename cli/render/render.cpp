// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods render: renders a scene as a stereo 360 picture, or as the frames of a video.
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/render/render_frames.h"
#include "cli/render/render_job.h"
#include "cli/render/render_still.h"

namespace {

void render(int argc, char** argv) {
  RenderJob job;
  if (!read_render_job(job, argc, argv)) return;
  run_long_job(job.progress, job.render.threads,
               [&](ProgressLines& lines) { job.rig.empty() ? render_job(job, lines) : render_views(job, lines); });
}

}  // namespace

int ods_render(int argc, char** argv) {
  return run_command([=] { render(argc, argv); });
}

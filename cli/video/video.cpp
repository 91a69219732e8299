// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods video: renders a scene as a video, or some of its frames.
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/video/make_video.h"

namespace {

void video(int argc, char** argv) {
  VideoJob job;
  if (!read_video_job(job, argc, argv)) return;
  run_long_job(job.render.progress, job.render.render.threads, [&](ProgressLines& lines) { make_video(job, lines); });
}

}  // namespace

int ods_video(int argc, char** argv) {
  return run_command([=] { video(argc, argv); });
}

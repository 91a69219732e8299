// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods video: renders a scene as a video, or some of its frames.
#include "cli/console/command.h"
#include "cli/console/long_job.h"
#include "cli/video/make_video.h"

namespace {

void video(const VideoJob& given) {
  const VideoJob job = settled(given);
  run_long_job(job.render.progress, job.render.render.threads, [&](ProgressLines& lines) { make_video(job, lines); });
}

}  // namespace

extern const Command kVideo = make_command<parse_video, video>("video", "render a scene as a stereo 360 video");

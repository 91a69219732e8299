// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods render: renders a scene as a stereo 360 picture, or as the frames of a video.
#include <fmt/format.h>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/render/render_frames.h"
#include "cli/render/render_job.h"
#include "cli/render/render_still.h"
#include "cli/render/render_with_cycles.h"

namespace {

void render(const RenderJob& given) {
  if (given.parts > 0) throw UsageError("--parts is for ods submit; --part 1/8 renders one of 8 parts");
  if (!given.part && keeps_light(given.output)) {
    const std::string use = given.render.noise > 0.0f ? ": only noise is judged at it" : "";
    if (given.exposure) note("--exposure does not change .exr and .hdr, which are scene-linear" + use);
    if (given.brighter != 0.0f) note("--brighter does not change .exr and .hdr, which are scene-linear" + use);
  }
  const RenderJob job = settled(given);
  run_long_job(job.progress, job.render.threads, [&](ProgressLines& lines) {
    if (job.cycles) return render_with_cycles(job, lines);
    job.rig.empty() ? render_job(job, lines) : render_views(job, lines);
  });
}

}  // namespace

extern const Command kRender =
    make_command<parse_render, render>("render", "render a scene as a stereo 360 picture or frames");

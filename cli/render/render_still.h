// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// One picture: rendered so that it can be interrupted and resumed, or a part of its samples; and the views of a rig of
// slits (ods rig), one file each.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "cli/console/progress.h"
#include "cli/render/render_job.h"
#include "ods/render/cpu/render.h"

struct Rendered {
  std::vector<std::string> files;
  double samples;  // in all pixels together
};

// Renders job.output. Ends the process if a signal interrupts it, after keeping what is rendered.
Rendered render_still(const RenderJob& job, const ods::CpuRenderer& renderer, const ods::Scene& scene,
                      std::span<const ods::StereoCamera> cameras, const ods::RenderOptions& options,
                      const ods::Progress& progress);

// Renders the views of the job's rig at the job's time, and prints the name of every file as soon as it exists. Throws
// UsageError and ods::Error.
void render_views(const RenderJob& job, ProgressLines& lines);

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// One picture: rendered so that it can be interrupted and resumed, or a part of its samples; and the views of a rig of
// slits (ods rig), one file each.
#pragma once
#include <functional>

#include "cli/console/progress.h"
#include "cli/render/render_job.h"
#include "ods/sequence/frame_renderer.h"

// Renders job.output, a single frame. Ends the process if a signal interrupts it, after saving the samples.
ods::Rendered render_still(const RenderJob& job, ods::FrameRenderer& renderer, const ods::SequenceFrame& frame,
                           const std::function<void(double done)>& report);

// Renders the views of the job's rig at the job's time, and prints the name of every file as soon as it exists. Throws
// UsageError and ods::Error.
void render_views(const RenderJob& job, ProgressLines& lines);

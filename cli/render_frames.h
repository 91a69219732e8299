// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The frames of a film, each a file.
#pragma once
#include <functional>
#include <vector>

#include "cli/progress.h"
#include "cli/render_job.h"

// Renders what the job asks for, a picture or a film, and says every file on stdout once it is there. A frame's file
// exists only when it is complete, so that a run that was killed is resumed with --skip-existing.
void render_job(const RenderJob& job, ProgressLines& lines);

// The same of a film for who goes on with its frames: says nothing of files, and returns the numbers of all of them,
// those too that were there. Throws UsageError where nothing moves and nobody said how long.
std::vector<int> render_frames(const RenderJob& job, const StepReport& report);

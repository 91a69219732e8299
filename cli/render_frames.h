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
// exists only when it is complete, so that a run that was killed is resumed with --skip-existing; several processes
// that run with it share the frames (cli/shared_frames.h).
void render_job(const RenderJob& job, ProgressLines& lines);

// Renders the frames of a film whose caller goes on with them: says nothing of files, and returns the numbers of all of
// them, also of those that were there. `planned` hears of these numbers before the first is rendered. Throws UsageError
// where nothing moves and nobody said how long.
std::vector<int> render_frames(const RenderJob& job, const std::function<void(double done)>& report,
                               const std::function<void(const std::vector<int>& frames)>& planned);

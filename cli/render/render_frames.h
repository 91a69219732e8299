// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The frames of a video, each a file.
#pragma once
#include <functional>
#include <vector>

#include "cli/console/progress.h"
#include "cli/render/render_job.h"

// Renders what the job asks for, a picture or a video, and says every file on stdout once it is there. A frame's file
// exists only when it is complete, so that a run that was killed is resumed with --skip-existing; several processes
// that run with it share the frames (cli/frames/shared_frames.h).
void render_job(const RenderJob& job, ProgressLines& lines);

// Renders the frames of a video for a caller that goes on with them: prints no file names, and returns the numbers of
// all frames, also of those that were there. `planned` hears of these numbers before the first is rendered. Throws
// UsageError where nothing moves and no length was given.
std::vector<int> render_frames(const RenderJob& job, const StepReport& report,
                               const std::function<void(const std::vector<int>& frames)>& planned);

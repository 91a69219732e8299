// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The frames of a video, each a file.
#pragma once
#include <functional>
#include <vector>

#include "cli/console/progress.h"
#include "cli/render/render_job.h"

// Renders the job's picture or frames, and prints the name of every file as soon as it exists. A frame's file exists
// only when it is complete, so --skip-existing resumes a killed run; several processes with that option share the
// frames (ods/sequence/sequence.h).
void render_job(const RenderJob& job, ProgressLines& lines);

// The frames that the job asks for. Loads the scene if their number depends on it. Throws UsageError if nothing moves
// and no length was given.
std::vector<int> frames_of(const RenderJob& job);

struct RenderedFrames {
  std::vector<int> numbers;  // of all frames, including those that existed
  float exposure = 0.0f;     // stops, to show them with
  bool as_painted = false;   // Scene::as_painted
};

// Renders a video's frames for a caller that processes them further; prints their names only with --only, when they are
// all that is made. Passes these numbers to `planned` before rendering the first. Throws UsageError if nothing moves
// and no length was given.
RenderedFrames render_frames(const RenderJob& job, const StepReport& report,
                             const std::function<void(const std::vector<int>& frames)>& planned);

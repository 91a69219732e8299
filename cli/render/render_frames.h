// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture or the frames of ods render.
#pragma once
#include <vector>

#include "cli/console/progress.h"
#include "cli/render/render_job.h"

// Renders the job's picture or frames, and prints the name of every file as soon as it exists. A frame's file exists
// only when it is complete, so --skip-existing resumes a killed run; several processes with that option share the
// frames (ods/sequence/sequence.h).
void render_job(const RenderJob& job, ProgressLines& lines);

// Checks that the files can be written; notes a misleading name.
void check_outputs(const RenderJob& job);

// Starts the clock of the scene for a video. Throws UsageError if nothing moves and no length was given.
TimeOptions video_time(const RenderJob& job, ods::Scene& scene);

// Returns the frames that the job requests. Loads the scene if their number depends on it. Throws as video_time().
std::vector<int> frames_of(const RenderJob& job);

// Notes how many of the chosen frames exist.
void note_existing_frames(size_t existing, size_t chosen);

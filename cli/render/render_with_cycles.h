// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A job rendered by the Cycles of Blender instead of our renderer: pictures, frames, and the frames of videos.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "cli/console/progress.h"
#include "cli/render/render_job.h"
#include "ods/base/settings.h"
#include "ods/sequence/sequence.h"

// Opens the job's file in Blender, and sets what depends on it. Throws UsageError and ods::Error.
void open_in_cycles(RenderJob& job);

// Sets the clock by the frames of the file. Throws UsageError if a video has no length.
TimeOptions cycles_time(const RenderJob& job);

// The identity of pictures and frames. Precondition: the job is settled(). Throws as identified() does.
ods::Settings cycles_identity(const RenderJob& job);

// The identity of one of a picture's parts, job.part. Throws as identified() does.
ods::Settings cycles_part_identity(const RenderJob& job);

// Renders frames of a job: all, and the indices of those to make. Files that other processes make are left to them if
// `shared`. saved: gets the names of each frame's files.
struct CyclesFrames {
  std::vector<ods::SequenceFrame> all;
  std::vector<size_t> missing;
  bool shared = false;
  ods::CameraMove move{};  // --turntable and --fly-to, with their duration
  std::function<void(double done, const ods::FrameAtWork& at)> report;
  std::function<void(const std::vector<std::string>& files)> saved;
};
void render_cycles_frames(const RenderJob& job, const CyclesFrames& frames);

// Renders the job's picture or frames, and prints the name of every file as soon as it exists. A picture that was
// interrupted resumes with the eyes, and parts of an eye, that are in PICTURE.frames.
void render_with_cycles(const RenderJob& job, ProgressLines& lines);

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A job in the library's terms.
#pragma once
#include "cli/render/render_job.h"
#include "ods/sequence/sequence.h"

struct RenderPlan {
  ods::SequenceOptions sequence;  // the job's frames, or its one picture
  ods::RenderOptions sampled;     // for sampling: with the layers that denoising, keeping and merging a picture need
};

// time: the job's, or the result of start_clock() for a scene.
RenderPlan plan(const RenderJob& job, const TimeOptions& time);
inline RenderPlan plan(const RenderJob& job) {
  return plan(job, job.time);
}

// Returns the plan's sequence with the settings of its scene, for ods/sequence/identity.h: as on the command line,
// independent of the scene's contents. Reads the files that the job names. Throws ods::Error(kInput).
ods::SequenceOptions identified(const RenderJob& job);

// The identity of frames stitched from the views of a rig, except the views themselves.
ods::Settings stitch_identity(const std::string& rig_file, const std::string& views, ods::Layout layout);

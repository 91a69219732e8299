// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A job in the library's terms.
#pragma once
#include "cli/render/render_job.h"
#include "ods/sequence/sequence.h"

struct RenderPlan {
  ods::SequenceOptions sequence;  // the job's frames, or its one picture
  ods::RenderOptions sampled;     // what is sampled: with the layers that denoising, keeping and merging a picture need
};

// time: the job's, or what start_clock() has made of it for a scene.
RenderPlan plan(const RenderJob& job, const TimeOptions& time);
inline RenderPlan plan(const RenderJob& job) {
  return plan(job, job.time);
}

// The plan's sequence with what its scene is made of, for ods/sequence/identity.h: as the command line has it, whatever
// the scene is like. Reads the files that the job names. Throws ods::Error(kInput).
ods::SequenceOptions identified(const RenderJob& job);

// The identity of frames stitched from the views of a rig, except the views themselves.
ods::Settings stitch_identity(const std::string& rig_file, const std::string& views, ods::Layout layout);

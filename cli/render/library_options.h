// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A job in the library's terms.
#pragma once
#include "cli/render/render_job.h"
#include "ods/sequence/sequence.h"

// How the job's pictures are denoised: by its options, or by what they are for.
ods::Denoiser denoiser_of(const RenderJob& job);

// Whether the job's frames draw on each other: those of a video that our own denoiser makes clean.
bool draws_on_neighbours(const RenderJob& job);

// The options with the layers that saving the job's pictures needs, and denoising them.
ods::RenderOptions options_to_finish(const RenderJob& job);

ods::FinishOptions finish_of(const RenderJob& job);

// Its frames, or its one picture. The arguments must outlive what is returned, which follows changes of job.camera.
// Precondition: start_clock() has run.
ods::SequenceOptions sequence_of(const RenderJob& job, const TimeOptions& time);

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages about a job's scene before it is rendered.
#pragma once
#include <vector>

#include "cli/render/render_job.h"
#include "ods/sequence/looks.h"

// Returns whether viewers see the result through an exposure and a tone curve: a video, a part, or a file other than
// .exr and .hdr.
bool is_shown_to_viewers(const RenderJob& job);

// Notes the camera's place in the first frame, and simplifications; warns if nothing is visible from there.
void report_viewpoint(const RenderJob& job, ods::FrameRenderer& renderer, const ods::SequenceFrame& first);

// The exposure, in stops, of a job whose light is not measured: as given.
float unmeasured_exposure(const RenderJob& job);

// Notes it for --rig, if neither the job nor its file determines the exposure.
void note_unmeasured_light(const RenderJob& job);

// Notes the merge and the exposure that ods::look_first() has found for the renderer; warns if all is black.
void report_look(const RenderJob& job, const ods::SequenceOptions& options, const ods::FirstLook& look);

// Warns once, before a long rendering, if anything in the frames strains the viewer's eyes beyond the error limit.
void warn_of_strain(const RenderJob& job, ods::FrameRenderer& renderer, const std::vector<ods::SequenceFrame>& all);

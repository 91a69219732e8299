// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages about a job's scene before it is rendered.
#pragma once
#include <vector>

#include "cli/render/render_job.h"
#include "ods/sequence/looks.h"

// Returns whether the job's file is display-encoded: neither .exr nor .hdr.
bool is_looked_at(const RenderJob& job);

// Notes the camera's place in the first frame, and simplifications; warns if nothing is visible from there.
void report_viewpoint(const RenderJob& job, ods::FrameRenderer& renderer, const ods::SequenceFrame& first);

// Notes the merge and the exposure that ods::look_first() has found for the renderer; warns if all is black.
void report_look(const RenderJob& job, const ods::SequenceOptions& options, const ods::FirstLook& look);

// Says once, before a long rendering, if something in some of `all` strains the viewer's eyes to an error.
void warn_of_strain(const RenderJob& job, ods::FrameRenderer& renderer, const std::vector<ods::SequenceFrame>& all);

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Estimates the cost of a video before it is rendered, from small pictures of some of its frames.
#pragma once
#include <vector>

#include "cli/render/render_job.h"
#include "ods/sequence/frame_renderer.h"

// Notes the time to render these frames, the disk space that they need, and faster settings if the time is long. Throws
// ods::Error(kOutput) if the disk cannot hold them; with job.force it warns. Precondition: frames is not empty.
void report_forecast(const RenderJob& job, ods::FrameRenderer& renderer, const std::vector<ods::SequenceFrame>& frames);

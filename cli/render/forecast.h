// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a video will take, found out before it is rendered: a first look at some of its frames, in small pictures.
#pragma once
#include <vector>

#include "cli/render/render_job.h"
#include "ods/sequence/frame_renderer.h"

// Says how long rendering these frames takes and how much disk space they need, and what would be faster if that is
// long. Throws ods::Error(kOutput) if the disk cannot hold them; with job.force it warns. Precondition: frames is not
// empty.
void say_forecast(const RenderJob& job, ods::FrameRenderer& renderer, const std::vector<ods::SequenceFrame>& frames);

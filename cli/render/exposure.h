// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The exposure of a picture or video that is rendered.
#pragma once
#include <vector>

#include "cli/render/frame_renderer.h"

// Adds --exposure auto|STOPS, which sets job.exposure.
void add_exposure_option(Options& options, RenderJob& job);

// The exposure that the job asks for: a number of stops, or what suits its light (ods/stage/exposure.h) by a first look
// at some of `frames`, all frames of the video whatever exists already, or the one picture. It depends on the job
// alone, so that processes that share the frames, and those that resume them, find the same. 0 where files keep the
// scene's light, and for built-in scenes in their own light, which are made for it. Notes what it chose; warns if all
// is black.
float find_exposure(const RenderJob& job, FrameRenderer& renderer, const std::vector<Frame>& frames);

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What is found out about a job's scene before it is rendered, and said.
#pragma once
#include <vector>

#include "cli/render/render_job.h"
#include "ods/sequence/frame_renderer.h"

// Notes where the camera is at first, and what is simplified; warns if there is nothing to see from there. Sets the
// scene to the frame's time.
void say_where(const RenderJob& job, const TimeOptions& time, ods::Scene& scene, const ods::SequenceFrame& first);

// Stops. In a file that keeps the scene's light the noise is judged at another exposure than it is saved with.
struct Exposures {
  float saved = 0.0f, judged = 0.0f;
};

// The exposure that the job asks for: a number of stops, or what suits its light by a first look at some of `all`: all
// frames of the video, whatever exists already, or the one picture; --brighter is added. 0 where files keep the scene's
// light, and for built-in scenes in their own light, which are made for it. Notes what it chose; warns if all is black.
Exposures choose_exposure(const RenderJob& job, const ods::Scene& scene, ods::FrameRenderer& renderer,
                          const std::vector<ods::SequenceFrame>& all);

// Says once, before a long rendering, if something in some of `all` strains the viewer's eyes to an error.
void warn_of_strain(const RenderJob& job, ods::FrameRenderer& renderer, const std::vector<ods::SequenceFrame>& all);

// --merge auto: the merge that the scene's depth allows, in all of these frames. Notes what it chose.
void settle_merge(RenderJob& job, ods::FrameRenderer& renderer, const std::vector<ods::SequenceFrame>& all);

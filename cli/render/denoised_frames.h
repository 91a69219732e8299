// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A video's frames, each denoised together with the frames before and after it (ods/denoise/denoise.h).
#pragma once
#include <map>
#include <set>

#include "cli/render/frame_renderer.h"

// Whether the job's frames draw on each other: those of a video that our own denoiser makes clean.
bool draws_on_neighbours(const RenderJob& job);

class DenoisedFrames {
 public:
  // all: the video's frames, in order; wanted: indices of those to make. The arguments must outlive this object.
  DenoisedFrames(const RenderJob& job, FrameRenderer& renderer, const std::vector<Frame>& all,
                 const std::set<size_t>& wanted);

  // Makes the frame all[index], and renders it and those beside it first, unless an earlier call did. A frame has the
  // same bits whatever was made before. Rising indices are the fastest. report: gets the fraction of the whole.
  Rendered make(size_t index, const std::function<void(double done)>& report);

 private:
  struct Neighbour {
    RawFrame raw;
    std::vector<std::vector<ods::vec3>> before, after;  // FrameBeside::places for the frames beside it
  };
  void render(size_t index, const std::function<void(double done)>& report);

  const RenderJob& job_;
  FrameRenderer& renderer_;
  const std::vector<Frame>& all_;
  std::map<size_t, Neighbour> window_;  // by index; at most three
  size_t needed_ = 0;                   // frames to render in all
  size_t rendered_ = 0;
};

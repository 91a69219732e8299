// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A sequence's frames, each denoised together with the frames before and after it (ods/denoise/denoise.h).
#pragma once
#include <map>
#include <vector>

#include "ods/sequence/frame_renderer.h"

namespace ods {

class DenoisedFrames {
 public:
  // all: the sequence's frames, in order; wanted: indices of the frames to make. `renderer` and `all` must outlive this
  // object.
  DenoisedFrames(FrameRenderer& renderer, const std::vector<SequenceFrame>& all, const std::vector<size_t>& wanted);

  // Makes the frame all[index]. First renders it and its neighbours, unless an earlier call did. A frame has the same
  // bits whatever was made before. Ascending indices are the fastest. report: gets the fraction of the whole.
  Rendered make(size_t index, const FrameRenderer::Report& report);

 private:
  struct Neighbour {
    RawFrame raw;
    std::vector<std::vector<vec3>> before, after;  // FrameBeside::places for the frames beside it
  };
  void render(size_t index, const FrameRenderer::Report& report);

  FrameRenderer& renderer_;
  const std::vector<SequenceFrame>& all_;
  std::map<size_t, Neighbour> window_;  // by index; at most three
  size_t needed_ = 0;                   // frames to render in all
  size_t rendered_ = 0;
};

}  // namespace ods

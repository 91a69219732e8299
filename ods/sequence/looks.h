// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a first look at some of a sequence's frames tells of all of them. It depends on the sequence alone, so processes
// that share the frames or resume them find the same.
#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ods/image/image.h"
#include "ods/sequence/frame_renderer.h"

namespace ods {

// Indices of so many frames, spread evenly; of fewer if there are fewer. Precondition: there are frames, here and
// below.
std::set<size_t> looks_at(const std::vector<SequenceFrame>& frames, size_t count);
inline constexpr size_t kLooks = 5;

// The exposure that suits the light of all frames (ods/stage/exposure.h). None: all is black.
std::optional<float> suitable_exposure(FrameRenderer& renderer, const std::vector<SequenceFrame>& frames);

// The merge map with which no frame strains the eyes by more than `limit` minutes of arc above and below
// (ods/comfort/merge_from_depth.h).
Image comfortable_merge(FrameRenderer& renderer, const std::vector<SequenceFrame>& frames, float limit);

// What a frame will take, judged by a small picture of it.
struct SmallFrame {
  double seconds = 0.0;
  double bytes = 0.0;  // of its file
};

// Renders a small picture of a frame, denoises and saves it there.
SmallFrame try_small(FrameRenderer& renderer, const SequenceFrame& frame, const std::string& path);

}  // namespace ods

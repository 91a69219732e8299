// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A first look at some of a sequence's frames finds settings that suit all of them. It depends on the sequence alone,
// so processes that share its frames find the same.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "ods/sequence/frame_renderer.h"

namespace ods {

// Returns the indices of `count` frames, spread evenly; of all if there are fewer. Precondition here and below: there
// are frames.
std::set<size_t> sampled_frames(const std::vector<SequenceFrame>& frames, size_t count);
inline constexpr size_t kLooks = 5;

enum class ExposureReason {
  kKnown,     // SequenceOptions::exposure: given, or known for the scene
  kPainted,   // Scene::as_painted: the colours are shown as they are
  kLight,     // chosen for the light of all frames (ods/stage/exposure.h)
  kDark,      // no light reaches the camera
  kRecorded,  // render_video(): recorded when its first frames were made
};

struct FirstLook {
  float chosen = 0.0f;    // stops, without SequenceOptions::brighter
  float exposure = 0.0f;  // stops, with it
  ExposureReason reason = ExposureReason::kKnown;
};

// Finds the exposure and the merge if the options leave them open. Sets noise_exposure and the camera's merge map in
// the renderer's options.
FirstLook look_first(FrameRenderer& renderer, const std::vector<SequenceFrame>& frames);

// An estimate of a frame's cost from a small picture of it.
struct SmallFrame {
  double seconds = 0.0;
  double bytes = 0.0;  // the size of its file
};

// Renders a small picture of a frame, denoises and saves it there.
SmallFrame try_small(FrameRenderer& renderer, const SequenceFrame& frame, const std::string& path);

}  // namespace ods

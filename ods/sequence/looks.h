// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A first look at some of a sequence's frames finds what suits all of them. It depends on the sequence alone, so
// processes that share its frames find the same.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "ods/sequence/frame_renderer.h"

namespace ods {

// Indices of so many frames, spread evenly; of fewer if there are fewer. Precondition: there are frames, here and
// below.
std::set<size_t> looks_at(const std::vector<SequenceFrame>& frames, size_t count);
inline constexpr size_t kLooks = 5;

enum class ExposureReason {
  kGiven,    // SequenceOptions::exposure
  kPainted,  // Scene::as_painted: the colours are shown as they are
  kLight,    // it suits the light of all frames (ods/stage/exposure.h)
  kDark,     // no light reaches the camera
  kFrames,   // render_video(): frames exist that were made with it
};

struct FirstLook {
  float exposure = 0.0f;  // stops
  ExposureReason reason = ExposureReason::kGiven;
};

// Finds what the options leave open, the exposure and the merge, and sets it in the renderer's options: noise_exposure,
// and the camera's merge map.
FirstLook look_first(FrameRenderer& renderer, const std::vector<SequenceFrame>& frames);

// What a frame will take, judged by a small picture of it.
struct SmallFrame {
  double seconds = 0.0;
  double bytes = 0.0;  // the size of its file
};

// Renders a small picture of a frame, denoises and saves it there.
SmallFrame try_small(FrameRenderer& renderer, const SequenceFrame& frame, const std::string& path);

}  // namespace ods

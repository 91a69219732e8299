// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A scene becomes a video (examples/video.cpp). Its frames are kept in a folder beside it until it is complete, so that
// an interrupted call goes on (ods/sequence/video_journal.h).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/base/settings.h"
#include "ods/sequence/frame_renderer.h"
#include "ods/sequence/video_journal.h"
#include "ods/video/make_video.h"

namespace ods {

struct VideoOptions {
  std::vector<int> frames;        // numbers, rising
  std::optional<float> exposure;  // stops; none: what suits the light of all frames
  ToneCurve tone = DisplayTransform{}.tone;
  EncodeOptions encode;  // its rate replaces SequenceOptions::fps
  // All that the frames depend on, listed by the caller: scene, size, samples, camera. Frames that an interrupted call
  // with other settings has left are refused. Two calls that list none count as one.
  Settings settings;
  bool restart = false, keep_frames = false;
};

// Renders the frames that are missing, each denoised with those beside it, and encodes all. options.camera is required;
// where frames are shown with the chosen exposure, noise is judged at it. Calls progress.report hundreds of times a
// second. Throws Error: kUsage (frames made with other settings, a foreign folder in their place), kInput, kOutput
// (also if another process works on this video), kMemory, kCancelled.
void render_video(Scene& scene, SequenceOptions options, const VideoOptions& video, const std::string& path,
                  const Progress& progress = {});

// The second half: encodes the frames of the journal, and removes them unless they are kept. Throws as make_video().
VideoPlan encode_frames(const VideoJournal& journal, const std::vector<int>& frames, const DisplayTransform& display,
                        const EncodeOptions& encode, const std::string& path, bool keep_frames,
                        const Progress& progress = {});

inline constexpr double kRenderingShare = 0.95;  // of a video's time; encoding takes the rest

// Indices of the frames that are not saved.
std::vector<size_t> missing_frames(const std::vector<SequenceFrame>& all);

}  // namespace ods

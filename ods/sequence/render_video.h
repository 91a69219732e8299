// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Renders a scene as a video (examples/video.cpp). Its frames are kept in a folder beside it until it is complete, so
// that the same call resumes after an interruption (ods/sequence/video_journal.h). Several processes may render the
// frames.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/sequence/looks.h"
#include "ods/sequence/video_journal.h"
#include "ods/video/make_video.h"

namespace ods {

struct VideoOptions {
  std::vector<int> frames;               // frame numbers, ascending
  std::optional<std::vector<int>> only;  // frames that this process renders, alongside others; makes no video
  bool raw = false;                      // with `only`: Sink::kRaw
  std::optional<ToneCurve> tone;         // nullopt: the default; linear for Scene::as_painted
  EncodeOptions encode;
  bool restart = false, keep_frames = false;
  float wait = 0.0f;  // seconds, for frames of other machines that a shared disk does not show yet
};

// A video before its first frame is rendered.
struct VideoStart {
  FrameRenderer& renderer;  // with the options for the frames
  const std::vector<SequenceFrame>& all;
  std::vector<size_t> missing;  // indices of the frames that this process renders
  FirstLook look;
};

struct VideoProgress {
  std::function<void(size_t missing)> late;      // frames that are waited for, before `start`
  std::function<void(const VideoStart&)> start;  // once; may throw, before any frame is made
  SequenceProgress frames;                       // its fraction is the fraction of rendering
  std::function<void(double done)> encoding;     // the fraction of encoding
  std::function<bool()> cancelled;
};

// Renders the missing frames, each denoised with its neighbours, and encodes all at the exposure of the frames, at the
// rate of video.encode. Frames with another identity (ods/sequence/identity.h) are refused. The settings found by a
// first look at the frames are recorded with them, and apply to frames that a later call adds. Reports progress
// hundreds of times a second. Throws Error: kUsage (frames made with other settings, a foreign folder in their place),
// kInput, kOutput (also if another process works on this video), kMemory, kCancelled.
VideoPlan render_video(Scene& scene, SequenceOptions options, const VideoOptions& video, const std::string& path,
                       const Progress& progress = {});

// Renders a video with a journal that was opened for frame_identity() before the scene was loaded, so that a conflict
// is reported early. options.fps is the rate of video.encode. Returns nullopt with `only`.
std::optional<VideoPlan> render_video(VideoJournal& journal, Scene& scene, SequenceOptions options,
                                      const VideoOptions& video, const VideoProgress& progress = {});

// The second half of render_video(): encodes the frames of the journal, and removes them unless they are kept. Throws
// as make_video() does.
VideoPlan encode_frames(const VideoJournal& journal, const std::vector<int>& frames, const DisplayTransform& display,
                        const EncodeOptions& encode, bool keep_frames, const Progress& progress = {});

inline constexpr double kRenderingShare = 0.95;  // fraction of the time that rendering takes; the rest is encoding

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes a tagged video from frames that are computed in parallel, in one pass.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "ods/base/progress.h"
#include "ods/base/settings.h"
#include "ods/video/encode.h"

namespace ods {

// Resuming after a killed call. Encoded frames are kept beside the video (ods/files/parts_file.h), in parts of at least
// kPartFrames frames, until the video is complete. A bit rate, which applies to the whole video, does not allow parts.
struct Resume {
  Settings settings;                                   // all that the frames depend on; if empty, no parts are kept
  std::function<void(const std::string& words)> tell;  // called when it resumes. May be empty
  bool restart = false;                                // discards kept parts
};
inline constexpr int kPartFrames = 240;

struct NewVideo {
  Extent size;
  EncodeOptions options;
  SphericalMetadata metadata;  // options.for_apple adds to it
  int count = 0;               // number of frames, if known, for the progress
  size_t frame_bytes = 0;      // memory for computing one, besides the frame itself
  Resume resume = {};
};

// A frame that is still to be computed: `make` is called once, from any thread.
struct PendingFrame {
  FrameTime time;
  std::function<std::shared_ptr<VideoFrame>()> make;
};

struct WrittenVideo {
  TagResult tags;
  int frames = 0;
};

// Writes a video. `next` returns the frames in order, one call at a time, and nullopt at the end. As many frames are
// computed at once as fit into half of the free memory. The file is written atomically; the same frames and settings
// give the same bytes, in one call or several. Throws Error like VideoEncoder, PartsFile and tag_video(), and
// kCancelled; also errors thrown by `next` and `make`.
WrittenVideo write_video(const NewVideo& video, const std::function<std::optional<PendingFrame>()>& next,
                         const std::string& path, const Progress& progress = {});

}  // namespace ods

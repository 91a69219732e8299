// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes a tagged video of frames that are made in parallel, in one pass.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "ods/base/progress.h"
#include "ods/base/settings.h"
#include "ods/video/encode.h"

namespace ods {

// Going on where a killed call stopped. What is encoded is kept beside the video (ods/files/parts_file.h), in parts of
// at least kPartFrames frames, until the video is complete. A bit rate, which is kept over the whole video, allows no
// parts.
struct Resume {
  Settings settings;                                   // all that the frames depend on; empty: no parts
  std::function<void(const std::string& words)> tell;  // says that it goes on. May be empty
  bool restart = false;                                // discards what is kept
};
inline constexpr int kPartFrames = 240;

struct NewVideo {
  Extent size;
  EncodeOptions options;
  SphericalMetadata metadata;  // options.for_apple adds to it
  int count = 0;               // frames, as far as known: for the progress
  size_t frame_bytes = 0;      // memory that making one takes, beside the frame itself
  Resume resume = {};
};

// A frame that is still to be made: `make` is called once, from any thread.
struct PendingFrame {
  FrameTime time;
  std::function<std::shared_ptr<VideoFrame>()> make;
};

struct WrittenVideo {
  TagResult tags;
  int frames = 0;
};

// `next` returns the frames in order, one call at a time, and nothing at the end. As many are made at once as fit half
// of the free memory. The file is complete or not there at all; the same frames and settings give the same bytes, in
// one call or several. Throws Error as VideoEncoder, PartsFile and tag_video(), and kCancelled; also what `next` and
// `make` throw.
WrittenVideo write_video(const NewVideo& video, const std::function<std::optional<PendingFrame>()>& next,
                         const std::string& path, const Progress& progress = {});

}  // namespace ods

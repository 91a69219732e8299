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
#include "ods/video/encode.h"

namespace ods {

struct NewVideo {
  Extent size;
  EncodeOptions options;
  SphericalMetadata metadata;            // options.for_apple adds to it
  std::optional<Ambisonics> ambisonics;  // of sound that is copied; sound that is encoded anew tells by its channels
  int count = 0;                         // frames, as far as known: for the progress
  size_t frame_bytes = 0;                // memory that making one takes, beside the frame itself
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
// of the free memory. The file is complete or not there at all. Throws Error as VideoEncoder and tag_video(), and
// kCancelled; also what `next` and `make` throw.
WrittenVideo write_video(const NewVideo& video, const std::function<std::optional<PendingFrame>()>& next,
                         const std::string& path, const Progress& progress = {});

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts a video in one decode and one encode: its pictures with frame_converter.h, its sound copied, its time stamps
// and colours kept. Also makes a video of converted frames.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/convert/video/depth_footage.h"
#include "ods/convert/video/frame_converter.h"
#include "ods/convert/video/turn_keys.h"
#include "ods/video/footage.h"
#include "ods/video/make_video.h"
#include "ods/video/write_video.h"

namespace ods {

// The merge map of each picture, by its number from the first one on; null for the target's own. May be called from any
// thread.
using MergeOfPicture = std::function<std::shared_ptr<const Image>(int picture)>;

struct VideoConversion {
  ConvertTarget target;  // as in FrameConverter
  Layout layout = Layout::kTopBottom;
  SphericalMetadata metadata;  // metadata of the new video
  std::vector<TurnKey> turns;  // rotation of the camera; times from the first picture on. May be empty
  Resume resume = {};
  DepthFootage* depth = nullptr;                      // depth of the pictures; may be null
  std::function<void(const DepthReport&)> tell = {};  // called for the first picture's depth
  MergeOfPicture merge = {};                          // only with depth
};

// Converts the part of the video that Footage::choose() selected. `options` specify the packing, and the streams and
// metadata to keep; rate, clock and colours are copied from the video; keep.cut.is_cut must be set for a part. Returns
// the number of frames. Throws Error like VideoDecoder and write_video(); kUsage if that part contains no picture.
int convert_video(Footage& video, const VideoConversion& conversion, EncodeOptions options, const std::string& path,
                  const Progress& progress = {});

// Opens a frame's picture. Throws Error(kInput) like open_picture(), and if it differs in format from the first frame,
// whose header is `first`.
StoredPicture open_frame(const FrameFiles& files, size_t index, const StoredPicture& first);

struct FramesConversion {
  FrameFiles files;
  StoredPicture first;   // header of the first frame; the others have the same format
  ConvertTarget target;  // as in FrameConverter
  Layout layout = Layout::kTopBottom;
  SphericalMetadata metadata;
  DisplayTransform display;  // for scene-linear frames
  Resume resume = {};
  DepthFootage* depth = nullptr;
  std::function<void(const DepthReport&)> tell = {};  // called for the first picture's depth
  MergeOfPicture merge = {};
};

// Makes a video of converted frames. Throws Error like make_video(), also kUsage for a frame that cannot be converted.
int convert_frames(const FramesConversion& conversion, const EncodeOptions& options, const std::string& path,
                   const Progress& progress = {});

}  // namespace ods

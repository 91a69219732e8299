// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts a video in one decode and one encode: its pictures as frame_converter.h does, its sound copied, its time
// stamps and colours kept. And makes a video of converted frames.
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

// The merge map of each picture, by its number from the first one on; none: the target's for all. May be called from
// any thread.
using MergeOfPicture = std::function<std::shared_ptr<const Image>(int picture)>;

struct VideoConversion {
  ConvertTarget target;  // as in FrameConverter
  Layout layout = Layout::kTopBottom;
  SphericalMetadata metadata;  // of the new video
  std::vector<TurnKey> turns;  // how the camera was turned; times from the first picture on. May be empty
  Resume resume = {};
  DepthFootage* depth = nullptr;                      // of the pictures; may be none
  std::function<void(const DepthReport&)> tell = {};  // of the first picture's depth
  MergeOfPicture merge = {};                          // with depth only
};

// Converts the part of the video that Footage::choose() chose. `options` give the packing, and what is kept;
// rate, clock and colours are those of the video; keep.cut.is_cut must be set for a part. Returns the number of
// frames. Throws Error as VideoDecoder and write_video(); kUsage: there is no picture in that part.
int convert_video(Footage& video, const VideoConversion& conversion, EncodeOptions options, const std::string& path,
                  const Progress& progress = {});

// A frame's picture. Throws Error(kInput) as open_picture(), and if it is not like the first frame, of which `first` is
// the header.
StoredPicture open_frame(const FrameFiles& files, size_t index, const StoredPicture& first);

struct FramesConversion {
  FrameFiles files;
  StoredPicture first;   // header of the first frame; the others are like it
  ConvertTarget target;  // as in FrameConverter
  Layout layout = Layout::kTopBottom;
  SphericalMetadata metadata;
  DisplayTransform display;  // of scene-linear frames
  Resume resume = {};
  DepthFootage* depth = nullptr;
  std::function<void(const DepthReport&)> tell = {};  // of the first picture's depth
  MergeOfPicture merge = {};
};

// Throws Error as make_video(), also kUsage for a frame that cannot be converted.
int convert_frames(const FramesConversion& conversion, const EncodeOptions& options, const std::string& path,
                   const Progress& progress = {});

}  // namespace ods

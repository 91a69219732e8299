// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth for the pictures of a video or for frames: a file per picture, a video, or one picture for all.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ods/depth/picture_depth.h"
#include "ods/video/footage.h"

namespace ods {

class DepthFootage {
 public:
  // Adds the depth to its picture; may be called from any thread.
  using Give = std::function<DepthReport(StoredPicture&)>;

  // format: of the pictures. part: of a video; the video of its depth has the same part. first: the number of the first
  // of all frames, even if this process converts others; the scale for an eye height is computed from the first picture
  // of all. Throws Error(kInput) if the files do not exist, or for a damaged video.
  DepthFootage(const std::string& path, const StoredPicture& format, const DepthOptions& options,
               const TimeSpan& part = {}, std::optional<int> first = {});

  // The depth of the next picture. number: the frame's number, also in the name of its depth; not set for a video,
  // whose pictures use frames of depth in order. Throws Error(kInput) if there is none left, and like add_depth().
  Give next(std::optional<int> number);
  // The depth of the next picture; nullopt if there is none left.
  std::optional<Give> next_if_any(std::optional<int> number);

 private:
  std::string path_;
  StoredPicture format_;
  DepthOptions options_;
  FootageKind kind_;
  std::vector<int> frames_;         // for frames
  std::optional<Footage> footage_;  // for a video
  std::shared_ptr<const std::vector<DepthNumbers>> still_;
  std::optional<int> first_;
  size_t taken_ = 0;
};

}  // namespace ods

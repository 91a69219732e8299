// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth for the pictures of a video or of frames: a file for each, a video, or one picture for all.
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

  // format: of the pictures. part: of a video, which its depth's video shares. first: the number of the first of all
  // frames, of which this process may convert others; the scale of an eye height is that of the first picture of all.
  // Throws Error(kInput): no such files, a damaged video.
  DepthFootage(const std::string& path, const StoredPicture& format, const DepthOptions& options,
               const TimeSpan& part = {}, std::optional<int> first = {});

  // The depth of the next picture. number: of a frame, which its depth has, too; none: of a video, whose pictures take
  // frames of depth in their order. Throws Error(kInput): there is none left, and as add_depth().
  Give next(std::optional<int> number);
  // The same; nothing if there is none left.
  std::optional<Give> next_if_any(std::optional<int> number);

 private:
  std::string path_;
  StoredPicture format_;
  DepthOptions options_;
  FootageKind kind_;
  std::vector<int> frames_;         // of frames
  std::optional<Footage> footage_;  // of a video
  std::shared_ptr<const std::vector<DepthNumbers>> still_;
  std::optional<int> first_;
  size_t taken_ = 0;
};

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a command takes as its pictures: one picture, a file for each frame, or a video.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ods/files/frames.h"
#include "ods/video/video_input.h"

namespace ods {

enum class FootageKind { kPicture, kFrames, kVideo };

class Footage {
 public:
  // A pattern (shot.####.exr) is frames, what begins as videos do or is called so is a video, all else a picture, which
  // is read when it is asked for. Throws Error(kInput): a video that cannot be read.
  Footage(const std::string& path, const FormatHint& known);

  FootageKind kind() const { return kind_; }
  const std::string& path() const { return path_; }

  // The numbers of the frames that there are, rising; of a video they count from 0, going by what it says, which may be
  // wrong; of a picture there are none. Throws Error(kInput).
  std::vector<int> frames() const;

  // The file of a frame, for messages: of a video the video's.
  std::string path_of(int frame) const;

  // The picture of a frame; nothing where there is no such frame. A single picture is that of every frame, and read
  // once. Frames of a video are asked for in rising order, those of files from any thread. Throws Error(kInput).
  std::optional<StoredPicture> picture(int frame);

  // Of a video.
  const VideoInput& video() const { return *video_; }
  const VideoStream& stream() const { return decoder_->stream(); }
  // Its next picture as it is stored, when those before `frame` were left out.
  std::optional<DecodedFrame> decode(int frame);

 private:
  std::string path_;
  FormatHint known_;
  FootageKind kind_ = FootageKind::kPicture;
  std::optional<FrameNames> names_;
  std::optional<StoredPicture> still_;
  std::optional<VideoInput> video_;
  std::unique_ptr<VideoDecoder> decoder_;
  int next_ = 0;  // frame of the video
};

}  // namespace ods

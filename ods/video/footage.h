// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A command's picture input: one picture, a file per frame, or a video.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ods/files/frames.h"
#include "ods/video/video_input.h"

namespace ods {

enum class FootageKind { kPicture, kFrames, kVideo };

// A pattern (shot.####.exr) stands for frames; a file with a video's first bytes or extension is a video; anything else
// is a picture.
FootageKind footage_kind(const std::string& path);

// A part of a video, in seconds from its first picture: the pictures that begin in it.
struct TimeSpan {
  double from = 0.0;
  std::optional<double> to;  // not set for the end

  bool is_part() const { return from > 0.0 || to; }
};

class Footage {
 public:
  // Opens an input of footage_kind(). A picture is read on demand, by `reader` if it is open already. Throws
  // Error(kInput) for a video that cannot be read.
  Footage(const std::string& path, const FormatHint& known, std::optional<PictureReader> reader = {});

  FootageKind kind() const { return kind_; }
  const std::string& path() const { return path_; }

  // The frame numbers, ascending. A video counts from 0, up to its stored length, which may be wrong; a single picture
  // has none. Throws Error(kInput).
  std::vector<int> frames() const;

  // The file of a frame, for messages; for a video, the video.
  std::string path_of(int frame) const;

  // The picture of a frame, or nullopt if there is no such frame. A single picture serves every frame and is read once.
  // Request frames of a video in ascending order; files may be requested from any thread. Throws Error(kInput).
  std::optional<StoredPicture> picture(int frame);

  // Precondition: it is a video.
  const VideoInput& video() const { return *video_; }
  const VideoStream& stream() const { return decoder_->stream(); }
  // Decodes this frame of the video, skipping those before it.
  std::optional<DecodedFrame> decode(int frame);

  // Restricts the video to this part: frames count from its first one, and next() ends with it. Precondition: no frame
  // was decoded yet.
  void choose(const TimeSpan& span);
  // The next frame of the video.
  std::optional<DecodedFrame> next();
  // Start time, in seconds from the video's first picture, independent of choose().
  double seconds_of(const DecodedFrame& frame) const;
  // The expected number of frames of the part, at least 1.
  int expected_count() const;

 private:
  std::string path_;
  FormatHint known_;
  FootageKind kind_ = FootageKind::kPicture;
  std::optional<FrameNames> names_;
  std::optional<PictureReader> reader_;
  std::optional<StoredPicture> still_;
  std::optional<VideoInput> video_;
  std::unique_ptr<VideoDecoder> decoder_;
  TimeSpan span_;
  int next_ = 0;  // number of the next frame to decode
};

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Text subtitles, encoded as another container's kind.
#pragma once
#include <memory>

#include "ods/video/container/video_file.h"
#include "ods/video/tracks/av.h"

struct AVStream;

namespace ods {

class TextTrack {
 public:
  virtual ~TextTrack() = default;
  // Sets the parameters of the new stream.
  virtual void describe(AVStream& stream) const = 0;
  // Returns a packet with the same times; null if it shows nothing. Throws Error(kInput).
  virtual av::Owned<AVPacket> encode(const AVPacket& packet) = 0;
};

// Returns null if the stream has no text that this container supports.
std::unique_ptr<TextTrack> text_track(const AVStream& from, Container container);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The sound of a video in the making, packet by packet: packed anew, or as it is in another video.
#pragma once
#include <memory>

#include "ods/video/av.h"
#include "ods/video/encode.h"

struct AVStream;

namespace ods {

class Sound {
 public:
  virtual ~Sound() = default;

  // Tells the stream what will come.
  virtual void describe(AVStream& stream) const = 0;

  // The next packet that begins before a second of the video, in the time base that it names; null: there is none yet,
  // or at the end none at all. Throws Error(kInput), Error(kOutput).
  virtual av::Owned<AVPacket> next(double until, bool is_end) = 0;
};

// Null: the video is silent. Throws Error(kInput).
std::unique_ptr<Sound> open_sound(const EncodeOptions& options, Container container);

// As libavformat calls it.
const char* format_name(Container container);

}  // namespace ods

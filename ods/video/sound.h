// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The sound of a new video, packet by packet: encoded anew, or copied from another file.
#pragma once
#include <memory>

#include "ods/video/av.h"
#include "ods/video/encode.h"

struct AVStream;

namespace ods {

class Sound {
 public:
  virtual ~Sound() = default;

  // Sets the parameters of the output stream.
  virtual void describe(AVStream& stream) const = 0;

  // The next packet that begins before `until` (seconds of the video), with its own time base; null if there is none
  // yet or, with `is_end`, none left. Throws Error(kInput), Error(kOutput).
  virtual av::Owned<AVPacket> next(double until, bool is_end) = 0;
};

// Null: the video is silent. Throws Error(kInput).
std::unique_ptr<Sound> open_sound(const EncodeOptions& options, Container container);

// libavformat's name for it.
const char* format_name(Container container);

}  // namespace ods

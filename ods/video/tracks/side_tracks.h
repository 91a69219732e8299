// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The tracks of a new video besides its pictures, packet by packet: sound that is encoded again (sound.h), tracks kept
// from an old video (kept_tracks.h).
#pragma once
#include "ods/video/tracks/av.h"

namespace ods {

class SideTracks {
 public:
  virtual ~SideTracks() = default;

  // Adds its streams, chapters and tags to a file whose header is not written yet.
  virtual void add_to(AVFormatContext& file) = 0;

  // The next packet that begins before `until` (seconds of the video), with its own time base and the index of its
  // stream in the file; null if there is none yet or, with `is_end`, none left. Throws Error(kInput), Error(kOutput).
  virtual av::Owned<AVPacket> next(double until, bool is_end) = 0;
};

}  // namespace ods

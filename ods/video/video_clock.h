// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The times of a video that is made from another's pictures.
//
// A part of a video (TimeCut::is_cut) begins with its first picture; a whole one keeps the time between the beginnings
// of picture and sound. Matroska rounds times to milliseconds; if they are the rounded times of an even rate, they are
// made exact again.
#pragma once
#include "ods/video/decode.h"

namespace ods {

class VideoClock {
 public:
  // first: time of the first picture that is used.
  VideoClock(const VideoStream& stream, const FrameTime& first, bool is_cut);

  // Sets the clock, and the start of the copied sound.
  void set(EncodeOptions& options) const;

  // The time of a picture in the new video.
  FrameTime operator()(const FrameTime& time) const;

 private:
  int64_t even(int64_t ticks) const;

  FrameRate clock_;     // clock of the new video
  double start_ = 0.0;  // start of the new video, in seconds of the old one
  int64_t zero_ = 0;    // start of the new video in the old clock's ticks
  int64_t first_ = 0;   // in the old clock's ticks
  int64_t scale_ = 1;   // new ticks per old one
  int64_t frame_ = 0;   // new ticks per frame of the even rate; 0 if times are already exact
};

}  // namespace ods

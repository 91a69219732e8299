// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a video that is made of another one's pictures keeps of it.
#pragma once
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <string>

namespace ods {

// Which part of an old video a new one is.
struct TimeCut {
  double start = 0.0;        // the time in the file at which the new video begins, in seconds
  double length = INFINITY;  // of the new video, in seconds, as far as known
  bool is_cut = false;       // what is before it, and after the end of the pictures, is dropped
};

// How the view is turned against the old one at a time of the file, in seconds: the matrix that a direction in the old
// view's frame (x right, y up, z back) is multiplied by.
using SoundTurn = std::function<glm::dmat3(double seconds)>;

// The video whose pictures are encoded anew. What else it has goes into the new one: sound, subtitles, timecode,
// chapters, tags, covers, attachments.
struct KeepOptions {
  std::string path;       // empty: nothing is kept
  uint64_t track = 0;     // of its pictures, as in video_file.h
  bool has_sound = true;  // its sound, too
  TimeCut cut;
  SoundTurn turn;  // of ambisonic sound, which is then encoded anew; none: nothing turns
  std::function<void(const std::string& words)> tell;  // what cannot be kept, one by one, and why. May be empty
};

}  // namespace ods

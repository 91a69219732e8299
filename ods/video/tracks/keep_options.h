// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The parts of an old video that a new video of its pictures keeps.
#pragma once
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <optional>
#include <string>

namespace ods {

// The part of an old video that a new one covers.
struct TimeCut {
  double start = 0.0;        // the time in the file at which the new video begins, in seconds
  double length = INFINITY;  // duration of the new video, in seconds, if known
  bool is_cut = false;       // drop the data before the start, and after the end of the pictures
};

// The rotation of the view relative to the old one at a time of the file, in seconds: the matrix that is multiplied by
// a direction in the old view's frame (x right, y up, z back).
using SoundTurn = std::function<glm::dmat3(double seconds)>;

// The video whose pictures are encoded again. Its other contents go into the new one: sound, subtitles, timecode,
// chapters, tags, covers, attachments.
struct KeepOptions {
  std::string path;                  // empty to keep nothing
  uint64_t track = 0;                // track of its pictures, as in video_file.h
  std::optional<uint64_t> joined{};  // the track whose pictures are joined to those
  bool has_sound = true;             // keep its sound, too
  TimeCut cut;
  SoundTurn turn;  // rotation of ambisonic sound, which is then encoded again; null for none
  std::function<void(const std::string& words)> tell;  // reports each loss and its reason. May be empty
};

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What changes from frame to frame of a video, of every frame and in few numbers: how much each part of each eye's
// picture differs from the frame before. From these series follow cuts, duplicate frames, and whether one eye is ahead
// of the other in time: the same motion makes the same series in both eyes, wherever parallax puts it.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "ods/lint/lint.h"
#include "ods/video/decode.h"

namespace ods {

class FrameTrace {
 public:
  // layout: of the video's frames; kSeparate: one eye.
  FrameTrace(Extent frame, Layout layout);

  // seconds: its time in the video; times ascend.
  void add(const DecodedFrame& frame, double seconds);

  // Whether the last frame that was added begins another shot, in the left or only eye.
  bool is_cut() const { return cuts_[0].size() > 0 && cuts_[0].back() == frames_ - 1; }
  int frames() const { return frames_; }

  // Judges the checks of time.
  void report(LintReport& report) const;

 private:
  static constexpr int kColumns = 64, kRows = 32;     // of the small picture of an eye
  static constexpr int kAcross = 8, kDown = 4;        // parts of it
  using Small = std::array<float, kColumns * kRows>;  // 0..1
  using Parts = std::array<float, kAcross * kDown>;
  struct Change {
    Parts parts{};       // mean absolute difference from the frame before
    float whole = 0.0f;  // their mean
    float alike = 1.0f;  // correlation with the frame before
  };

  Small small_of(const DecodedFrame& frame, int eye) const;
  static Change change_of(const Small& before, const Small& now);
  void find_cut(size_t eye);
  void check_cuts(LintReport& report) const;
  void check_duplicates(LintReport& report) const;
  void check_time(LintReport& report) const;
  std::string time_text(int frame) const;
  double correlation(int lag) const;

  Extent eye_;
  Layout layout_;
  int frames_ = 0;
  std::vector<double> times_;                 // of the frames, seconds
  std::vector<Small> last_;                   // of each eye
  std::vector<std::vector<Change>> changes_;  // of each eye: from frame i to frame i + 1
  std::vector<std::vector<int>> cuts_;        // of each eye: the first frames of shots but the first
};

}  // namespace ods

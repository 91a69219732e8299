// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What changes from frame to frame of a video, of every frame and in few numbers. From these series follow cuts,
// duplicate frames, and whether one eye is ahead of the other in time.
//
// For the last, parallax must not matter: what passes by is at each heading sooner in one eye than in the other. So
// headings are averaged. Things that move change the means of rows, and when they do is the same in both eyes. Where
// only the camera turns, means of rows stay; but then it is nearly all that changes, and how fast is the same in both.
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
  using Numbers = std::vector<float>;
  struct Change {
    float whole = 0.0f;   // mean absolute difference from the frame before
    float alike = 1.0f;   // correlation with it, along rows
    float motion = 0.0f;  // root of the mean square of what is not alike: neither light nor a fade
    Numbers bands;        // from top to bottom, the median part's root of the mean square difference
  };
  // Numbers of each eye and frame, and the frames that count.
  struct Series {
    std::array<std::vector<Numbers>, 2> eyes;
    std::vector<bool> counts;
  };

  Small small_of(const DecodedFrame& frame, int eye) const;
  static Change change_of(const Small& before, const Small& now);
  void find_cut(size_t eye);
  void check_cuts(LintReport& report) const;
  float motion_beside(int i, int way) const;
  void check_duplicates(LintReport& report) const;
  void check_time(LintReport& report) const;
  std::string time_text(int frame) const;
  std::vector<bool> count_all_but_jumps(size_t count, size_t span) const;
  Series rises() const;
  Series speeds() const;
  static double correlation(const Series& series, int lag);

  Extent eye_;
  Layout layout_;
  int frames_ = 0;
  std::vector<double> times_;                 // of the frames, seconds
  std::vector<Small> last_;                   // of each eye
  std::vector<std::vector<Numbers>> rows_;    // of each eye and frame: means
  std::vector<std::vector<Change>> changes_;  // of each eye: from frame i to frame i + 1
  std::vector<std::vector<int>> cuts_;        // of each eye: the first frames of shots but the first
};

}  // namespace ods

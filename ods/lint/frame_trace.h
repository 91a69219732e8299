// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Records the changes from frame to frame of a video, a few numbers for every frame. These series show cuts, duplicate
// frames, and a time offset between the eyes.
//
// The time offset must not depend on parallax: a moving object reaches each heading earlier in one eye than in the
// other. So headings are averaged. Moving objects change the means of rows, at the same time in both eyes. If only the
// camera turns, the means of rows stay constant; but then nearly the whole picture changes, at the same speed in both
// eyes.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "ods/lint/lint.h"
#include "ods/video/decode.h"

namespace ods {

class FrameTrace {
 public:
  // layout: of the video's frames; kSeparate for one eye.
  FrameTrace(Extent frame, Layout layout);

  // seconds: time of the frame in the video; times ascend.
  void add(const DecodedFrame& frame, double seconds);

  // Returns whether the last added frame begins another shot, in the left or only eye.
  bool is_cut() const { return cuts_[0].size() > 0 && cuts_[0].back() == frames_ - 1; }
  int frames() const { return frames_; }

  // Adds the checks of time to the report.
  void report(LintReport& report) const;

 private:
  static constexpr int kColumns = 64, kRows = 32;     // size of the small picture of an eye
  static constexpr int kAcross = 8, kDown = 4;        // its parts
  using Small = std::array<float, kColumns * kRows>;  // 0..1
  using Numbers = std::vector<float>;
  struct Change {
    float whole = 0.0f;   // mean absolute difference from the frame before
    float alike = 1.0f;   // correlation with it, along rows
    float motion = 0.0f;  // root mean square of the part that is not correlated: neither light nor a fade
    Numbers bands;        // for bands from top to bottom: root mean square difference of the median part
  };
  // Numbers per eye and frame, and the frames that count.
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
  std::vector<double> times_;                 // times of the frames, seconds
  std::vector<Small> last_;                   // per eye
  std::vector<std::vector<Numbers>> rows_;    // means, per eye and frame
  std::vector<std::vector<Change>> changes_;  // per eye: from frame i to frame i + 1
  std::vector<std::vector<int>> cuts_;        // per eye: the first frames of all shots but the first
};

}  // namespace ods

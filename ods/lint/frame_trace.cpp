// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/lint/frame_trace.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ods/lint/checks.h"

namespace ods {

namespace {

constexpr float kCutLikeness = 0.6f;  // two shots correlate by less
constexpr float kStill = 4e-4f;       // of a frame that is the one before again: what a codec adds
constexpr float kMoves = 3e-3f;       // around such a frame, if it should not be there
constexpr int kReach = 12;            // frames by which eyes may be apart in time
constexpr int kNeighbours = 6;        // frames on either side of a duplicate
constexpr size_t kEnough = 24;        // frames, to compare series

float value_at(const Planes& planes, int x, int y) {
  const std::byte* row = planes.first[0] + static_cast<size_t>(y) * planes.stride[0];
  const float most = static_cast<float>((1 << planes.bits) - 1);
  if (planes.bits == 8) return static_cast<float>(row[x]) / most;
  uint16_t value;
  std::memcpy(&value, row + 2 * static_cast<size_t>(x), sizeof(value));
  return static_cast<float>(value) / most;
}

}  // namespace

std::string FrameTrace::time_text(int frame) const {
  return fmt::format("{:.2f} s", times_[static_cast<size_t>(frame)]);
}

FrameTrace::FrameTrace(Extent frame, Layout layout) : eye_(*unpacked_size(layout, frame)), layout_(layout) {
  const size_t count = layout == Layout::kSeparate ? 1 : 2;
  last_.resize(count), changes_.resize(count), cuts_.resize(count);
}

// Each cell is the mean of 4 x 4 pixels in it.
FrameTrace::Small FrameTrace::small_of(const DecodedFrame& frame, int eye) const {
  constexpr int kPoints = 4;
  const EyeCorner corner = eye_corner(layout_, eye_, eye);
  Small small{};
  for (int i = 0; i < kColumns * kRows; i++) {
    for (int k = 0; k < kPoints * kPoints; k++) {
      const int column = (i % kColumns) * kPoints + k % kPoints, row = (i / kColumns) * kPoints + k / kPoints;
      const int x = static_cast<int>((column + 0.5) * eye_.width / (kColumns * kPoints));
      const int y = static_cast<int>((row + 0.5) * eye_.height / (kRows * kPoints));
      small[static_cast<size_t>(i)] += value_at(frame.planes, corner.x + x, corner.y + y) / (kPoints * kPoints);
    }
  }
  return small;
}

FrameTrace::Change FrameTrace::change_of(const Small& before, const Small& now) {
  Change change;
  constexpr float kCells = kColumns * kRows, kCellsOfPart = kCells / (kAcross * kDown);
  float mean = 0.0f, mean_before = 0.0f;
  for (size_t i = 0; i < now.size(); i++) {
    const size_t x = i % kColumns, y = i / kColumns;
    const float difference = std::abs(now[i] - before[i]);
    change.parts[y / (kRows / kDown) * kAcross + x / (kColumns / kAcross)] += difference / kCellsOfPart;
    change.whole += difference / kCells;
    mean += now[i] / kCells, mean_before += before[i] / kCells;
  }
  float product = 0.0f, square = 1e-6f, square_before = 1e-6f;
  for (size_t i = 0; i < now.size(); i++) {
    const float a = now[i] - mean, b = before[i] - mean_before;
    product += a * b, square += a * a, square_before += b * b;
  }
  change.alike = product / std::sqrt(square * square_before);
  return change;
}

// A cut is a change that neither frame before it had.
void FrameTrace::find_cut(size_t eye) {
  const std::vector<Change>& changes = changes_[eye];
  if (changes.empty() || changes.back().alike > kCutLikeness) return;
  const size_t last = changes.size() - 1;
  const bool is_sudden = last == 0 || changes[last].whole > 3.0f * changes[last - 1].whole;
  if (is_sudden) cuts_[eye].push_back(frames_);
}

void FrameTrace::add(const DecodedFrame& frame, double seconds) {
  for (size_t eye = 0; eye < last_.size(); eye++) {
    const Small now = small_of(frame, static_cast<int>(eye));
    if (frames_ > 0) changes_[eye].push_back(change_of(last_[eye], now));
    last_[eye] = now;
    find_cut(eye);
  }
  times_.push_back(seconds);
  frames_++;
}

// --- cuts ------------------------------------------------------------------------------------------------------------

void FrameTrace::check_cuts(LintReport& report) const {
  if (cuts_.size() < 2) return skip(report, Check::kCuts, "there is only one eye");
  if (cuts_[0].empty() && cuts_[1].empty()) return skip(report, Check::kCuts, "there are no cuts");
  judge(report, Check::kCuts);
  std::vector<std::string> apart;
  for (size_t eye = 0; eye < 2; eye++) {
    for (const int cut : cuts_[eye]) {
      const auto& other = cuts_[1 - eye];
      if (std::find(other.begin(), other.end(), cut) != other.end()) continue;
      apart.push_back(fmt::format("{} eye at {} (frame {})", eye == 0 ? "left" : "right", time_text(cut), cut));
    }
  }
  if (apart.empty()) return;
  const size_t all = cuts_[0].size() + cuts_[1].size(), count = apart.size();
  if (apart.size() > 6) apart.resize(6), apart.push_back("...");
  report.findings.push_back({Fault::kCutsDiffer, 0.9,
                             fmt::format("{} of {} cuts are in one eye only: {}", count, all, fmt::join(apart, ", ")),
                             "cut both eyes at the same frame"});
}

// --- duplicates ------------------------------------------------------------------------------------------------------

void FrameTrace::check_duplicates(LintReport& report) const {
  std::vector<int> duplicates;
  const std::vector<Change>& changes = changes_[0];
  const int count = static_cast<int>(changes.size());
  int moving = 0;
  for (int i = 0; i < count; i++) {
    int lively = 0, around = 0;
    for (int k = std::max(0, i - kNeighbours); k < std::min(count, i + kNeighbours + 1); k++) {
      around++, lively += changes[static_cast<size_t>(k)].whole > kMoves ? 1 : 0;
    }
    const bool is_moving = 2 * lively > around;
    moving += is_moving ? 1 : 0;
    const auto is_still = [&](const std::vector<Change>& eye) { return eye[static_cast<size_t>(i)].whole < kStill; };
    if (is_moving && std::all_of(changes_.begin(), changes_.end(), is_still)) duplicates.push_back(i + 1);
  }
  if (moving == 0) return skip(report, Check::kDuplicates, "nothing moves");
  judge(report, Check::kDuplicates);
  if (duplicates.empty()) return;
  std::vector<std::string> times;
  for (size_t i = 0; i < std::min<size_t>(6, duplicates.size()); i++) times.push_back(time_text(duplicates[i]));
  report.findings.push_back(
      {Fault::kDuplicateFrames, 0.9,
       fmt::format("{} of {} moving frames show what the frame before them did, at {}{}", duplicates.size(), moving,
                   fmt::join(times, ", "), duplicates.size() > times.size() ? ", ..." : ""),
       "render or record at the rate of the video, and encode every frame once"});
}

// --- time between the eyes -------------------------------------------------------------------------------------------

// Of the left eye's changes with the right eye's this many frames later. The root lets no cut decide alone.
double FrameTrace::correlation(int lag) const {
  const int count = static_cast<int>(changes_[0].size());
  const int from = std::max(0, -lag), to = std::min(count, count - lag);
  double product = 0.0, square = 1e-12, square_other = 1e-12;
  for (size_t part = 0; part < Parts().size(); part++) {
    const auto value = [&](size_t eye, int i) {
      return std::sqrt(static_cast<double>(changes_[eye][static_cast<size_t>(i)].parts[part]));
    };
    double mean = 0.0, mean_other = 0.0;
    for (int i = from; i < to; i++) mean += value(0, i) / (to - from), mean_other += value(1, i + lag) / (to - from);
    for (int i = from; i < to; i++) {
      const double a = value(0, i) - mean, b = value(1, i + lag) - mean_other;
      product += a * b, square += a * a, square_other += b * b;
    }
  }
  return product / std::sqrt(square * square_other);
}

void FrameTrace::check_time(LintReport& report) const {
  if (changes_.size() < 2) return skip(report, Check::kEyeTime, "there is only one eye");
  if (changes_[0].size() < kEnough) return skip(report, Check::kEyeTime, "the video is too short");
  int best = 0;
  double most = correlation(0);
  for (int lag = -kReach; lag <= kReach; lag++) {
    if (correlation(lag) > most) most = correlation(lag), best = lag;
  }
  if (most < 0.5) return skip(report, Check::kEyeTime, "nothing moves unevenly enough");
  judge(report, Check::kEyeTime);
  const double here = correlation(0);
  const double certainty = std::clamp((most - 0.4) / 0.3, 0.0, 1.0) * std::clamp((most - here) / 0.2, 0.0, 1.0);
  if (best == 0 || certainty < 0.1) return;
  report.findings.push_back(
      {Fault::kEyeLate, certainty,
       fmt::format(
           "motion is seen {} frames ({:.3f} s) {} by the right eye than by the left one: changes correlate by {:.2f} "
           "then, and by {:.2f} at the same frame",
           std::abs(best), std::abs(best) * (times_.back() - times_.front()) / (frames_ - 1),
           best > 0 ? "later" : "earlier", most, here),
       fmt::format("drop the first {} frames of the {} eye's video before the eyes are put together", std::abs(best),
                   best > 0 ? "right" : "left")});
}

void FrameTrace::report(LintReport& report) const {
  check_time(report);
  check_cuts(report);
  check_duplicates(report);
}

}  // namespace ods

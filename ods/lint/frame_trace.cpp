// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/lint/frame_trace.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "ods/base/median.h"
#include "ods/lint/checks.h"

namespace ods {

namespace {

constexpr float kCutLikeness = 0.6f;  // maximum correlation of two shots
constexpr float kStill = 4e-4f;       // difference of a repeated frame, due to the codec
constexpr float kMoves = 8e-3f;       // motion around a repeated frame that should not be there
constexpr int kReachInTime = 12;      // maximum delay between the eyes, frames
constexpr int kNeighbours = 3;        // frames on either side of a duplicate
constexpr size_t kEnoughFrames = 24;  // minimum number of frames for comparing series
constexpr size_t kPairs = 16;         // minimum number of counted pairs at a lag
constexpr size_t kBesideJump = 3;     // frames on either side of a jump that change by a third at most
constexpr size_t kAfterJump = 6;      // frames after a jump that a codec needs to recover
constexpr float kTurns = 0.01f;       // minimum of Change::bands if the camera turns

float value_at(const Planes& planes, int x, int y) {
  const std::byte* row = planes.first[0] + static_cast<size_t>(y) * planes.stride[0];
  const float maximum = static_cast<float>((1 << planes.bits) - 1);
  if (planes.bits == 8) return static_cast<float>(row[x]) / maximum;
  uint16_t value;
  std::memcpy(&value, row + 2 * static_cast<size_t>(x), sizeof(value));
  return static_cast<float>(value) / maximum;
}

}  // namespace

std::string FrameTrace::time_text(int frame) const {
  return fmt::format("{:.2f} s", times_[static_cast<size_t>(frame)]);
}

FrameTrace::FrameTrace(Extent frame, Layout layout) : eye_(*unpacked_size(layout, frame)), layout_(layout) {
  const size_t count = layout == Layout::kSeparate ? 1 : 2;
  last_.resize(count), rows_.resize(count), changes_.resize(count), cuts_.resize(count);
}

static std::vector<float> row_means(std::span<const float> cells, size_t columns) {
  std::vector<float> means(cells.size() / columns);
  for (size_t i = 0; i < cells.size(); i++) means[i / columns] += cells[i] / static_cast<float>(columns);
  return means;
}

// Each cell is the mean of 4 x 4 of its pixels.
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
  std::array<Numbers, kDown> parts;
  parts.fill(Numbers(kAcross));
  for (size_t i = 0; i < now.size(); i++) {
    const size_t x = i % kColumns, y = i / kColumns;
    const float difference = std::abs(now[i] - before[i]);
    parts[y / (kRows / kDown)][x / (kColumns / kAcross)] += difference * difference / kCellsOfPart;
    change.whole += difference / kCells;
  }
  for (const Numbers& band : parts) change.bands.push_back(std::sqrt(median(band)));
  // Without the means of rows, because most shots are bright above and dark below.
  const Numbers means = row_means(now, kColumns), means_before = row_means(before, kColumns);
  float product = 0.0f, square = 1e-6f, square_before = 1e-6f;
  for (size_t i = 0; i < now.size(); i++) {
    const float a = now[i] - means[i / kColumns], b = before[i] - means_before[i / kColumns];
    product += a * b, square += a * a, square_before += b * b;
  }
  change.alike = product / std::sqrt(square * square_before);
  change.motion = std::sqrt(square * std::max(0.0f, 1.0f - change.alike * change.alike) / kCells);
  return change;
}

// A cut is a change to an uncorrelated frame that is much larger than the change before it.
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
    rows_[eye].push_back(row_means(now, kColumns));
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

// The motion just before (-1) or after (1) a change. Returns 0 if motion comes to rest there or pauses.
float FrameTrace::motion_beside(int i, int way) const {
  const int count = static_cast<int>(changes_[0].size());
  float nearest = 0.0f, maximum = 0.0f;
  for (int k = i + way; k >= 0 && k < count && std::abs(k - i) <= kNeighbours; k += way) {
    const float change = changes_[0][static_cast<size_t>(k)].motion;
    if (nearest < kMoves / 8.0f) nearest = change;
    maximum = std::max(maximum, change);
  }
  return nearest >= 0.6f * maximum ? maximum : 0.0f;
}

void FrameTrace::check_duplicates(LintReport& report) const {
  std::vector<int> duplicates;
  int moving = 0;
  for (int i = 0; i < static_cast<int>(changes_[0].size()); i++) {
    const float motion = std::min(motion_beside(i, -1), motion_beside(i, 1));
    if (motion < kMoves) continue;
    moving++;
    const auto is_still = [&](const std::vector<Change>& eye) {
      return eye[static_cast<size_t>(i)].whole < std::min(kStill, motion / 8.0f);
    };
    if (std::all_of(changes_.begin(), changes_.end(), is_still)) duplicates.push_back(i + 1);
  }
  if (moving == 0) return skip(report, Check::kDuplicates, "nothing moves, or too little");
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

// Leaves out jumps, such as at cuts and in lightning, and the frames in which codecs recover from them. One value spans
// `span` changes.
std::vector<bool> FrameTrace::count_all_but_jumps(size_t count, size_t span) const {
  std::vector<bool> counts(count, true);
  for (const std::vector<Change>& changes : changes_) {
    for (size_t i = 0; i < changes.size(); i++) {
      float beside = 0.0f;
      for (size_t k = i - std::min(i, kBesideJump); k < std::min(i + kBesideJump + 1, changes.size()); k++) {
        if (k != i) beside = std::max(beside, changes[k].whole);
      }
      if (changes[i].whole <= 3.0f * beside) continue;
      for (size_t k = i - std::min(i, span - 1); k < std::min(i + kAfterJump, count); k++) counts[k] = false;
    }
  }
  return counts;
}

// The change of the row means within several frames, so many that codec artifacts in every second frame do not count.
FrameTrace::Series FrameTrace::rises() const {
  constexpr size_t kSpan = 4;
  Series series;
  for (size_t eye = 0; eye < 2; eye++) {
    for (size_t i = 0; i + kSpan < rows_[eye].size(); i++) {
      Numbers& rise = series.eyes[eye].emplace_back(rows_[eye][i + kSpan]);
      for (size_t row = 0; row < rise.size(); row++) rise[row] -= rows_[eye][i][row];
    }
  }
  series.counts = count_all_but_jumps(series.eyes[0].size(), kSpan);
  return series;
}

// The speed at which the whole picture changes.
FrameTrace::Series FrameTrace::speeds() const {
  Series series;
  float maximum = 0.0f;
  for (size_t eye = 0; eye < 2; eye++) {
    for (const Change& change : changes_[eye]) {
      series.eyes[eye].push_back(change.bands);
      maximum = std::max(maximum, *std::max_element(change.bands.begin(), change.bands.end()));
    }
  }
  series.counts = maximum < kTurns ? std::vector<bool>(series.eyes[0].size(), false)
                                   : count_all_but_jumps(series.eyes[0].size(), 1);
  return series;
}

// The correlation of the left eye's series with the right eye's, this many frames later.
double FrameTrace::correlation(const Series& series, int lag) {
  const int count = static_cast<int>(series.counts.size());
  std::vector<std::pair<const Numbers*, const Numbers*>> pairs;
  for (int i = std::max(0, -lag); i < std::min(count, count - lag); i++) {
    const size_t left = static_cast<size_t>(i), right = static_cast<size_t>(i + lag);
    if (series.counts[left] && series.counts[right]) pairs.emplace_back(&series.eyes[0][left], &series.eyes[1][right]);
  }
  if (pairs.size() < kPairs) return 0.0;
  double product = 0.0, square = 1e-12, square_other = 1e-12;
  for (size_t row = 0; row < pairs[0].first->size(); row++) {
    double mean = 0.0, mean_other = 0.0;
    for (const auto& [one, other] : pairs) mean += double{(*one)[row]}, mean_other += double{(*other)[row]};
    mean /= static_cast<double>(pairs.size()), mean_other /= static_cast<double>(pairs.size());
    for (const auto& [one, other] : pairs) {
      const double a = double{(*one)[row]} - mean, b = double{(*other)[row]} - mean_other;
      product += a * b, square += a * a, square_other += b * b;
    }
  }
  return product / std::sqrt(square * square_other);
}

void FrameTrace::check_time(LintReport& report) const {
  if (changes_.size() < 2) return skip(report, Check::kEyeTime, "there is only one eye");
  if (changes_[0].size() < kEnoughFrames) return skip(report, Check::kEyeTime, "the video is too short");
  int best = 0;
  double maximum = 0.0, here = 0.0;
  for (const Series& series : {rises(), speeds()}) {
    if (maximum >= 0.7) break;
    best = 0, here = maximum = correlation(series, 0);
    for (int lag = -kReachInTime; lag <= kReachInTime; lag++) {
      const double alike = correlation(series, lag);
      if (alike > maximum) maximum = alike, best = lag;
    }
  }
  if (maximum < 0.6) return skip(report, Check::kEyeTime, "nothing moves unevenly enough");
  judge(report, Check::kEyeTime);
  const double better = (maximum - here) / (1.0 - here);
  const double certainty = std::clamp((maximum - 0.4) / 0.3, 0.0, 1.0) * std::clamp(better / 0.2, 0.0, 1.0);
  if (best == 0 || certainty < 0.1) return;
  report.findings.push_back(
      {Fault::kEyeLate, certainty,
       fmt::format(
           "motion is seen {} frames ({:.3f} s) {} by the right eye than by the left one: changes correlate by {:.2f} "
           "then, and by {:.2f} at the same frame",
           std::abs(best), std::abs(best) * (times_.back() - times_.front()) / (frames_ - 1),
           best > 0 ? "later" : "earlier", maximum, here),
       fmt::format("drop the first {} frames of the {} eye's video before the eyes are put together", std::abs(best),
                   best > 0 ? "right" : "left")});
}

void FrameTrace::report(LintReport& report) const {
  check_time(report);
  check_cuts(report);
  check_duplicates(report);
}

}  // namespace ods

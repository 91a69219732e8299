// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/video_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace ods {

VideoClock::VideoClock(const VideoStream& stream, const FrameTime& first, bool is_cut)
    : clock_(stream.clock), first_(first.start) {
  zero_ = is_cut ? first.start : std::llround(stream.file_start * stream.clock.value());
  start_ = static_cast<double>(zero_) / stream.clock.value();
  const int kFine = 10000;  // ticks per second: rounding to them is imperceptible
  if (stream.clock.seconds != 1 || stream.clock.count >= kFine) return;
  // The coarsest clock that can express both the old ticks and the frames of an even rate.
  const int64_t ticks = std::lcm(int64_t{stream.clock.count}, int64_t{stream.rate.count});
  if (ticks > 10'000'000) return;
  scale_ = ticks / stream.clock.count;
  frame_ = ticks / stream.rate.count * stream.rate.seconds;
  clock_ = {static_cast<int>(ticks), 1};
}

void VideoClock::set(EncodeOptions& options) const {
  options.clock = clock_;
  options.keep.cut.start = start_;
}

int64_t VideoClock::even(int64_t ticks) const {
  if (frame_ == 0) return ticks;
  const int64_t near = (ticks + frame_ / 2) / frame_ * frame_;
  return std::abs(near - ticks) <= scale_ ? near : ticks;
}

FrameTime VideoClock::operator()(const FrameTime& time) const {
  const int64_t before = (first_ - zero_) * scale_;
  const int64_t start = even((time.start - first_) * scale_),
                end = even((time.start + time.duration - first_) * scale_);
  return {before + start, std::max<int64_t>(end - start, 1)};
}

}  // namespace ods

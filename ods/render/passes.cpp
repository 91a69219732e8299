// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/passes.h"

#include <algorithm>
#include <cmath>

namespace ods {

// A pass may take this fraction of the remaining time, because its samples may take longer than before.
static constexpr double kShareOfTime = 0.9;

// Rounds up to a multiple of the number of first rays that devices trace at once. Passes grow from there, so that the
// samples of an interrupted rendering soon cover the whole picture.
static int whole_packets(int samples) {
  constexpr int kPacket = 16;
  return std::max((samples + kPacket - 1) / kPacket, 1) * kPacket;
}

int fewest_samples(const RenderOptions& options) {
  const int fewest = static_cast<int>(std::ceil(16.0 / std::pow(static_cast<double>(options.noise), 0.3)));
  return std::min(std::max(fewest, 4), options.samples);
}

Passes::Passes(const RenderOptions& options, int done)
    : options_(options),
      end_(samples_of_part(options).end),
      begun_with_(done),
      done_(done),
      expected_(options.noise > 0.0f ? std::min(2 * fewest_samples(options), options.samples)
                                     : samples_of_part(options).end) {}

bool Passes::can_judge() const {
  return options_.noise > 0.0f && done_ >= fewest_samples(options_);
}

int Passes::next_step(double seconds) {
  const bool limited = options_.time_limit > 0.0;
  step_ = end_ - done_;
  if (options_.noise > 0.0f && done_ < fewest_samples(options_)) step_ = fewest_samples(options_) - done_;
  if (can_judge()) step_ = expected_ > done_ ? std::min(step_, whole_packets(done_ / 4)) : 0;
  step_ = std::min(step_, whole_packets(done_ - samples_of_part(options_).begin));
  if (limited && done_ == begun_with_) step_ = std::min(step_, 1);
  if (limited && done_ > begun_with_) {
    const double affordable = kShareOfTime * (options_.time_limit - seconds) / seconds_per_sample_;
    late_ = step_ > 0 && affordable < 1.0;
    step_ = std::min({step_, std::max(done_, 1), static_cast<int>(std::clamp(affordable, 0.0, 1e9))});
  }
  return step_;
}

void Passes::finish_step(double seconds) {
  seconds_per_sample_ = std::max(seconds / step_, 1e-9);
  done_ += step_;
}

void Passes::expect(double more) {
  expected_ = std::min(done_ * (1.0 + more), static_cast<double>(end_));
}

double Passes::fraction(double part, double seconds) {
  const double begin = samples_of_part(options_).begin;
  const double end = std::max(expected_, static_cast<double>(done_ + step_));
  double now = (done_ + part * step_ - begin) / std::max(end - begin, 1.0);
  if (options_.time_limit > 0.0) now = std::max(now, std::min(seconds / options_.time_limit, 1.0));
  shown_ = std::max(shown_, now);
  return shown_;
}

}  // namespace ods

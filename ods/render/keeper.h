// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Stores the samples of a long rendering at intervals, if the caller wants them.
#pragma once
#include <algorithm>
#include <chrono>
#include <functional>

#include "ods/render/picture_samples.h"

namespace ods {

using KeepSamples = std::function<void(const PictureSamples& samples)>;

// The clock starts with the object.
class Keeper {
 public:
  // keep: may be empty. It must outlive this object.
  explicit Keeper(const KeepSamples& keep) : keep_(keep) {}

  bool wanted() const { return static_cast<bool>(keep_); }
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  void keep(const PictureSamples& samples) {
    const double began = seconds();
    if (keep_) keep_(samples);
    kept_ = seconds();
    took_ = kept_ - began;
  }

  // Returns whether the last time was 25 seconds ago, or ten times as long as storing took.
  bool is_due() const {
    constexpr double kKeepSeconds = 25.0;
    return seconds() - kept_ > std::max(kKeepSeconds, 10.0 * took_);
  }

 private:
  const KeepSamples& keep_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double kept_ = 0.0;
  double took_ = 0.0;
};

}  // namespace ods

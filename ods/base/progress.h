// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Progress reports and cancellation of long calls.
#pragma once
#include <functional>

namespace ods {

struct Progress {
  // Called from any thread, but never concurrently, with the fraction done, 0..1. May be empty.
  std::function<void(double done)> report;
  // Polled often, from any thread. Returning true makes the call throw Error(kCancelled) soon. May be empty.
  std::function<bool()> cancelled;
};

// The progress of a part of a call: its report maps 0..1 to from..to of the whole, which must outlive the part.
inline Progress part_of(const Progress& whole, double from, double to) {
  Progress part = whole;
  if (whole.report) part.report = [&whole, from, to](double done) { whole.report(from + (to - from) * done); };
  return part;
}

}  // namespace ods

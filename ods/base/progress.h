// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How a long call tells its caller where it is, and learns that it should stop.
#pragma once
#include <functional>

namespace ods {

struct Progress {
  // Called with the share done, 0..1, never twice at once, from any thread; may be empty.
  std::function<void(double done)> report;
  // Asked often and from any thread; true makes the call throw Error(kCancelled) soon. May be empty.
  std::function<bool()> cancelled;
};

}  // namespace ods

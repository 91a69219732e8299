// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The time that a graphics card spends in the stages of rendering.
#pragma once

namespace ods {

// Seconds that the stages took by the device's clock; 0 if it has none.
struct GpuTimes {
  double trace = 0.0;
  double begin = 0.0;
  double shade = 0.0;
  double all() const { return trace + begin + shade; }
};

}  // namespace ods

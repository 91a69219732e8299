// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Width and height in pixels.
#pragma once

namespace ods {

struct Extent {
  int width = 0;
  int height = 0;
};

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/render_options.h"

#include "ods/kernel/camera/camera.h"

namespace ods {

std::vector<int> eye_list(Eyes eyes) {
  switch (eyes) {
    case Eyes::kBothEyes:
      return {kLeft, kRight};
    case Eyes::kLeftEye:
      return {kLeft};
    case Eyes::kRightEye:
      return {kRight};
    case Eyes::kMonoEye:
      return {kMono};
  }
  return {};
}

}  // namespace ods

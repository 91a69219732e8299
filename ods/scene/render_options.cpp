// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/render_options.h"

#include "ods/kernel/camera/camera.h"

namespace ods {

std::string_view eyes_name(Eyes eyes) {
  switch (eyes) {
    case Eyes::kBothEyes:
      return "both";
    case Eyes::kLeftEye:
      return "left";
    case Eyes::kRightEye:
      return "right";
    case Eyes::kMonoEye:
      return "mono";
  }
  return {};
}

std::vector<int> eyes_of(Eyes eyes) {
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

std::string_view pixel_filter_name(PixelFilter filter) {
  switch (filter) {
    case PixelFilter::kBlackmanHarris:
      return "blackman-harris";
    case PixelFilter::kBox:
      return "box";
  }
  return {};
}

}  // namespace ods

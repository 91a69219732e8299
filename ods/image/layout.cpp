// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/layout.h"

#include <cassert>

#include "ods/kernel/camera/camera.h"

namespace ods {

std::string_view layout_name(Layout layout) {
  switch (layout) {
    case Layout::kTopBottom:
      return "top-bottom";
    case Layout::kSideBySide:
      return "side-by-side";
    case Layout::kSeparate:
      return "separate";
    case Layout::kMultiview:
      return "multiview";
  }
  return {};
}

Extent packed_size(Layout layout, Extent eye, int eye_count) {
  if (layout == Layout::kTopBottom) return {eye.width, eye.height * eye_count};
  if (layout == Layout::kSideBySide) return {eye.width * eye_count, eye.height};
  return eye;
}

std::vector<EyeRow> packed_row(Layout layout, Extent eye, int eye_count, int y) {
  assert(y >= 0 && y < packed_size(layout, eye, eye_count).height);
  if (layout == Layout::kTopBottom) return {{y / eye.height, y % eye.height}};
  std::vector<EyeRow> row{{0, y}};
  if (layout == Layout::kSideBySide && eye_count == 2) row.push_back({1, y});
  return row;
}

std::string_view eye_name(int eye) {
  return eye == kLeft ? "left" : eye == kRight ? "right" : "mono";
}

static const std::string_view kEyePatterns[] = {"%V", "%v"};

bool names_eye(const std::string& path) {
  for (std::string_view pattern : kEyePatterns) {
    if (path.find(pattern) != std::string::npos) return true;
  }
  return false;
}

std::string path_for_eye(const std::string& path, int eye) {
  std::string result = path;
  for (std::string_view pattern : kEyePatterns) {
    const std::string_view word = eye_name(eye).substr(0, pattern == "%V" ? std::string_view::npos : 1);
    for (size_t at = result.find(pattern); at != std::string::npos; at = result.find(pattern, at + word.size())) {
      result.replace(at, pattern.size(), word);
    }
  }
  return result;
}

}  // namespace ods

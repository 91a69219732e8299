// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/correct.h"

#include <algorithm>

#include "ods/convert/panorama.h"

namespace ods {

static bool is_right(const StoredPicture& picture, int eye) {
  return picture.eyes[static_cast<size_t>(eye_index(picture, eye))].eye == kRight;
}

std::string correction_fault(const StoredPicture& picture, const ConvertTarget& target) {
  if (target.right == EyeCorrection()) return "";
  if (!is_right(picture, kRight)) return "the picture has no right eye that could be corrected";
  const bool moves_eyes = target.eyes[0] != kMono && !same_eyes(picture.camera, target.camera);
  if (moves_eyes) return "correct its right eye first, and move its eyes in a second step";
  return "";
}

bool corrects_colors(const StoredPicture& picture, const ConvertTarget& target, int index) {
  const int eye = target.eyes[static_cast<size_t>(index)];
  return changes_colors(target.right) && is_right(picture, eye == kMono ? target.mono_from : eye);
}

void correct_colors(const EyeCorrection& correction, size_t channels, std::span<float> pixels) {
  for (size_t i = 0; i < pixels.size(); i += channels) {
    const vec3 light = corrected_color(correction, max(vec3(pixels[i], pixels[i + 1], pixels[i + 2]), vec3(0.0f)));
    std::copy_n(&light.x, 3, &pixels[i]);
  }
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/stored_lenses.h"

#include <fmt/format.h>

#include <algorithm>

#include "ods/base/error.h"
#include "ods/files/read_file.h"

namespace ods {

FisheyeLens inscribed_lens(Extent eye, float fov) {
  FisheyeLens lens;
  lens.center = 0.5f * vec2(static_cast<float>(eye.width), static_cast<float>(eye.height));
  lens.radius = std::min(lens.center.x, lens.center.y);
  lens.fov = fov;
  return lens;
}

// Computes each eye's position inside the bars that surround all of them.
static void take_bars(StoredPicture& picture, const Bars& bars) {
  const EyePacking how = arrangement_of(picture.layout).how;
  const int across = how == EyePacking::kBeside ? 2 : 1, down = how == EyePacking::kStacked ? 2 : 1;
  const Extent eye = picture.size;
  const Extent left{(across * eye.width - bars.left - bars.right) / across,
                    (down * eye.height - bars.top - bars.bottom) / down};
  const vec2 whole(static_cast<float>(eye.width), static_cast<float>(eye.height));
  picture.maps.clear();
  for (int i = 0; i < static_cast<int>(picture.eyes.size()); i++) {
    const EyeCorner own = eye_corner(picture.layout, eye, i), inner = eye_corner(picture.layout, left, i);
    const vec2 corner(static_cast<float>(bars.left + inner.x - own.x), static_cast<float>(bars.top + inner.y - own.y));
    const vec2 size(static_cast<float>(left.width), static_cast<float>(left.height));
    picture.maps.push_back(make_map(picture.camera.projection, PicturePart{corner / whole, size / whole}));
  }
}

void take_lenses(StoredPicture& picture, const FormatHint& known, Extent shown, const std::string& path) {
  constexpr float kUsualFov = 195.0f;  // usual value of cameras that look ahead and back
  if (known.bars.any()) return take_bars(picture, known.bars);
  if (known.lenses.empty() && !known.front_and_back) return;
  if (known.front_and_back && (picture.eyes.size() != 2 || !arrangement_of(picture.layout).is_halves())) {
    throw cannot_read(path, "fisheyes that look ahead and back are two halves: `layout` side-by-side or top-bottom");
  }
  std::vector<FisheyeLens> lenses = known.lenses;
  if (lenses.empty()) lenses.push_back(inscribed_lens(shown, kUsualFov));
  lenses.resize(picture.eyes.size(), lenses[0]);
  if (known.front_and_back) lenses[1].yaw += 180.0f;
  picture.maps.clear();
  for (const FisheyeLens& lens : lenses) {
    if (const std::string fault = lens_fault(lens, shown); !fault.empty()) throw cannot_read(path, fault);
    picture.maps.push_back(make_map(lens, shown));
  }
  picture.front_and_back = known.front_and_back;
  picture.camera.projection = find_projection(known.front_and_back ? "lat-long" : "vr180")->setting;
  for (StoredEye& eye : picture.eyes) eye.eye = known.front_and_back ? kMono : eye.eye;
}

}  // namespace ods

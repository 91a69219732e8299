// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/formats.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "ods/base/json_reader.h"
#include "ods/base/quote.h"
#include "ods/camera/projection.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/tone.h"
#include "ods/view/camera_json.h"

namespace ods {

std::array<double, 4> eye_part(Layout layout, int eye_count, int index) {
  const Extent eye{2, 2}, whole = packed_size(layout, eye, eye_count);
  const EyeCorner corner = eye_count == 1 ? EyeCorner() : eye_corner(layout, eye, index);
  const auto part = [](int n, int of) { return static_cast<double>(n) / of; };
  return {part(corner.x, whole.width), part(corner.y, whole.height), part(eye.width, whole.width),
          part(eye.height, whole.height)};
}

static Json layouts() {
  Json list = Json::array();
  const Json whole = eye_part(Layout::kSeparate, 1, 0);
  list.push_back({{"name", "mono"}, {"left", whole}, {"right", whole}});
  for (const Layout layout : kLayouts) {
    if (!arrangement_of(layout).is_halves()) continue;
    list.push_back(
        {{"name", layout_name(layout)}, {"left", eye_part(layout, 2, 0)}, {"right", eye_part(layout, 2, 1)}});
  }
  return list;
}

static Json projections() {
  Json list = Json::array();
  for (const NamedProjection& named : named_projections()) {
    StereoCamera camera;
    camera.projection = named.setting;
    list.push_back({{"name", named.name}, {"summary", named.summary}, {"camera", camera_json(make_camera(camera))}});
  }
  return list;
}

std::string formats_module() {
  Json tones = Json::array();
  for (const ToneCurve tone : kToneCurves) tones.push_back(tone_curve_name(tone));
  return fmt::format("export const LAYOUTS = {};\nexport const PROJECTIONS = {};\nexport const TONES = {};\n",
                     json_document(layouts()), json_document(projections()), json_document(tones));
}

}  // namespace ods

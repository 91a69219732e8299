// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "ods/camera/direction_map.h"
#include "ods/camera/projection.h"

namespace ods {

std::string lens_fault(const FisheyeLens& lens, Extent picture) {
  const float width = static_cast<float>(picture.width), height = static_cast<float>(picture.height);
  if (!std::isfinite(lens.center.x) || !std::isfinite(lens.center.y) || !(lens.radius >= 2.0f) ||
      !(lens.radius <= 4.0f * std::max(width, height))) {
    return fmt::format("an image circle has a radius of 2 pixels to four times the picture's longer side, not {:g}",
                       lens.radius);
  }
  ProjectionSetting whole;
  whole.kind = lens.kind, whole.fov = lens.fov;
  if (const std::string fault = projection_fault(whole); !fault.empty()) return fault;
  if (!(lens.center.x >= 0.0f && lens.center.x <= width && lens.center.y >= 0.0f && lens.center.y <= height)) {
    return fmt::format("the middle of the image circle, {:g},{:g}, is outside the eye's picture of {}x{} pixels",
                       lens.center.x, lens.center.y, picture.width, picture.height);
  }
  return {};
}

namespace {

class LensMap final : public DirectionMap {
 public:
  LensMap(const FisheyeLens& lens, Extent picture)
      : half_(glm::radians(0.5f * lens.fov)),
        size_(static_cast<float>(picture.width), static_cast<float>(picture.height)),
        center_(lens.center / size_),
        radius_(lens.radius / size_.x, lens.radius / size_.y) {
    curve_.kind = lens.kind, curve_.angle = 2.0f * half_;
    const auto radians = [](float degrees) { return glm::radians(static_cast<double>(degrees)); };
    const auto axes = orientation(radians(lens.yaw), radians(lens.pitch), radians(lens.roll));
    right_ = vec3(axes[0]), up_ = vec3(axes[1]), back_ = vec3(axes[2]);
  }

  ImagePoint place(vec3 direction) const override {
    const vec2 across(dot(direction, right_), dot(direction, up_));
    const float off = length(across), angle = angle_of(direction);
    const float r = fisheye_radius(curve_, angle);
    const vec2 way = off > 0.0f ? across / off : vec2(1.0f, 0.0f);
    ImagePoint point;
    point.uv = center_ + radius_ * r * vec2(way.x, -way.y);
    point.seen = angle <= half_ && inside_picture(point.uv);
    return point;
  }

  float inside(vec3 direction) const override { return half_ - angle_of(direction); }

 private:
  float angle_of(vec3 direction) const {
    return atan(length(vec2(dot(direction, right_), dot(direction, up_))), -dot(direction, back_));
  }

  Projection curve_{};  // kind and angle alone
  float half_;
  vec2 size_, center_, radius_;
  vec3 right_, up_, back_;
};

}  // namespace

std::shared_ptr<const DirectionMap> make_map(const FisheyeLens& lens, Extent picture) {
  return std::make_shared<LensMap>(lens, picture);
}

double pixels_per_radian(const DirectionMap& map, Extent picture, vec3 ahead) {
  const float step = 0.01f;  // radians to either side
  const vec3 up(0.0f, 1.0f, 0.0f), right = normalize(cross(ahead, up));
  const ImagePoint a = map.place(ahead - step * right), b = map.place(ahead + step * right);
  if (!a.seen || !b.seen) return 0.0;
  const vec2 moved = (b.uv - a.uv) * vec2(static_cast<float>(picture.width), static_cast<float>(picture.height));
  return static_cast<double>(length(moved)) / (2.0 * std::atan(static_cast<double>(step)));
}

}  // namespace ods

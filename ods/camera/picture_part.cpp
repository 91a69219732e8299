// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/direction_map.h"

namespace ods {

namespace {

class PartMap final : public DirectionMap {
 public:
  PartMap(const Projection& projection, const PicturePart& part) : projection_(projection), part_(part) {}

  ImagePoint place(vec3 direction) const override {
    ImagePoint point = place_of(projection_, normalize(direction));
    point.seen = point.seen && inside_picture(point.uv);
    point.uv = part_.corner + point.uv * part_.size;
    return point;
  }

  float inside(vec3 /*direction*/) const override { return kPi; }

 private:
  Projection projection_;
  PicturePart part_;
};

}  // namespace

std::shared_ptr<const DirectionMap> make_map(const ProjectionSetting& projection, const PicturePart& part) {
  return std::make_shared<PartMap>(make_projection(projection), part);
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Maps the pixels of a conversion's target to positions in the picture.
#pragma once
#include <optional>
#include <vector>

#include "ods/convert/convert.h"
#include "ods/convert/panorama.h"

namespace ods {

struct WeightedPlace {
  Place place;
  float weight = 0.0f;
};

// Maps the target's pixels to positions in the source.
struct Mapping {
  StereoCamera stereo;  // owns the maps that `camera` reads
  Source source;
  Camera camera;  // the target's, with its centre at 0
  Extent size;
  std::vector<int> eyes;
  std::vector<int> from;          // for each eye of the target, the index in StoredPicture::eyes of its source
  std::optional<glm::mat3> turn;  // rotates rays in the world to undo ConvertTarget::turned; not set for no rotation

  // uv may be outside the cell of `home`, where the target's own filter reaches.
  Place find(int index, vec2 home, vec2 uv) const;

  // For dual-fisheye cameras: the same point in the other lens, and the weight of that lens in the blend (below 0.5).
  // The weight is 0 outside the overlap and for all other pictures.
  WeightedPlace other_lens(int index, vec2 home, vec2 uv) const;
  // The target's ray in the source's world: relative to the circle's centre, turned.
  Ray ray_of(int index, vec2 home, vec2 uv) const {
    const Ray ray = camera_ray(camera, eyes[static_cast<size_t>(index)], home, uv, vec2(0.0f));
    return turn ? Ray{*turn * ray.origin, *turn * ray.direction} : ray;
  }
  vec2 uv_of(float x, float y) const {
    return {x / static_cast<float>(size.width), y / static_cast<float>(size.height)};
  }
  Cell cell_at(int x, int y) const {
    return cell_of(camera.projection, size, {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
  }
  Cell source_cell(const Place& place) const {
    return cell_of(source.camera.projection, source.picture->size, place.at);
  }
  vec2 home_of(int x, int y) const { return uv_of(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f); }
  // Returns whether the target has a picture at this pixel: fisheyes have empty corners.
  bool wants(int x, int y) const {
    return !has_image_circle(camera.projection.kind) || look_of(camera.projection, home_of(x, y), home_of(x, y)).seen;
  }
};

// Makes the mapping. The picture, of which only the format is used, must outlive it and must not move.
Mapping make_mapping(const StoredPicture& picture, const ConvertTarget& target);

// Returns whether ConvertTarget::turned is a rotation at all.
bool is_turned(const ConvertTarget& target);

}  // namespace ods

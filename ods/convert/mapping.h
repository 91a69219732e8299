// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the target of a conversion looks in the picture, pixel by pixel.
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

// Maps the target's pixels to places in the source.
struct Mapping {
  StereoCamera stereo;  // owns the maps that `camera` reads
  Source source;
  Camera camera;  // of the target, with its centre at 0
  Extent size;
  std::vector<int> eyes;
  std::vector<int> from;          // for each eye of the target: its index in the source
  std::optional<glm::mat3> turn;  // from the world to the world as the source's camera saw it

  // uv may be outside the cell of `home`: the target's own filter reaches there.
  Place find(int index, vec2 home, vec2 uv) const;

  // Of a camera that looks ahead and back: the same place in the lens that shows it less well, and its share of the
  // pixel, below a half; 0 beyond the seam, and of all other pictures.
  WeightedPlace other_lens(int index, vec2 home, vec2 uv) const;
  Ray ray_of(int index, vec2 home, vec2 uv) const {
    return camera_ray(camera, eyes[static_cast<size_t>(index)], home, uv, vec2(0.0f));
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
  // Whether the target has a picture at this pixel: fisheyes have empty corners.
  bool wants(int x, int y) const {
    return !has_image_circle(camera.projection.kind) || look_of(camera.projection, home_of(x, y), home_of(x, y)).seen;
  }
};

// The picture, of which only the format matters, must outlive the mapping and must not move.
Mapping make_mapping(const StoredPicture& picture, const ConvertTarget& target);

// Whether ConvertTarget::turned is any turn.
bool is_turned(const ConvertTarget& target);

}  // namespace ods

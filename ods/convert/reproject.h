// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Moves the eyes by the picture's depth: to another distance, merge or neck, or from one eye to two.
//
// The ray is projected into the closest eye's picture and marched from near to far; the first sample on the stored
// surface is the hit. At depth edges it may pass behind; then the other eye is tried, and a point that neither shows is
// a hole. A hole may be filled from the surface behind: the farther of the two sides of the edge is continued,
// mirrored, in the hole. Nothing is ever drawn between an object and its background.
//
// row_warp.h finds the same points for whole rows at once, if the cameras allow that.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "ods/convert/panorama.h"

namespace ods {

struct Reprojection {
  const Source* source = nullptr;
  size_t layer = 0;                         // index of the depth layer
  float nearest = 0.0f;                     // metres: the minimum depth
  int64_t no_depth = 0;                     // pixels without a valid depth (NaN, 0 or less): treated as empty space
  std::vector<std::vector<float>> row_max;  // per eye: 1 / metres of the nearest point in each row
};

// The index of the layer with the distance along the ray, metres: Z, as defined in save.h, or Depth.Z of some layer in
// Blender's panoramas.
std::optional<size_t> depth_layer(const StoredPicture& picture);

// An eye's depths as they are stored, 1 channel; eye: index in StoredPicture::eyes. Precondition: there is a depth
// layer.
Image depth_of_eye(const StoredPicture& picture, size_t eye);

// Reads all depths once. Precondition: there is a depth layer. The source must outlive the result and must not move.
Reprojection make_reprojection(const Source& source);

// The row's texels as 1 / metres, from the left; 0 where the picture is empty.
void read_nearness(const Reprojection& reprojection, int source_eye, int y, float* out);

// 1 / metres at a position, 0 where the picture is empty: interpolated between texels of one surface, otherwise the
// nearest texel's.
float nearness_of(const Reprojection& reprojection, const Place& place);

struct SurfaceHit {
  Place place;
  float depth = kFarDepth;  // along the ray, metres
  bool is_filled = false;   // the point was not visible to any eye
};

// The hit of a ray that starts near the viewing circle's centre. Tries the picture of source_eye first, then the other
// eye's, and if `fills`, the surface behind. place.seen is false for a hole. Precondition: ray.direction has unit
// length.
SurfaceHit meet_surface(const Reprojection& reprojection, int source_eye, const Ray& ray, bool fills = false);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Eyes at other places than a picture's own, by its depth: another distance between them, another merge, neck, or two
// eyes from one. A ray is followed through the picture that is nearest to it: as its points go from near to far they
// move along a short curve there, and the first of them that lies on the picture's surface is what the ray meets. Where
// the surface breaks off the ray may pass behind it, and what it meets there its own eye has not seen; the other eye
// may have. What neither has seen is a hole.
#pragma once
#include <cstdint>
#include <optional>

#include "ods/convert/panorama.h"

namespace ods {

struct Reprojection {
  const Source* source = nullptr;
  size_t layer = 0;      // of the depth
  float nearest = 0.0f;  // metres: nothing in the picture is nearer
  int64_t no_depth = 0;  // pixels whose depth is no distance (NaN, 0 or less): as if nothing were there
};

// The index of the layer of metres along the ray (Z, as save.h has it).
std::optional<size_t> depth_layer(const StoredPicture& picture);

// Reads all depths once. Precondition: there is a depth layer. The source stays where it is.
Reprojection make_reprojection(const Source& source);

struct SurfaceHit {
  Place place;
  float depth = kFarDepth;  // along the ray
};

// What a ray from around the centre meets, in the picture of the eye of an index if it shows there, else in the
// other's. Not seen: a hole. Precondition: a direction of unit length.
SurfaceHit meet_surface(const Reprojection& reprojection, int eye, const Ray& ray);

}  // namespace ods

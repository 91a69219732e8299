// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds what the eyes in a head box see of a scene, by first hits from 15 places: the middle, the corners and the face
// centres of the box. Rays that no place's hits explain are 0.03 % of those of other eyes in the box, or fewer.
#pragma once
#include <cstdint>
#include <vector>

#include "ods/base/progress.h"
#include "ods/layers/layered_scene.h"
#include "ods/layers/page_grid.h"
#include "ods/layers/rays/first_hits.h"

namespace ods {

inline constexpr int kMiddle = 0;  // the first of the places
inline constexpr int kPlaces = 15;
std::vector<vec3> places_of(const HeadBox& box);  // relative to the middle

// The distances of the first surfaces around a place, at the centres of the texels of a grid. kFarAway: the sky.
struct DistanceMap {
  vec3 place{0.0f};  // relative to the middle of the box
  PageGrid grid;
  std::vector<float> distances;  // page by page, row by row
  std::vector<int8_t> mirrors;   // of the same texels: the mirror that they show, -1 for none; empty without mirrors
};

// The sides of triangles that are seen: bits for each triangle of each instance.
inline constexpr uint8_t kFrontSeen = 1;
inline constexpr uint8_t kBackSeen = 2;

struct Probe {
  HeadBox box;
  PageGrid grid;                       // of the middle
  std::vector<DistanceMap> maps;       // by place: all but the middle have half its resolution
  std::vector<uint32_t> normals;       // of the middle's texels: packed by pack_direction()
  SeenInstances numbers;               // of instances here
  std::vector<FlatMirror> mirrors;     // those of the rays
  float mirrored_sky = 0.0f;           // metres: its distance
  std::vector<int> instances;          // of the middle's texels: 2 * instance + (1 if seen from the back); -1: the sky
  std::vector<size_t> first_triangle;  // by instance: where its triangles begin in `sides`
  std::vector<uint8_t> sides;          // by triangle
  std::vector<float> nearest;          // by 2 * instance + (1 if seen from the back): the smallest distance
  bool sees_sky = false;
};

// The mirror in which a side is seen (2 * instance + back; -1 for the sky), or null.
inline const FlatMirror* mirror_of(const Probe& probe, int side) {
  const int mirror = side < 0 ? -1 : probe.numbers.mirror_of(side / 2);
  return mirror < 0 ? nullptr : &probe.mirrors[static_cast<size_t>(mirror)];
}

// width: of the panorama, in texels of a lat-long. Throws Error(kMemory) before anything else, with what the pages'
// rays need as well; Error(kCancelled).
Probe probe_scene(const FirstHits& hits, const HeadBox& box, int width, const Progress& progress = {});

// A unit vector in 30 bits.
uint32_t pack_direction(vec3 normal);
vec3 unpack_direction(uint32_t packed);

}  // namespace ods

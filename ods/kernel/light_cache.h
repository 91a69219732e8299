// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A light cache: the radiance that leaves rough surfaces, averaged over cells of a few centimetres.
//
// A picture needs this radiance only as the light on its first surfaces, where it is averaged once more over all
// directions (final gathering: Jensen, "Realistic Image Synthesis Using Photon Mapping", 2001). So a path may end at
// its first scattered hit and take the light from the cell there. The cells are filled beforehand by whole paths
// (ods/render/cpu/fill_light_cache.h) and do not change afterwards, so the result of a path does not depend on other
// paths, nor the cells on the number of threads.
//
// A cell stores outgoing light over albedo, so that textures stay sharp when it is looked up. Its size is a power of
// two that follows the distance from the viewer. Each point is in two cells, one half as large as the other; the
// smaller one is used if it has enough samples. The two sides of a wall have different normals and therefore different
// cells. A look-up is moved at random by up to half a cell, so that cells have no visible edges.
//
// A path continues where cells would be visible: at surfaces closer than a few cells to where the path was scattered,
// after glossy scattering, at smooth surfaces, inside volumes, and where a cell has too few samples.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/path_light.h"
namespace ods {
#endif

const float kCellPerDistance = 0.03f;  // size of the larger cell over its distance from the viewer, before rounding up
const float kNearestCell = 0.5f;  // metres: closer to the viewer, cells have the size that they have at this distance
const float kCellsAway = 3.0f;    // minimum distance of a look-up in cells, in units of the scattered ray's spread
const float kCellShift = 0.37f;   // cells: walls often lie where cells meet, so cells are moved off them
const float kCachedRoughness = 0.3f;  // minimum roughness

// The largest power of two that is not above x. Precondition: x is positive and normal.
inline float power_of_two_below(float x) {
  return intBitsToFloat(floatBitsToInt(x) & 0x7f800000);
}

inline uint axis_of(vec3 normal) {
  vec3 size = abs(normal);
  if (size.x >= size.y && size.x >= size.z) return normal.x < 0.0f ? 0u : 1u;
  if (size.y >= size.z) return normal.y < 0.0f ? 2u : 3u;
  return normal.z < 0.0f ? 4u : 5u;
}

// The two hashes that identify the cell of a point; together they are practically unique. The first is also the slot
// where the search starts.
struct CacheKey {
  uint home;
  uint check;  // not 0
};

inline CacheKey cache_key(CachePlace place, float cell) {
  vec3 at = place.position * (1.0f / cell) + place.normal * kCellShift;
  uint x = uint(floor_int(at.x));
  uint y = uint(floor_int(at.y));
  uint z = uint(floor_int(at.z));
  uint kind = (uint(floatBitsToInt(cell)) >> 20u) + axis_of(place.normal);
  CacheKey key;
  key.home = hash_pair(hash_pair(x, y), hash_pair(z, kind));
  key.check = hash_pair(hash_pair(z ^ 0x68bc21ebu, kind), hash_pair(y ^ 0x2c9277b5u, x)) | 1u;
  return key;
}

#ifdef __cplusplus
struct LightCacheReader : PathLight {
#endif

  // The place in the cache for the light of a path at a surface, if it can be cached there.
  inline CachePlace cache_place(Surface surface) {
    CachePlace place;
    place.position = surface.position;
    place.normal = surface.geometric;
    place.cell = 0.0f;
    bool rough = surface.roughness >= kCachedRoughness && surface.transmission <= 0.0f && !surface.volume;
    if (!rough || path.media.count > 0 || path.wave >= 0) return place;
    place.albedo = surface.layered ? albedo_of_layers(surface, path.ray.direction)
                                   : mix(vec3(0.04f), vec3(1.0f), clamp(surface.base_color, vec3(0.0f), vec3(1.0f)));
    float distance = max(length(surface.position - scene_cache_viewer()), kNearestCell);
    place.cell = 2.0f * power_of_two_below(kCellPerDistance * distance);
    return place;
  }

  // The light over albedo in a cell; negative if the cell does not exist. The search ends at an empty slot, of which
  // the table has as many as cells; it is bounded nevertheless, because a search without an end hangs a GPU.
  inline vec3 light_in_cell(CacheKey key) {
    uint mask = scene_cache_mask();
    for (uint i = 0u; i <= mask; i++) {
      CacheCell cell = scene_cache_cell((key.home + i) & mask);
      if (cell.check == key.check && cell.home == key.home) return cell.light;
      if (cell.check == 0u) return vec3(-1.0f);
    }
    return vec3(-1.0f);
  }

  // The radiance that leaves the surface towards the path, without its own emission; negative if the path must
  // continue. distance: from the path's last scattering.
  inline vec3 cached_light(Surface surface, float distance) {
    vec3 none = vec3(-1.0f);
    if (scene_cache_mask() == 0u || !(path.pdf > 0.0f)) return none;
    CachePlace place = cache_place(surface);
    float nearest = kCellsAway * place.cell;
    if (!(place.cell > 0.0f) || distance * distance < nearest * nearest * path.pdf) return none;
    vec2 jitter = path_random(kDirectionPair) - vec2(0.5f);
    Frame frame = frame_around(place.normal);
    vec3 position = place.position;
    for (int i = 1; i >= 0; i--) {
      float cell = i == 1 ? 0.5f * place.cell : place.cell;
      place.position = position + (frame.tangent * jitter.x + frame.bitangent * jitter.y) * cell;
      vec3 light = light_in_cell(cache_key(place, cell));
      if (light.x >= 0.0f) return light * place.albedo;
    }
    return none;
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif

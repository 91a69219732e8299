// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The cells of a light cache (ods/kernel/light_cache.h): first sums to which threads add, then a table for paths to
// read. Sums are whole numbers, so the order of additions does not matter: the same light gives the same cells.
#pragma once
#include <cstdint>
#include <vector>

#include "ods/kernel/light_cache.h"
#include "ods/render/render_options.h"

namespace ods {

// Maximum number of paths that fill the cache of a picture, so that they take a tenth of the rendering time. Returns 0
// if the options do not use a cache, or for so few paths that the cache would do harm. Precondition: the height is set.
int64_t light_cache_paths(const RenderOptions& options);

// The light of one path at one place.
struct CacheDeposit {
  CachePlace place;
  vec3 light{0.0f};       // outgoing light, of the surface's albedo
  bool odd_path = false;  // the half of the paths that it belongs to: the halves' difference is the error of a cell
};

class LightCacheSums {
 public:
  LightCacheSums();

  // Reserves memory for this many more cells. Not while other threads add.
  void reserve(size_t more);

  // Adds to both cells of the place. Safe from many threads at once. Precondition: there is memory for them.
  void add(const CacheDeposit& deposit);

  // The relative error of the light in a cell, over all deposits, from the difference between the halves of the paths.
  double error() const;

  // The cells with enough paths, in a table of a power of two of slots. Empty if there are none.
  std::vector<CacheCell> table() const;

 private:
  struct Sums {
    uint64_t key = 0;  // CacheKey; 0 if empty
    int64_t light[3] = {};
    int64_t odd_light = 0;    // luminance, of odd paths only
    uint32_t albedo[3] = {};  // in 1/255
    uint32_t count = 0;
  };

  Sums& sums_of(CacheKey key);
  static double brightness(const Sums& sums);
  std::vector<const Sums*> cells_that_know() const;  // in an order that does not depend on threads

  std::vector<Sums> slots_;
  size_t used_ = 0;
};

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The cells of a light cache (ods/kernel/light_cache.h): first sums to which threads add, then a table for paths to
// read. Sums are whole numbers, so their order does not matter: the same light gives the same cells.
#pragma once
#include <cstdint>
#include <vector>

#include "ods/kernel/light_cache.h"
#include "ods/render/render_options.h"

namespace ods {

// The most paths that fill the cache of a picture: a share of its own, so that they take a tenth of the time. 0: the
// options ask for none, or few paths would fill it, which is worse than none. Precondition: the height is set.
int64_t light_cache_paths(const RenderOptions& options);

// What one path found at one place.
struct CacheDeposit {
  CachePlace place;
  vec3 light;     // that leaves, of the surface's albedo
  bool odd_path;  // which half of the paths it belongs to: the halves tell how certain a cell is
};

class LightCacheSums {
 public:
  LightCacheSums();

  // Room for this many more cells. Not while other threads add.
  void reserve(size_t more);

  // To both cells of the place. Safe from many threads at once. Precondition: there is room.
  void add(const CacheDeposit& deposit);

  // How far the halves of the paths are apart: the relative error of the light in a cell, over all deposits.
  double error() const;

  // The cells that know enough, in a table of a power of two of slots. Empty if there is none.
  std::vector<CacheCell> table() const;

 private:
  struct Sums {
    uint64_t key = 0;  // CacheKey; 0: empty
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

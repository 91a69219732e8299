// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The panorama around the middle of the head box, as the pages of a cube. A face is divided evenly by angle, not by
// length (an equi-angular cube: u = 4/pi atan(x/z)), so that its texels are nearly as large everywhere; a face that is
// larger than a texture has several pages. Each page continues beyond its edges by a gutter, so that filters find the
// neighbour's texels.
//
// Directions are in the scene's axes, relative to the middle of the box. Positions in a page are in texels: (0, 0) is its
// upper left corner, texel (x, y) has its centre at (x + 1/2, y + 1/2).
#pragma once
#include <cstddef>
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

inline constexpr int kFaces = 6;  // ahead (-Z), right (+X), behind (+Z), left (-X), above (+Y), below (-Y)

class PageGrid {
 public:
  static constexpr int kGutter = 4;

  PageGrid() : PageGrid(4 + 2 * kGutter, 1) {}
  // size: width and height of a page, texels. across: a face has across x across pages.
  PageGrid(int size, int across);

  int size() const { return size_; }
  int across() const { return across_; }
  int inner() const { return size_ - 2 * kGutter; }
  int pages() const { return kFaces * across_ * across_; }
  float pixel() const;  // angle of a texel in the middle of a face, radians

  // The direction of a texel's centre: a unit vector. The same as from_page(), but faster.
  vec3 texel_ray(int page, int x, int y) const;

 private:
  int size_;
  int across_;
  std::vector<float> slopes_;  // of the texels' centres, by page across a face
};

// A grid with texels as large as those of a lat-long panorama of a width, but for the gutters. Pages are at most 2048
// wide.
PageGrid page_grid(int width);

// The face in which a direction lies; of several, the first.
int face_of(vec3 direction);

// The page in which a direction lies, and its position there.
struct PagePlace {
  int page;
  vec2 position;
};
PagePlace place_in_pages(const PageGrid& grid, vec3 direction);

// The position of a direction in a page. Precondition: it is less than 90 degrees from the middle of the page's face.
vec2 to_page(const PageGrid& grid, int page, vec3 direction);

// The inverse: a unit vector.
vec3 from_page(const PageGrid& grid, int page, vec2 position);

// The index of a texel of square textures that are below each other, row by row.
inline size_t texel_index(int size, int texture, int x, int y) {
  const size_t side = static_cast<size_t>(size);
  return (static_cast<size_t>(texture) * side + static_cast<size_t>(y)) * side + static_cast<size_t>(x);
}

// A texel by its page and its place there, and its index if all pages are below each other, row by row.
struct PageTexel {
  int page, x, y;
};

inline size_t index_of(const PageGrid& grid, PageTexel at) {
  return texel_index(grid.size(), at.page, at.x, at.y);
}

inline PageTexel texel_at(const PageGrid& grid, size_t index) {
  const size_t size = static_cast<size_t>(grid.size());
  const int row = static_cast<int>(index / size);
  return {row / grid.size(), static_cast<int>(index % size), row % grid.size()};
}

inline vec3 ray_of(const PageGrid& grid, PageTexel at) {
  return grid.texel_ray(at.page, at.x, at.y);
}

// The number of texels of all pages, gutters included.
inline size_t texel_count(const PageGrid& grid) {
  return index_of(grid, {grid.pages(), 0, 0});
}

// Calls visit(PageTexel) for the texels of all pages that are not in gutters.
template <typename Visit>
void for_each_inner_texel(const PageGrid& grid, const Visit& visit) {
  for (int page = 0; page < grid.pages(); page++) {
    for (int y = PageGrid::kGutter; y < grid.size() - PageGrid::kGutter; y++) {
      for (int x = PageGrid::kGutter; x < grid.size() - PageGrid::kGutter; x++) visit(PageTexel{page, x, y});
    }
  }
}

// The planes through the middle that separate pages, by their normals: those between faces, and those that divide faces.
struct PagePlane {
  vec3 normal{0.0f};
  int face = -1;  // the only face that it divides; -1: a plane between faces
};
int page_plane_count(const PageGrid& grid);
PagePlane page_plane(const PageGrid& grid, int index);

}  // namespace ods

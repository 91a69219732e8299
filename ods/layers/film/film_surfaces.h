// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The surfaces of what moves, and how near they come.
#pragma once
#include <span>
#include <vector>

#include "ods/layers/film/film_geometry.h"
#include "ods/layers/pieces.h"

namespace ods {

// All sides of the movers that can be seen, with all of their triangles, and the positions that deform at each frame.
struct WholeSurface {
  FilmSurface surface;
  std::vector<uvec3> triangles;  // counter-clockwise as seen from the side
  std::vector<uint> welded;      // by vertex of the mesh: the index of its position
};
std::vector<WholeSurface> surfaces_of(Scene& scene, const std::vector<Mover>& movers, std::span<const double> times);

// Returns for each surface and triangle whether a place in the box sees a point of it in one of some frames, with one ring of
// neighbours; large triangles and those with alpha always count as seen. Inner sides and what never comes out from
// behind something are not. Sets the scene to some of the times, and then to the first.
std::vector<std::vector<char>> seen_triangles(Scene& scene, const std::vector<WholeSurface>& surfaces,
                                              const std::vector<Mover>& movers, std::span<const double> times,
                                              const HeadBox& box);

// The view of a surface from the box during a film.
struct FilmView {
  std::vector<char> faces;  // by triangle: whether it faces an eye in the box, in any frame
  float free_half = 1e30f;  // metres: half the side of the largest cube around the box's middle that it never enters
  float nearest = 1e30f;    // metres from the box, in its own coordinates: divided by its scale
};
FilmView view_of(const WholeSurface& whole, const Mover& mover, const HeadBox& box);

}  // namespace ods

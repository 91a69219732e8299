// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The geometry of what moves in a film: triangles with texture coordinates that stay the same, and the point of the
// surface that each texel shows.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "ods/base/progress.h"
#include "ods/layers/film/movers.h"
#include "ods/layers/layered_scene.h"
#include "ods/scene/scene.h"

namespace ods {

// One side of an instance, in the mover's coordinates.
struct FilmSurface {
  size_t mover = 0;
  int instance = 0;
  bool is_back = false;
  bool is_masked = false;
  float error = 0.0f;  // metres: triangles are at most so far from the scene's own
  std::vector<vec3> positions;
  std::vector<std::vector<vec3>> shapes;  // if the mover deforms: the positions at each frame
};

struct FilmTriangle {
  uint surface;
  uvec3 corners;  // of the surface's positions
  vec2 at[3];     // of the texture that they are in, texels
};

struct FilmTexel {
  size_t at;  // in all textures below each other
  uint triangle;
  int chart;
  vec2 center;  // as FilmTriangle::at
  bool is_inside;
};

struct FilmGeometry {
  LayerFilm film;  // without lights; one mover for each of the given ones, without meshes if the box never sees it
  int texture_size = 0;  // width and height of a texture
  size_t textures = 0;
  std::vector<LayerKind> kinds;  // by texture
  std::vector<FilmSurface> surfaces;
  std::vector<FilmTriangle> triangles;
  std::vector<FilmTexel> texels;
};

// Everything of the movers that faces an eye in the box in any of the frames, with texels as small as a pixel of a
// panorama of this width where it comes nearest to the box. times: of the frames, seconds. Sets the scene to some of
// them, and then to the first. Throws Error(kUsage) if a mover comes into the box or too near; Error(kMemory).
FilmGeometry build_film(Scene& scene, const std::vector<Mover>& movers, std::span<const double> times,
                        const HeadBox& box, int width);

}  // namespace ods

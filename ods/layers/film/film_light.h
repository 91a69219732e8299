// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The light of what moves in a film: path traced at some of its frames, texel by texel, where it is then.
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "ods/base/progress.h"
#include "ods/camera/texel_rays.h"
#include "ods/layers/film/film_geometry.h"
#include "ods/layers/light/light_layers.h"
#include "ods/render/renderer.h"

namespace ods {

// Every `step`-th of the frames, and the last one. Precondition: step > 0, frames > 0.
std::vector<size_t> light_frames(size_t frames, size_t step);

// The bytes of a film's textures on the graphics card, and the most that a film may have.
size_t film_texture_bytes(const FilmGeometry& geometry, size_t lights);
inline constexpr size_t kMostFilmBytes = size_t{512} << 20;

// The rays that find the light of the texels at a frame. Texels that something else touches there, or whose mover is
// hidden, have none: they claim the light beside them. coverage: of masked textures' texels, 0..1.
struct FilmRays {
  TexelRays rays;
  std::vector<int> claims;  // as in LayerGeometry
  std::vector<float> coverage;
};

// scene: as it is at the frame. Precondition: the movers are visible as they are then. eye: of the box's middle.
FilmRays film_rays(const Scene& scene, const FilmGeometry& geometry, size_t frame, vec3 eye);

// Sets the scene to a frame and returns its renderer.
using SetFrame = std::function<const Renderer&(size_t frame)>;

// Returns the film with its lights, at these frames. light: with options as for light_layers(); each frame has
// files of its own, unless that has none; the finished ones remain. Throws as bake() does.
LayerFilm light_film(FilmGeometry geometry, const Scene& scene, vec3 eye, std::span<const size_t> frames,
                     const SetFrame& set, const LayerLight& light, const Progress& progress = {});

}  // namespace ods

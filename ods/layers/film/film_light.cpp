// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/film/film_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "ods/layers/film/kept_light.h"
#include "ods/layers/footprint.h"
#include "ods/layers/light/display.h"
#include "ods/layers/light/push.h"
#include "ods/layers/rays/first_hits.h"

namespace ods {

namespace {

constexpr float kLift = 1e-3f;     // metres in front of a surface
constexpr float kSlack = 0.004f;   // metres by which the scene's own surface may be elsewhere
constexpr float kGrazing = 0.05f;  // cosine between a ray and the surface, at least
constexpr float kFlatTexels = 1e-6f;

// A triangle as it is at a frame.
struct Placed {
  vec3 corners[3];
  vec3 normal;
  vec3 across, down;  // a step of a texel; 0 if it has no area in the texture

  vec3 point(vec2 from_first) const { return corners[0] + from_first.x * across + from_first.y * down; }
};

Placed placed_triangle(const FilmGeometry& geometry, const FilmTriangle& triangle, size_t frame) {
  const FilmSurface& surface = geometry.surfaces[triangle.surface];
  const LayerPose& pose = geometry.film.movers[surface.mover].poses[frame];
  const std::vector<vec3>& positions = surface.shapes.empty() ? surface.positions : surface.shapes[frame];
  Placed now{};
  for (int i = 0; i < 3; i++) now.corners[i] = at_pose(pose, positions[triangle.corners[i]]);
  const vec3 ab = now.corners[1] - now.corners[0], ac = now.corners[2] - now.corners[0];
  const vec3 normal = cross(ab, ac);
  now.normal = length(normal) > 0.0f ? normalize(normal) : vec3(0, 1, 0);
  const vec2 u = triangle.at[1] - triangle.at[0], v = triangle.at[2] - triangle.at[0];
  const float area = u.x * v.y - u.y * v.x;
  if (abs(area) < kFlatTexels) return now;
  now.across = (ab * v.y - ac * u.y) / area;
  now.down = (ac * u.x - ab * v.x) / area;
  return now;
}

// Shoots at the surfaces of a frame.
struct FilmShooter {
  const FirstHits& hits;
  const FilmSurface& surface;
  vec3 eye;

  // The ray that arrives at a point from just in front of it; direction 0 if something else is there.
  TexelRay ray(vec3 point, vec3 normal) const {
    TexelRay ray{};
    vec3 direction = normalize(point - eye);
    const float cosine = dot(direction, normal);
    if (cosine > -kGrazing) direction = normalize(direction - normal * (0.1f + cosine));
    const float most = 4.0f * surface.error / std::max(-dot(direction, normal), kGrazing) + kSlack;
    for (const float share : {1.0f, 0.3f, 0.1f}) {
      const float lift = std::max(share * most, kLift);
      ray.origin = point - direction * lift;
      FirstHit seen;
      hits.look(ray.origin, &direction, 1, &seen);
      if (seen.instance != surface.instance || seen.front == surface.is_back || seen.distance > lift + most) continue;
      ray.direction = direction;
      break;
    }
    return ray;
  }

  // Returns whether the surface continues to the corners of a texel. center: from the first corner, texels.
  bool hits_all(const Placed& triangle, vec2 center) const {
    for (const vec2& corner : {vec2(-0.5f, -0.5f), vec2(-0.5f, 0.5f), vec2(0.5f, -0.5f), vec2(0.5f, 0.5f)}) {
      if (ray(triangle.point(center + corner), triangle.normal).direction == vec3(0.0f)) return false;
    }
    return true;
  }
};

// The light of a frame's textures, displayed. kept: as for kept_light().
Image lit_textures(FilmRays film, const Renderer& renderer, const LayerLight& light, const std::string& kept,
                   const Progress& progress) {
  const auto rays = std::make_shared<const TexelRays>(std::move(film.rays));
  Image all = kept_light(renderer, rays, light.bake, kept, progress);
  push_outwards(all, rays->owners, film.claims, kPushedRings);
  return displayed(std::move(all), light.exposure, light.tone);
}

Image cut_film_texture(const Image& all, const std::vector<float>& coverage, int size, size_t index, LayerKind kind) {
  Image texture(size, size, has_alpha(kind) ? 4 : 3);
  const size_t texels = static_cast<size_t>(size) * static_cast<size_t>(size), first = index * texels;
  const size_t channels = static_cast<size_t>(texture.channels);
  for (size_t i = 0; i < texels; i++) {
    std::copy_n(&all.pixels[3 * (first + i)], 3, &texture.pixels[channels * i]);
    if (channels == 4) texture.pixels[channels * i + 3] = coverage[first + i];
  }
  return texture;
}

// Copies the light of movers that are hidden at one of these frames from the last one before at which they are not, or
// else the first: viewers mix it while they appear.
void light_hidden(const FilmGeometry& geometry, std::span<const size_t> frames, LayerFilm& film) {
  const size_t size = static_cast<size_t>(geometry.texture_size), texels = size * size;
  for (const FilmTexel& texel : geometry.texels) {
    const LayerMover& mover = film.movers[geometry.surfaces[geometry.triangles[texel.triangle].surface].mover];
    std::vector<Image>& lights = film.lights[texel.at / texels];
    const auto is_shown = [&](size_t frame) { return mover.poses[frame].shown; };
    const auto first = std::ranges::find_if(frames, is_shown);
    if (first == frames.end()) continue;
    size_t from = static_cast<size_t>(first - frames.begin());
    for (size_t i = 0; i < frames.size(); i++) {
      const size_t at = texel.at % texels * static_cast<size_t>(lights[i].channels);
      if (is_shown(frames[i])) {
        from = i;
      } else {
        std::copy_n(&lights[from].pixels[at], 3, &lights[i].pixels[at]);
      }
    }
  }
}

}  // namespace

std::vector<size_t> light_frames(size_t frames, size_t step) {
  std::vector<size_t> chosen;
  for (size_t frame = 0; frame < frames; frame += step) chosen.push_back(frame);
  if (chosen.back() != frames - 1) chosen.push_back(frames - 1);
  return chosen;
}

size_t film_texture_bytes(const FilmGeometry& geometry, size_t lights) {
  const size_t size = static_cast<size_t>(geometry.texture_size);
  return texture_bytes(lights * geometry.textures * size * size);
}

FilmRays film_rays(const Scene& scene, const FilmGeometry& geometry, size_t frame, vec3 eye) {
  const FirstHits hits(scene);
  const size_t size = static_cast<size_t>(geometry.texture_size), count = geometry.textures * size * size;
  FilmRays film;
  film.rays.width = geometry.texture_size;
  film.rays.height = geometry.texture_size * static_cast<int>(geometry.textures);
  film.rays.rays.resize(count);
  film.rays.owners.assign(count, -1);
  film.claims.assign(count, -1);
  if (std::ranges::find(geometry.kinds, LayerKind::kMasked) != geometry.kinds.end()) film.coverage.resize(count);
  tbb::parallel_for(size_t{0}, geometry.texels.size(), [&](size_t i) {
    const FilmTexel& texel = geometry.texels[i];
    const FilmTriangle& triangle = geometry.triangles[texel.triangle];
    const FilmSurface& surface = geometry.surfaces[triangle.surface];
    if (!geometry.film.movers[surface.mover].poses[frame].shown) return;
    const Placed now = placed_triangle(geometry, triangle, frame);
    const FilmShooter shooter{hits, surface, eye};
    const bool has_area = now.across != vec3(0.0f) || now.down != vec3(0.0f);
    const vec2 from_first = texel.center - triangle.at[0];
    const vec3 point = has_area ? now.point(from_first) : (now.corners[0] + now.corners[1] + now.corners[2]) / 3.0f;
    const auto shoot = [&](vec2 offset) { return shooter.ray(now.point(from_first + offset), now.normal); };
    TexelRay ray =
        surface.is_masked && has_area ? covered_ray(shoot, film.coverage[texel.at]) : shooter.ray(point, now.normal);
    const bool is_lit = ray.direction != vec3(0.0f);
    if (surface.is_masked && !has_area) film.coverage[texel.at] = is_lit ? 1.0f : 0.0f;
    if (is_lit && texel.is_inside && !surface.is_masked && shooter.hits_all(now, from_first)) {
      ray.across = now.across, ray.down = now.down;
    }
    film.rays.rays[texel.at] = ray;
    (is_lit ? film.rays.owners : film.claims)[texel.at] = texel.chart;
  });
  return film;
}

LayerFilm light_film(FilmGeometry geometry, const Scene& scene, vec3 eye, std::span<const size_t> frames,
                     const SetFrame& set, const LayerLight& light, const Progress& progress) {
  LayerFilm& film = geometry.film;
  film.lights.resize(geometry.textures);
  std::vector<float> coverage;
  for (size_t i = 0; i < frames.size(); i++) {
    const Renderer& renderer = set(frames[i]);
    FilmRays rays = film_rays(scene, geometry, frames[i], eye);
    // A mover that is hidden at first is covered as at the first of these frames in which it is not.
    if (coverage.empty()) coverage = rays.coverage;
    for (size_t at = 0; at < coverage.size(); at++) coverage[at] = std::max(coverage[at], rays.coverage[at]);
    LayerLight own = light;
    own.bake.keeps_unfinished = false;
    const std::string& path = light.bake.unfinished;
    if (!path.empty()) own.bake.unfinished = unfinished_light(path, frames[i]);
    const double n = static_cast<double>(frames.size());
    const Image all = lit_textures(std::move(rays), renderer, own, path.empty() ? "" : finished_light(path, frames[i]),
                                   part_of(progress, static_cast<double>(i) / n, static_cast<double>(i + 1) / n));
    film.light_times.push_back(film.times[frames[i]]);
    for (size_t texture = 0; texture < geometry.textures; texture++) {
      film.lights[texture].push_back(
          cut_film_texture(all, coverage, geometry.texture_size, texture, geometry.kinds[texture]));
    }
  }
  light_hidden(geometry, frames, film);
  return std::move(geometry.film);
}

}  // namespace ods

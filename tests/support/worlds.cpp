// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/worlds.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ods/kernel/camera/camera.h"

namespace ods {

float noise_at(vec3 p, float size, uint32_t seed) {
  float sum = 0.0f, weight = 0.5f, all = 0.0f;
  for (int octave = 0; octave < 4; octave++, weight *= 0.7f, size *= 0.45f) {
    const vec3 q = p / size, low = floor(q), f = q - low, s = f * f * (3.0f - 2.0f * f);
    float value = 0.0f;
    for (int i = 0; i < 8; i++) {
      const int x = i & 1, y = i >> 1 & 1, z = i >> 2;
      uint32_t n = static_cast<uint32_t>(static_cast<int64_t>(low.x) + x) * 374761393u +
                   static_cast<uint32_t>(static_cast<int64_t>(low.y) + y) * 668265263u +
                   static_cast<uint32_t>(static_cast<int64_t>(low.z) + z) * 2147483647u + seed * 97u;
      n = (n ^ n >> 13) * 1274126177u;
      const float random = static_cast<float>((n ^ n >> 16) & 0xffffu) / 65535.0f;
      value += random * (x ? s.x : 1.0f - s.x) * (y ? s.y : 1.0f - s.y) * (z ? s.z : 1.0f - s.z);
    }
    sum += weight * value, all += weight;
  }
  return sum / all;
}

namespace {

// The point where a ray from within a box meets it, and the axis across the wall.
struct WallHit {
  vec3 point;
  int axis;
};

WallHit wall_of_box(vec3 low, vec3 high, vec3 origin, vec3 direction) {
  float t = std::numeric_limits<float>::max();
  int axis = 0;
  for (int i = 0; i < 3; i++) {
    const float d = direction[i], edge = d > 0.0f ? high[i] : low[i];
    if (d != 0.0f && (edge - origin[i]) / d < t) t = (edge - origin[i]) / d, axis = i;
  }
  return {origin + t * direction, axis};
}

// A room with a window, pictures on the walls and tiles on the floor; the eyes are 1.5 m above it.
vec3 hall_at(vec3 origin, vec3 direction) {
  const auto [p, axis] = wall_of_box(vec3(-2.2f, -1.5f, -3.1f), vec3(2.9f, 1.4f, 3.6f), origin, direction);
  const int wall = 2 * axis + (direction[axis] > 0.0f ? 1 : 0);
  const std::array<vec3, 6> paint = {vec3(0.6f, 0.3f, 0.2f),  vec3(0.3f, 0.5f, 0.6f), vec3(0.25f), vec3(0.85f),
                                     vec3(0.5f, 0.55f, 0.3f), vec3(0.7f, 0.6f, 0.5f)};
  vec3 color = paint[static_cast<size_t>(wall)] * (0.5f + 0.9f * noise_at(p, 0.6f, static_cast<uint32_t>(wall)));
  const auto fraction = [](float x) { return x - std::floor(x); };
  if (wall == 2 && (fraction(2.0f * p.x + 0.3f) < 0.08f || fraction(2.0f * p.z + 0.4f) < 0.08f)) color = vec3(0.05f);
  if (wall == 4 && std::abs(p.x - 0.6f) < 0.8f && std::abs(p.y) < 0.6f) color = vec3(0.9f, 0.95f, 1.0f);
  if (wall == 0 && fraction(0.7f * p.z) < 0.5f && std::abs(p.y - 0.2f) < 0.4f) {
    color = vec3(noise_at(p, 0.2f, 31), noise_at(p, 0.3f, 32), 0.3f);
  }
  return color;
}

// Grass under a sky with clouds, and trees.
vec3 field_at(vec3 origin, vec3 direction) {
  vec3 color = glm::mix(vec3(0.8f, 0.85f, 0.9f), vec3(0.25f, 0.45f, 0.8f), std::max(direction.y, 0.0f));
  const float cloud = noise_at(direction * 20.0f, 6.0f, 5);
  color = glm::mix(color, vec3(1.0f), std::clamp(4.0f * (cloud - 0.5f), 0.0f, 0.8f));
  float nearest = std::numeric_limits<float>::max();
  if (direction.y < 0.0f) {
    nearest = (-1.6f - origin.y) / direction.y;
    const vec3 p = origin + nearest * direction;
    color = vec3(0.15f, 0.3f, 0.08f) * (0.3f + 1.6f * noise_at(p, 0.7f, 9));
  }
  for (int i = 0; i < 17; i++) {
    const float angle = 2.39996f * static_cast<float>(i * i % 23) + 0.3f * static_cast<float>(i);
    const float far = 2.0f + 0.55f * static_cast<float>(i), radius = 0.15f + 0.02f * static_cast<float>(i % 5);
    const vec3 foot(far * std::sin(angle), 0.0f, -far * std::cos(angle));
    const float dx = direction.x, dz = direction.z, ox = origin.x - foot.x, oz = origin.z - foot.z;
    const float a = dx * dx + dz * dz, b = ox * dx + oz * dz, c = ox * ox + oz * oz - radius * radius;
    if (a == 0.0f || b * b - a * c <= 0.0f) continue;
    const float t = (-b - std::sqrt(b * b - a * c)) / a;
    const vec3 p = origin + t * direction;
    if (t <= 0.0f || t >= nearest || p.y > 1.5f + 0.2f * static_cast<float>(i)) continue;
    nearest = t;
    color = vec3(0.3f, 0.2f, 0.12f) * (0.3f + 1.4f * noise_at(p, 0.3f, static_cast<uint32_t>(40 + i)));
  }
  return color;
}

// Rock all around, at most 4 m away, lit from one side.
vec3 cave_at(vec3 origin, vec3 direction) {
  const vec3 middle(0.4f, 0.3f, -0.5f);
  const vec3 o = origin - middle;
  const float b = dot(o, direction), c = dot(o, o) - 9.0f;
  const vec3 p = origin + (-b + std::sqrt(b * b - c)) * direction;
  const float light = 0.35f + 0.25f * dot(normalize(p - middle), normalize(vec3(0.7f, 0.5f, -0.4f)));
  return light * vec3(0.2f + noise_at(p, 0.9f, 71), 0.2f + noise_at(p, 0.8f, 72), 0.2f + noise_at(p, 1.0f, 73));
}

// A test room: checks of half a metre on all six sides, with four equal walls.
vec3 tiles_at(vec3 origin, vec3 direction) {
  const auto [point, wall] = wall_of_box(vec3(-2.5f, -1.5f, -2.5f), vec3(2.5f, 1.5f, 2.5f), origin, direction);
  const vec3 p = point * 2.0f;
  int sum = 0;
  for (int i = 0; i < 3; i++) sum += i == wall ? 0 : static_cast<int>(std::floor(p[i]));
  return vec3(sum % 2 == 0 ? 0.6f : 0.15f) * (wall == 1 ? 0.8f : 1.0f);
}

}  // namespace

vec3 world_at(World world, vec3 origin, vec3 direction) {
  switch (world) {
    case World::kHall:
      return hall_at(origin, direction);
    case World::kField:
      return field_at(origin, direction);
    case World::kTiles:
      return tiles_at(origin, direction);
    case World::kCave:
      break;
  }
  return cave_at(origin, direction);
}

Image seen_in(World world, const StereoCamera& stereo, int eye, Extent size, bool is_pair) {
  const Camera camera = make_camera(stereo);
  const int n = 2;  // samples on a side of a pixel
  Image image(size.width, size.height, 3);
  tbb::parallel_for(0, size.height, [&](int y) {
    for (int x = 0; x < size.width; x++) {
      vec3 sum(0.0f);
      const vec2 whole(static_cast<float>(size.width), static_cast<float>(size.height));
      const vec2 home = (vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / whole;
      for (int i = 0; i < n * n; i++) {
        const vec2 at(static_cast<float>(i % n), static_cast<float>(i / n));
        const vec2 uv = home + ((at + 0.5f) / static_cast<float>(n) - 0.5f) / whole;
        Ray ray = camera_ray(camera, eye, home, uv, vec2(0.0f));
        if (ray.direction == vec3(0.0f)) continue;
        if (is_pair) ray.origin = camera.center + camera.right * (0.5f * stereo.ipd * eye_side(eye));
        sum += world_at(world, ray.origin, ray.direction);
      }
      for (int c = 0; c < 3; c++) image.at(x, y)[c] = sum[c] / static_cast<float>(n * n);
    }
  });
  return image;
}

}  // namespace ods

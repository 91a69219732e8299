// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/probes/light_probes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "ods/base/error.h"
#include "ods/layers/probes/harmonics.h"
#include "ods/render/center_hit.h"
#include "ods/render/cpu/job.h"
#include "ods/render/lights.h"
#include "ods/render/media_at.h"

namespace ods {

namespace {

constexpr float kReach = 4.0f;    // metres around the middle of the box
constexpr float kSpacing = 0.5f;  // metres
constexpr float kRoom = 0.1f;     // metres between a free place and every surface
constexpr int kLooks = 4096;      // rays that find the bounds of what the middle sees
constexpr int kRoomRays = 26;     // towards faces, edges and corners of a cube
constexpr float kEvenPdf = 0.25f * std::numbers::inv_pi_v<float>;

// The direction of a sample, even over the sphere.
vec3 even_direction(vec2 uv) {
  const float y = 1.0f - 2.0f * uv.x, r = std::sqrt(std::max(1.0f - y * y, 0.0f));
  const vec2 around = cos_sin(2.0f * kPi * uv.y);
  return {r * around.x, y, r * around.y};
}

// A scene prepared for paths from places in it.
class Tracing {
 public:
  Tracing(const Scene& scene, const ProbeOptions& options)
      : options_(options), lights_(make_lights(scene)), embree_(scene) {
    set_scene(tracer_, scene, lights_);
    tracer_.ray_time = 0.5f;
    tracer_.straight_solids = options.render.caustics == Caustics::kStraight;
  }

  // The distance of the first surface that the camera sees along a ray; kFarAway if the ray meets nothing.
  float distance(vec3 from, vec3 direction) const {
    PathTracer tracer = tracer_;
    tracer.start_path({from, direction}, no_media(), 0u, 0u);
    const Hit hit = embree_.closest_hit(tracer, tracer.path.ray, kHalfAlphaRay);
    return hit.t < 0.0f ? kFarAway : hit.t;
  }

  LightProbe light_at(vec3 place, uint seed) const {
    Job job{embree_, tracer_, {},   {}, false, no_media(), options_.render, path_settings(options_.render),
            0,       1.0,     false};
    job.media = media_at(job.tracer, place,
                         [&](const Ray& ray) { return embree_.closest_hit(job.tracer, ray, kHalfAlphaRay); });
    LightProbe probe;
    probe.weight = 1.0f;
    const float share = 1.0f / static_cast<float>(options_.paths);
    for (int i = 0; i < options_.paths; i++) {
      const auto add = [&](vec3 light, vec3 direction) {
        const std::array<float, LightProbe::kHarmonics> values = harmonics(direction);
        for (size_t k = 0; k < values.size(); k++) probe.radiance[k] += light * (share * values[k]);
      };
      trace(job, place, seed, static_cast<uint>(i), add);
    }
    return probe;
  }

 private:
  // A path from a place that scatters evenly: the light of a shadow ray, and that of the path's own ray.
  template <typename Add>
  static void trace(Job& job, vec3 place, uint seed, uint index, const Add& add) {
    PathTracer& tracer = job.tracer;
    PathState& path = tracer.path;
    const vec3 direction = even_direction(random_pair(seed, index, kDirectionPair));
    tracer.start_path({place, direction}, job.media, seed, index);
    if (aim(job, place)) {
      tracer.add_shadow_light();
      add(path.radiance, path.shadow_ray.direction);
      path.radiance = vec3(0.0f);
    }
    path.bounce = 1;
    path.pdf = path.other_pdf = kEvenPdf;
    trace_path(job, job.embree.closest_hit(tracer, path.ray, kPathRay), [](const PathStep&) {});
    add(path.radiance * (1.0f / kEvenPdf), direction);
  }

  // Sends the shadow ray to a light; returns whether its light arrives.
  static bool aim(Job& job, vec3 place) {
    PathTracer& tracer = job.tracer;
    PathState& path = tracer.path;
    if (tracer.scene_light_pick_count() == 0) return false;
    const LightSample light =
        tracer.sample_light(path.receiver, tracer.path_random(kLightPair), tracer.path_random(kLightPair + 1u),
                            tracer.path_random(kLightPair + 2u));
    if (!light.valid) return false;
    const float weight = light.pdf > 0.0f ? tracer.power_heuristic(light.pdf, kEvenPdf) / light.pdf : 1.0f;
    path.shadow_ray = {place, light.direction};
    path.shadow_length = light.distance;
    path.shadow_media = path.media;
    path.shadow_light = path.shadow_alone = path.shadow_other = light.radiance * weight;
    if (light.distance < kFarAway) tracer.end_shadow_at(light.end);
    return path.shadow_length > 0.0f && job.embree.reaches_light(tracer);
  }

  const ProbeOptions& options_;
  LightTable lights_;
  EmbreeScene embree_;
  PathTracer tracer_;
};

// The bounds of what a place sees, within reach.
Bounds seen_bounds(const Tracing& tracing, vec3 middle) {
  Bounds bounds{middle, middle};
  for (uint i = 0; i < kLooks; i++) {
    const vec3 direction = even_direction(random_pair(0u, i, 0u));
    const vec3 end = middle + direction * std::min(tracing.distance(middle, direction), 2.0f * kReach);
    bounds.low = min(bounds.low, end);
    bounds.high = max(bounds.high, end);
  }
  bounds.low = max(bounds.low, middle - kReach);
  bounds.high = min(bounds.high, middle + kReach);
  return bounds;
}

// A grid of at most kMostProbes whose outermost places are inside the bounds, at least two along each axis.
LightProbes grid_in(Bounds bounds) {
  const vec3 extent = bounds.high - bounds.low;
  const vec3 margin = min(vec3(kProbeMargin), 0.25f * extent);
  const vec3 inner = extent - 2.0f * margin;
  LightProbes grid;
  grid.origin = bounds.low + margin;
  for (float spacing = kSpacing;; spacing *= 1.05f) {
    grid.count = max(glm::ivec3(glm::ceil(inner / spacing)) + 1, glm::ivec3(2));
    if (grid.count.x * grid.count.y * grid.count.z <= kMostProbes) break;
  }
  grid.step = inner / vec3(grid.count - 1);
  grid.probes.resize(static_cast<size_t>(grid.count.x * grid.count.y * grid.count.z));
  return grid;
}

vec3 place_of(const LightProbes& grid, int index) {
  const glm::ivec3 at(index % grid.count.x, index / grid.count.x % grid.count.y, index / (grid.count.x * grid.count.y));
  return grid.origin + grid.step * vec3(at);
}

bool is_free(const Tracing& tracing, vec3 middle, vec3 place) {
  const vec3 to = place - middle;
  const float distance = length(to);
  if (distance > 0.0f && tracing.distance(middle, to / distance) < distance + kRoom) return false;
  for (int i = 0; i <= kRoomRays; i++) {
    const vec3 side(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (side != vec3(0.0f) && tracing.distance(place, normalize(side)) < kRoom) return false;
  }
  return true;
}

}  // namespace

LightProbes light_probes(const Scene& scene, const HeadBox& box, const ProbeOptions& options,
                         const Progress& progress) {
  const Tracing tracing(scene, options);
  LightProbes grid = grid_in(seen_bounds(tracing, box.center));
  const int count = static_cast<int>(grid.probes.size());
  std::atomic<int> done = 0, free = 0;
  tbb::parallel_for(0, count, [&](int i) {
    if (progress.cancelled && progress.cancelled()) return;
    const vec3 place = place_of(grid, i);
    if (is_free(tracing, box.center, place)) {
      grid.probes[static_cast<size_t>(i)] =
          tracing.light_at(place, hash_pair(options.render.seed, static_cast<uint>(i)));
      free++;
    }
    done++;
  });
  if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "cancelled");
  if (progress.report) progress.report(1.0);
  return free > 0 ? grid : LightProbes();
}

LightProbe light_at(const Scene& scene, vec3 place, const ProbeOptions& options) {
  return Tracing(scene, options).light_at(place, options.render.seed);
}

}  // namespace ods

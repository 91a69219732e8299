// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/cpu/fill_light_cache.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ods/base/error.h"
#include "ods/render/light_cache.h"

namespace ods {
namespace {

constexpr int kKeptBounces = 4;        // number of first surfaces of a path whose light is stored
constexpr int kPathsAtOnce = 1 << 10;  // per thread
constexpr int kRoundPaths = 1 << 14;   // paths between tests of the cells
constexpr double kWantedError = 0.2;   // relative error of a cell; a pixel gathers the mean of many

// A surface that a path has met.
struct Vertex {
  CachePlace place;
  vec3 throughput;
  vec3 radiance;  // light found before it
};

// The light that a path contributes to its first surfaces, each as if the path had as many bounces left there as a path
// of the picture has after its first.
class Trail {
 public:
  explicit Trail(int bounces) : found_(static_cast<size_t>(bounces) + kKeptBounces + 1) {}

  void begin() { count_ = 0; }

  void meet(const PathStep& step) {
    const auto bounce = static_cast<size_t>(step.vertex_bounce);
    for (; count_ <= bounce; count_++) found_[count_] = step.vertex_radiance;
    if (bounce < kKeptBounces) vertices_[bounce] = {step.vertex, step.vertex_throughput, step.vertex_radiance};
  }

  // left: bounces of a path of the picture after its first.
  void add_to(LightCacheSums& sums, vec3 at_end, size_t left, bool odd) const {
    for (size_t b = 0; b < std::min<size_t>(count_, kKeptBounces); b++) {
      const Vertex& vertex = vertices_[b];
      const vec3 t = vertex.throughput;
      const float minimum = std::min({t.x, t.y, t.z}), maximum = std::max({t.x, t.y, t.z});
      if (!(vertex.place.cell > 0.0f) || !(minimum > 1e-3f * maximum))
        continue;  // nothing is known about a colour that is missing
      const vec3 all = b + left < count_ ? found_[b + left] : at_end;
      const vec3 light = (all - vertex.radiance) / t;
      if (light.x >= 0.0f && light.y >= 0.0f && light.z >= 0.0f) sums.add({vertex.place, light, odd});
    }
  }

 private:
  std::vector<vec3> found_;  // by bounce: light found before the surface
  std::array<Vertex, kKeptBounces> vertices_;
  size_t count_ = 0;
};

// Returns false if the picture is empty there.
bool start(Job& job, const std::vector<int>& eyes, uint number) {
  const uint seed = hash_pair(job.options.seed, 0x6c696768u);
  const uint index = number / static_cast<uint>(eyes.size());
  const int eye = eyes[number % eyes.size()];
  const vec2 uv = random_pair(seed, index, kPixelPair);
  const FirstRay first = first_ray(job, eye, uv, uv, seed, index);
  if (first.ray.direction == vec3(0.0f)) return false;
  job.tracer.ray_time = first.time;
  job.tracer.start_path(first.ray, job.media, hash_pair(seed, static_cast<uint>(eye)), index);
  return true;
}

void trace_batch(Job job, uint first, LightCacheSums& sums) {
  const std::vector<int> eyes = eye_list(job.options.eyes);
  Trail trail(job.settings.bounces);
  const auto left = static_cast<size_t>(job.options.bounces - 1);
  for (uint i = first; i < first + kPathsAtOnce; i++) {
    if (!start(job, eyes, i)) continue;
    trail.begin();
    PathTracer& tracer = job.tracer;
    trace_path(job, job.embree.closest_hit(tracer, tracer.path.ray, kPathRay), [&](const PathStep& step) {
      if (step.vertex_bounce >= 0) trail.meet(step);
    });
    if (!job.tracer.path.caught) trail.add_to(sums, job.tracer.path.radiance, left, (i / 2) % 2 == 1);
  }
}

}  // namespace

LightCells fill_light_cache(const Job& wanted, const Progress& progress) {
  const int64_t maximum = light_cache_paths(wanted.options);
  if (maximum == 0) return {};
  Job job = wanted;
  job.settings.keep_vertices = true;
  job.settings.clamp = 0.0f;
  job.settings.bounces = wanted.options.bounces - 1 + kKeptBounces - 1;
  job.tracer.cache_viewer = job.camera.center;
  LightCacheSums sums;
  int64_t look = 4 * kRoundPaths;
  for (int64_t done = 0; done < maximum; done += kRoundPaths) {
    sums.reserve(size_t{2} * kKeptBounces * kRoundPaths);
    tbb::parallel_for(0, kRoundPaths / kPathsAtOnce, [&](int i) {
      if (progress.cancelled && progress.cancelled()) return;
      trace_batch(job, static_cast<uint>(done) + static_cast<uint>(i * kPathsAtOnce), sums);
    });
    if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "rendering was stopped");
    if (done + kRoundPaths < look) continue;
    if (sums.error() < kWantedError) break;
    look += look / 2;
  }
  return {job.camera.center, sums.table()};
}

void show_light_cache(Job& job, const LightCells& cells) {
  job.tracer.cache_viewer = cells.viewer;
  job.tracer.cache_cells = cells.table.data();
  job.tracer.cache_mask = cells.table.empty() ? 0u : static_cast<uint>(cells.table.size() - 1);
}

}  // namespace ods

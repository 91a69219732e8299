// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/cpu/render.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "ods/base/error.h"
#include "ods/kernel/path.h"
#include "ods/render/cpu/embree_scene.h"
#include "ods/render/lights.h"
#include "ods/render/media_at.h"
#include "ods/render/moving_camera.h"
#include "ods/render/render_target.h"
#include "ods/scene/catchers.h"

namespace ods {
namespace {

constexpr int kTileSize = 16;

// Everything that is the same for all pixels.
struct Job {
  const EmbreeScene& embree;
  PathTracer tracer;
  std::span<const Camera>
      cameras;    // evenly spaced in time from the shutter's opening to its closing; one: a static camera
  Camera camera;  // the middle one
  bool shutter;   // every sample has its own time
  Media media;    // the volumes that the camera is in
  RenderOptions options;
  PathSettings settings;
  int filter;
};

struct Pixel {
  vec3 radiance{0.0f};
  vec3 normal{0.0f};
  vec3 albedo{0.0f};
  float depth = kFarDepth;
  float alpha = 0.0f;
  vec3 variance{0.0f};
};

// The render loop. Inlining the whole kernel here, and the camera below, makes it a quarter faster.
[[gnu::flatten]] void trace_path(Job& job, const PathSettings& settings) {
  PathTracer& tracer = job.tracer;
  const PathState& path = tracer.path;
  while (path.alive) {
    tracer.shade(job.embree.closest_hit(tracer, path.ray, kPathRay), settings);
    if (path.shadow_pending && !job.embree.occluded(tracer, path.shadow_ray, path.shadow_length)) {
      tracer.add_shadow_light();
    }
  }
}

vec2 pixel_center(const Job& job, int x, int y) {
  return {(static_cast<float>(x) + 0.5f) / static_cast<float>(job.options.width),
          (static_cast<float>(y) + 0.5f) / static_cast<float>(job.options.height)};
}

// Depths are not averaged: a depth belongs to the ray through the pixel's centre.
float center_depth(Job& job, int eye, int x, int y, uint seed) {
  const Ray ray = camera_ray(job.camera, eye, pixel_center(job, x, y));
  if (ray.direction == vec3(0.0f)) return kFarDepth;
  PathSettings first_hit_only = job.settings;
  first_hit_only.bounces = 0;
  PathTracer& tracer = job.tracer;
  tracer.ray_time = 0.5f;
  tracer.start_path(ray, job.media, seed, 0u);
  while (tracer.path.alive && !tracer.path.caught) {
    tracer.shade(job.embree.closest_hit(tracer, tracer.path.ray, kHalfAlphaRay), first_hit_only);
  }
  const float depth = tracer.path.depth;
  return depth < 0.0f ? kFarDepth : depth;
}

// From the sum of the samples' squares and their mean.
vec3 variance_of_mean(glm::dvec3 squares, glm::dvec3 mean, int samples) {
  if (samples < 2) return vec3(0.0f);
  const glm::dvec3 scatter = squares - mean * mean * double(samples);
  return max(scatter / (double(samples) * (samples - 1)), 0.0);
}

[[gnu::flatten]] Pixel render_pixel(Job& job, int eye, int x, int y) {
  const int width = job.options.width, height = job.options.height;
  const uint seed = hash_pair(hash_pair(job.options.seed, static_cast<uint>(eye)), static_cast<uint>(y * width + x));
  const PathState& path = job.tracer.path;
  const vec2 home = pixel_center(job, x, y);
  Pixel pixel;
  int caught = 0;
  double light_with = 0.0, light_without = 0.0;  // for catchers
  glm::dvec3 squares(0.0);
  for (int i = 0; i < job.options.samples; i++) {
    const uint index = static_cast<uint>(i);
    const vec2 place = random_pair(seed, index, kPixelPair);
    const vec2 uv = job.tracer.filtered_position(job.filter, x, y, width, height, place);
    const vec2 lens = job.camera.lens_radius > 0.0f ? random_pair(seed, index, kLensPair) : vec2(0.0f);
    if (job.shutter) job.tracer.ray_time = random_pair(seed, index, kTimePair).x;
    const Ray ray = job.cameras.size() > 1
                        ? camera_ray(camera_at(job.cameras, job.tracer.ray_time), eye, home, uv, lens)
                        : camera_ray(job.camera, eye, home, uv, lens);
    if (ray.direction == vec3(0.0f)) return {};
    job.tracer.start_path(ray, job.media, seed, index);
    trace_path(job, job.settings);
    if (job.options.transparent && path.depth < 0.0f) continue;  // the path hit nothing
    if (path.caught) {
      caught++;
      light_with += double{path.light_with}, light_without += double{path.light_without};
      continue;
    }
    pixel.alpha += 1.0f;
    pixel.radiance += path.radiance;
    if (job.options.statistics) squares += glm::dvec3(path.radiance) * glm::dvec3(path.radiance);
    pixel.normal += path.normal;
    pixel.albedo += path.albedo;
  }
  if (light_without > 0.0) pixel.alpha += static_cast<float>(caught * (1.0 - light_with / light_without));
  const float share = 1.0f / static_cast<float>(job.options.samples);
  pixel.radiance *= share;
  pixel.variance = variance_of_mean(squares, pixel.radiance, job.options.samples);
  pixel.normal *= share;
  pixel.albedo *= share;
  pixel.alpha *= share;
  if (!job.options.layers) return pixel;
  pixel.depth = center_depth(job, eye, x, y, seed);
  if (path.caught && !(pixel.alpha > 0.0f)) pixel.depth = kFarDepth;
  return pixel;
}

void put(Image& image, int x, int y, vec3 value) {
  float* at = image.at(x, y);
  at[0] = value.x, at[1] = value.y, at[2] = value.z;
}

// Takes the job by value: each tile traces with its own path state.
void render_tile(Job job, int tile, EyeImage& image) {
  const int width = image.radiance.width, height = image.radiance.height;
  const int across = (width + kTileSize - 1) / kTileSize;
  const int x0 = tile % across * kTileSize, y0 = tile / across * kTileSize;
  for (int y = y0; y < std::min(y0 + kTileSize, height); y++) {
    for (int x = x0; x < std::min(x0 + kTileSize, width); x++) {
      const Pixel pixel = render_pixel(job, image.eye, x, y);
      put(image.radiance, x, y, pixel.radiance);
      if (job.options.transparent) *image.alpha.at(x, y) = pixel.alpha;
      if (job.options.statistics) {
        put(image.variance, x, y, pixel.variance);
        *image.samples.at(x, y) = static_cast<float>(job.options.samples);
      }
      if (!job.options.layers) continue;
      put(image.normal, x, y, pixel.normal);
      put(image.albedo, x, y, pixel.albedo);
      *image.depth.at(x, y) = pixel.depth;
    }
  }
}

// Renders both eyes' tiles from one pool of work; the thread that finishes a tile reports progress.
void render_tiles(const Job& job, Picture& picture, const Progress& progress) {
  const Image& first = picture.eyes.front().radiance;
  const int per_eye = ((first.width + kTileSize - 1) / kTileSize) * ((first.height + kTileSize - 1) / kTileSize);
  const int total = per_eye * static_cast<int>(picture.eyes.size());
  std::atomic<int> done = 0;
  std::atomic<bool> stop = false;
  std::mutex reporting;
  tbb::parallel_for(0, total, [&](int i) {
    const int tile = job.options.last_tile_first ? total - 1 - i : i;
    if (stop || (progress.cancelled && progress.cancelled())) {
      stop = true;
      return;
    }
    render_tile(job, tile % per_eye, picture.eyes[static_cast<size_t>(tile / per_eye)]);
    done++;
    if (progress.report && reporting.try_lock()) {
      progress.report(static_cast<double>(done) / total);
      reporting.unlock();
    }
  });
  if (stop) throw Error(ErrorKind::kCancelled, "rendering was stopped");
  if (progress.report) progress.report(1.0);
}

}  // namespace

struct CpuRenderer::Parts {
  Parts(const Scene& wanted, int threads) : scene(wanted), arena(threads > 0 ? threads : tbb::task_arena::automatic) {
    arena.execute([&] {
      lights = make_lights(scene);
      embree.emplace(scene);
      set_scene(tracer, scene, lights);
    });
  }

  const Scene& scene;
  mutable tbb::task_arena arena;
  LightTable lights;
  std::optional<EmbreeScene> embree;
  PathTracer tracer;
};

CpuRenderer::CpuRenderer(const Scene& scene, int threads) : parts_(std::make_unique<Parts>(scene, threads)) {}

CpuRenderer::~CpuRenderer() = default;

void CpuRenderer::update(const SceneChange& change) {
  if (change.instances.empty() && change.meshes.empty() && !change.lights && !change.materials) return;
  parts_->arena.execute([&] {
    update_lights(parts_->scene, parts_->lights);
    parts_->embree->update(change);
    set_scene(parts_->tracer, parts_->scene, parts_->lights);
  });
}

Picture CpuRenderer::render(const StereoCamera& stereo, const RenderOptions& options, const Progress& progress) const {
  return render(std::span(&stereo, 1), options, progress);
}

Picture CpuRenderer::render(std::span<const StereoCamera> path, const RenderOptions& wanted,
                            const Progress& progress) const {
  assert(path.size() % 2 == 1);
  assert(wanted.transparent || !has_catchers(parts_->scene));
  const StereoCamera& stereo = path[path.size() / 2];
  const RenderOptions options = with_height(wanted, stereo);
  std::vector<Camera> cameras;
  for (const StereoCamera& each : path) cameras.push_back(make_camera(each));
  check_picture_memory(options);
  Picture picture = blank_picture(options);
  parts_->arena.execute([&] {
    PathTracer tracer = parts_->tracer;
    tracer.ray_time = 0.5f;
    const Job job{*parts_->embree,
                  tracer,
                  cameras,
                  cameras[cameras.size() / 2],
                  path.size() > 1 || parts_->scene.motion_keys > 1,
                  media_at(tracer, stereo.position,
                           [&](const Ray& ray) { return parts_->embree->closest_hit(tracer, ray, kHalfAlphaRay); }),
                  options,
                  {options.bounces, static_cast<int>(options.light_sampling)},
                  options.filter == PixelFilter::kBox ? kFilterBox : kFilterBlackmanHarris};
    render_tiles(job, picture, progress);
  });
  return picture;
}

Picture render_cpu(const Scene& scene, const StereoCamera& stereo, const RenderOptions& options,
                   const Progress& progress) {
  check_picture_memory(with_height(options, stereo));  // before the trees are built
  return CpuRenderer(scene, options.threads).render(stereo, options, progress);
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/cpu/render.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cmath>
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
#include "ods/render/passes.h"
#include "ods/render/picture_samples.h"
#include "ods/render/render_target.h"
#include "ods/render/sampling_plan.h"
#include "ods/scene/catchers.h"

namespace ods {
namespace {

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
  double unit;  // layer_unit()
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

uint pixel_seed(const Job& job, int eye, int x, int y) {
  const uint pixel = static_cast<uint>(y * job.options.width + x);
  return hash_pair(hash_pair(job.options.seed, static_cast<uint>(eye)), pixel);
}

// Depths are not averaged: a depth belongs to the ray through the pixel's centre.
float center_depth(Job& job, int eye, int x, int y) {
  const Ray ray = camera_ray(job.camera, eye, pixel_center(job, x, y));
  if (ray.direction == vec3(0.0f)) return kFarDepth;
  PathSettings first_hit_only = job.settings;
  first_hit_only.bounces = 0;
  PathTracer& tracer = job.tracer;
  tracer.ray_time = 0.5f;
  tracer.start_path(ray, job.media, pixel_seed(job, eye, x, y), 0u);
  while (tracer.path.alive && !tracer.path.caught) {
    tracer.shade(job.embree.closest_hit(tracer, tracer.path.ray, kHalfAlphaRay), first_hit_only);
  }
  const float depth = tracer.path.depth;
  return depth < 0.0f ? kFarDepth : tracer.path.caught ? -depth : depth;
}

// What one pixel's samples of one pass add up to.
struct PixelSums {
  int64_t light[3] = {};
  double squares[3] = {};
  int32_t normal[3] = {};
  int32_t albedo[3] = {};
  uint32_t hits = 0;
  uint32_t caught = 0;
  double light_with = 0.0;
  double light_without = 0.0;
};

void add_path(const PathState& path, double unit, PixelSums& sums) {
  for (int c = 0; c < 3; c++) {
    const double light = double{std::min(std::max(path.radiance[c], 0.0f), kBrightestSample)};
    sums.light[c] += std::llrint(light * kLightUnit);
    sums.squares[c] += light * light;
    sums.normal[c] += static_cast<int32_t>(std::lrint(double{path.normal[c]} * unit));
    sums.albedo[c] += static_cast<int32_t>(std::lrint(double{path.albedo[c]} * unit));
  }
}

// Traces the samples first .. last - 1 of a pixel.
[[gnu::flatten]] PixelSums trace_pixel(Job& job, int eye, int x, int y, int first, int last) {
  const int width = job.options.width, height = job.options.height;
  const uint seed = pixel_seed(job, eye, x, y);
  const PathState& path = job.tracer.path;
  const vec2 home = pixel_center(job, x, y);
  PixelSums sums;
  for (int i = first; i < last; i++) {
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
      sums.caught++;
      sums.light_with += double{path.light_with}, sums.light_without += double{path.light_without};
    } else {
      sums.hits++;
      add_path(path, job.unit, sums);
    }
  }
  return sums;
}

void add_pixel(const PixelSums& sums, size_t pixel, EyeSamples& eye) {
  for (size_t c = 0; c < 3; c++) {
    eye.light[3 * pixel + c] += sums.light[c];
    if (!eye.squares.empty()) eye.squares[3 * pixel + c] += sums.squares[c];
    if (eye.normal.empty()) continue;
    eye.normal[3 * pixel + c] += sums.normal[c];
    eye.albedo[3 * pixel + c] += sums.albedo[c];
  }
  if (eye.hits.empty()) return;
  eye.hits[pixel] += sums.hits;
  eye.caught[pixel] += sums.caught;
  eye.light_with[pixel] += sums.light_with;
  eye.light_without[pixel] += sums.light_without;
}

// The samples from..to - 1 of all noisy pixels, or the share of them that each block gets.
struct Pass {
  int from;
  int to;
};

// Takes the job by value: each block traces with its own path state.
void render_block(Job job, const SamplingPlan& plan, Pass pass, int block, EyeSamples& eye) {
  const size_t b = static_cast<size_t>(block);
  const int first = samples_of(plan, b, pass.from), last = samples_of(plan, b, pass.to);
  const int x0 = block % plan.columns * kBlockSize, y0 = block / plan.columns * kBlockSize;
  for (int y = y0; y < std::min(y0 + kBlockSize, job.options.height); y++) {
    for (int x = x0; x < std::min(x0 + kBlockSize, job.options.width); x++) {
      if (!(plan.noisy[b] >> class_of(x, y) & 1)) continue;
      const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(job.options.width) + static_cast<size_t>(x);
      if (pass.from == 0 && !eye.depth.empty()) eye.depth[pixel] = center_depth(job, eye.eye, x, y);
      add_pixel(trace_pixel(job, eye.eye, x, y, first, last), pixel, eye);
      eye.count[pixel] += static_cast<uint32_t>(last - first);
    }
  }
}

// Renders a pass of both eyes from one pool of work. The thread that finishes a block reports what is done of the pass.
void render_pass(const Job& job, const SamplingPlan& plan, Pass pass, PictureSamples& samples,
                 const Progress& progress) {
  const int per_eye = static_cast<int>(plan.noisy.size());
  const int total = per_eye * static_cast<int>(samples.eyes.size());
  std::atomic<int> done = 0;
  std::atomic<bool> stop = false;
  std::mutex reporting;
  tbb::parallel_for(0, total, [&](int i) {
    const int work = job.options.last_tile_first ? total - 1 - i : i;
    if (stop || (progress.cancelled && progress.cancelled())) {
      stop = true;
      return;
    }
    render_block(job, plan, pass, work % per_eye, samples.eyes[static_cast<size_t>(work / per_eye)]);
    done++;
    if (progress.report && reporting.try_lock()) {
      progress.report(static_cast<double>(done) / total);
      reporting.unlock();
    }
  });
  if (stop) throw Error(ErrorKind::kCancelled, "rendering was stopped");
  samples.done = pass.to;
}

// Passes until the picture is clean, has all samples or has no time left.
void render_passes(const Job& job, SamplingPlan plan, PictureSamples& samples, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  Passes passes(job.options, samples.done);
  while (const int step = passes.next_step(seconds())) {
    Progress part = progress;
    if (progress.report) part.report = [&](double done) { progress.report(passes.fraction(done, seconds())); };
    const double began = seconds();
    render_pass(job, plan, {samples.done, samples.done + step}, samples, part);
    passes.finish_step(seconds() - began);
    if (passes.can_judge()) passes.expect(judge_noise(samples, job.options, plan));
  }
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
  PictureSamples samples = no_samples(options);
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
                  options.filter == PixelFilter::kBox ? kFilterBox : kFilterBlackmanHarris,
                  layer_unit(options)};
    render_passes(job, make_plan(stereo, options), samples, progress);
  });
  return develop(samples, options);
}

Picture render_cpu(const Scene& scene, const StereoCamera& stereo, const RenderOptions& options,
                   const Progress& progress) {
  check_picture_memory(with_height(options, stereo));  // before the trees are built
  return CpuRenderer(scene, options.threads).render(stereo, options, progress);
}

}  // namespace ods

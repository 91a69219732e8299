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
#include "ods/kernel/counterpart.h"
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
  bool shares;  // paths of one eye bring light to the other
};

// The render loop, from the first hit on. Inlining the whole kernel here, and the camera below, makes it a quarter
// faster.
[[gnu::flatten]] void trace_path(Job& job, Hit hit) {
  PathTracer& tracer = job.tracer;
  const PathState& path = tracer.path;
  while (true) {
    tracer.shade(hit, job.settings);
    if (path.shadow_pending && !job.embree.occluded(tracer, path.shadow_ray, path.shadow_length)) {
      tracer.add_shadow_light();
    }
    if (!path.alive) return;
    hit = job.embree.closest_hit(tracer, path.ray, kPathRay);
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

// The samples from..to - 1 of all noisy pixels, or the share of them that each block gets.
struct Pass {
  const SamplingPlan& plan;
  int from;
  int to;
};

int samples_in(const Pass& pass, int x, int y) {
  const size_t block = block_at(pass.plan, x, y);
  if (!(pass.plan.noisy[block] >> class_of(x, y) & 1)) return 0;
  return samples_of(pass.plan, block, pass.to) - samples_of(pass.plan, block, pass.from);
}

int64_t fixed(float light) {
  return std::llrint(double{std::min(std::max(light, 0.0f), kBrightestSample)} * kLightUnit);
}

// Paths of the other eye may bring light to the same pixel at the same time.
template <typename Number>
void add(std::vector<Number>& sums, size_t at, Number value) {
  std::atomic_ref(sums[at]).fetch_add(value, std::memory_order_relaxed);
}

uint32_t fixed_square(float weight) {
  return static_cast<uint32_t>(std::lrint(weight * weight * kWeightUnit));
}

// The pixel's own path has ended.
void add_path(const PathState& path, double unit, size_t pixel, EyeSamples& eye) {
  const bool alone = !eye.alone.empty();
  for (size_t c = 0; c < 3; c++) {
    const int i = static_cast<int>(c);
    add(eye.light, 3 * pixel + c, fixed(path.radiance[i]));
    if (!eye.squares.empty()) {
      const double light =
          std::min(double{alone ? path.alone_radiance[i] : path.radiance[i]}, double{kBrightestSample});
      eye.squares[3 * pixel + c] += light * light;
    }
    if (alone) eye.alone[3 * pixel + c] += fixed(path.alone_radiance[i]);
    if (eye.normal.empty()) continue;
    eye.normal[3 * pixel + c] += static_cast<int32_t>(std::lrint(double{path.normal[i]} * unit));
    eye.albedo[3 * pixel + c] += static_cast<int32_t>(std::lrint(double{path.albedo[i]} * unit));
  }
  if (!alone) return;
  const float whole = luminance(path.alone_radiance);
  const float weight = whole > 0.0f ? std::min(luminance(path.radiance) / whole, 1.0f) : path.own_share;
  add(eye.weights, pixel, fixed_square(weight));
}

// A path of the other eye has ended that shares its light with this pixel.
void add_shared(const PathState& path, size_t pixel, EyeSamples& eye) {
  for (size_t c = 0; c < 3; c++) add(eye.light, 3 * pixel + c, fixed(path.other_radiance[static_cast<int>(c)]));
  if (!eye.weights.empty()) add(eye.weights, pixel, fixed_square(1.0f - path.own_share));
}

// One eye's pixels, and the eye that shares their paths.
struct Target {
  EyeSamples& eye;
  EyeSamples* other;
};

// If the other eye sees what the path hit, its pixel, else none.
std::optional<size_t> share_with_other_eye(Job& job, const Camera& camera, const Pass& pass, int eye, int x, int y,
                                           vec2 uv, Hit hit) {
  if (hit.t < 0.0f) return std::nullopt;
  PathTracer& tracer = job.tracer;
  const Ray& ray = tracer.path.ray;
  const vec2 size(static_cast<float>(job.options.width), static_cast<float>(job.options.height));
  const Counterpart found =
      counterpart_of(camera, job.filter, size, eye, vec2(static_cast<float>(x), static_cast<float>(y)), uv,
                     ray.direction, ray.origin + ray.direction * hit.t);
  if (!found.exists) return std::nullopt;
  const int theirs = samples_in(pass, found.x, found.y), ours = samples_in(pass, x, y);
  // Just short of the surface.
  const float length = found.distance * (1.0f - 1e-4f);
  if (theirs == 0 || job.embree.occluded(tracer, {found.origin, found.direction}, length, kPathRay))
    return std::nullopt;
  tracer.share_path(found.direction, found.density * static_cast<float>(theirs) / static_cast<float>(ours));
  return static_cast<size_t>(found.y) * static_cast<size_t>(job.options.width) + static_cast<size_t>(found.x);
}

// Traces one sample of a pixel. False if the picture is empty there.
[[gnu::flatten]] bool trace_sample(Job& job, const Pass& pass, int x, int y, uint index, size_t pixel, Target target) {
  const int eye = target.eye.eye, width = job.options.width, height = job.options.height;
  const uint seed = pixel_seed(job, eye, x, y);
  const PathState& path = job.tracer.path;
  const vec2 uv = job.tracer.filtered_position(job.filter, x, y, width, height, random_pair(seed, index, kPixelPair));
  const vec2 lens = job.camera.lens_radius > 0.0f ? random_pair(seed, index, kLensPair) : vec2(0.0f);
  if (job.shutter) job.tracer.ray_time = random_pair(seed, index, kTimePair).x;
  Camera moving;
  const Camera* camera = &job.camera;
  if (job.cameras.size() > 1) moving = camera_at(job.cameras, job.tracer.ray_time), camera = &moving;
  const Ray ray = camera_ray(*camera, eye, pixel_center(job, x, y), uv, lens);
  if (ray.direction == vec3(0.0f)) return false;
  job.tracer.start_path(ray, job.media, seed, index);
  const Hit hit = job.embree.closest_hit(job.tracer, ray, kPathRay);
  std::optional<size_t> shared;
  if (job.shares) shared = share_with_other_eye(job, *camera, pass, eye, x, y, uv, hit);
  trace_path(job, hit);
  if (shared) add_shared(path, *shared, *target.other);
  if (job.options.transparent && path.depth < 0.0f) return true;  // the path hit nothing
  if (path.caught) {
    target.eye.caught[pixel]++;
    target.eye.light_with[pixel] += double{path.light_with};
    target.eye.light_without[pixel] += double{path.light_without};
    return true;
  }
  if (!target.eye.hits.empty()) target.eye.hits[pixel]++;
  add_path(path, job.unit, pixel, target.eye);
  return true;
}

// Takes the job by value: each block traces with its own path state.
void render_block(Job job, const Pass& pass, int block, Target target) {
  const size_t b = static_cast<size_t>(block);
  const int first = samples_of(pass.plan, b, pass.from);
  const int x0 = block % pass.plan.columns * kBlockSize, y0 = block / pass.plan.columns * kBlockSize;
  for (int y = y0; y < std::min(y0 + kBlockSize, job.options.height); y++) {
    for (int x = x0; x < std::min(x0 + kBlockSize, job.options.width); x++) {
      const int count = samples_in(pass, x, y);
      if (count == 0) continue;
      const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(job.options.width) + static_cast<size_t>(x);
      if (pass.from == 0 && !target.eye.depth.empty())
        target.eye.depth[pixel] = center_depth(job, target.eye.eye, x, y);
      for (int i = first; i < first + count; i++) {
        if (!trace_sample(job, pass, x, y, static_cast<uint>(i), pixel, target)) break;
      }
      target.eye.count[pixel] += static_cast<uint32_t>(count);
    }
  }
}

// Renders a pass of both eyes from one pool of work. The thread that finishes a block reports what is done of the pass.
void render_pass(const Job& job, const Pass& pass, PictureSamples& samples, const Progress& progress) {
  const int per_eye = static_cast<int>(pass.plan.noisy.size());
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
    const size_t eye = static_cast<size_t>(work / per_eye);
    render_block(job, pass, work % per_eye, {samples.eyes[eye], job.shares ? &samples.eyes[1 - eye] : nullptr});
    done++;
    if (progress.report && reporting.try_lock()) {
      progress.report(static_cast<double>(done) / total);
      reporting.unlock();
    }
  });
  if (stop) throw Error(ErrorKind::kCancelled, "rendering was stopped");
  samples.done = pass.to;
}

// What lies out of focus has no place in the other eye's picture, and a catcher carries no light.
bool can_share(const StereoCamera& camera, const Scene& scene, const RenderOptions& options) {
  return shares_paths(options) && camera.lens_radius == 0.0f && !has_catchers(scene);
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
    render_pass(job, {plan, samples.done, samples.done + step}, samples, part);
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
                  layer_unit(options),
                  can_share(stereo, parts_->scene, options)};
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

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/cpu/render.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "ods/kernel/counterpart.h"
#include "ods/render/center_hit.h"
#include "ods/render/cpu/fill_light_cache.h"
#include "ods/render/cpu/job.h"
#include "ods/render/lights.h"
#include "ods/render/media_at.h"
#include "ods/render/picture_samples.h"
#include "ods/render/render_passes.h"
#include "ods/render/render_target.h"
#include "ods/render/sampling_plan.h"
#include "ods/scene/catchers.h"
#include "ods/scene/portals.h"

namespace ods {
namespace {

Hit center_hit(Job& job, int eye, int x, int y) {
  return center_hit(job.tracer, job.camera, job.media, job.options, eye, x, y,
                    [&](PathTracer& tracer) { return job.embree.closest_hit(tracer, tracer.path.ray, kHalfAlphaRay); });
}

// Depths are not averaged: a depth belongs to the ray through the pixel's centre.
float center_depth(Job& job, int eye, int x, int y) {
  const float depth = center_hit(job, eye, x, y).t;
  return depth < 0.0f ? kFarDepth : job.tracer.path.caught ? -depth : depth;
}

// The weight of a pixel's samples in the pass; 0 if it is clean.
float weight_in(const Pass& pass, int x, int y) {
  const size_t block = block_at(pass.plan, x, y);
  return is_noisy(pass, block, x, y) ? block_weight(pass, block) : 0.0f;
}

// NaN counts as 0.
int64_t fixed(float light) {
  return light > 0.0f ? std::llrint(double{std::min(light, kBrightestSample)} * kLightUnit) : 0;
}

// Atomic, because paths of the other eye may add light to the same pixel at the same time.
template <typename Number>
void add(std::vector<Number>& sums, size_t at, Number value) {
  std::atomic_ref(sums[at]).fetch_add(value, std::memory_order_relaxed);
}

uint32_t fixed_square(float weight) {
  return static_cast<uint32_t>(std::lrint(weight * weight * kWeightUnit));
}

// The light that the paths of a packet found for their own pixel. It is collected here because paths of the other eye
// may add to the pixel at the same time.
struct OwnLight {
  int64_t light[3] = {};
  uint32_t weights = 0;
};

void add_own(const OwnLight& own, size_t pixel, EyeSamples& eye) {
  for (size_t c = 0; c < 3; c++) {
    if (own.light[c] != 0) add(eye.light, 3 * pixel + c, own.light[c]);
  }
  if (!eye.weights.empty()) add(eye.weights, pixel, own.weights);
}

// Adds the light that a path found for its own pixel.
void add_light(const PathState& path, double unit, size_t pixel, EyeSamples& eye, OwnLight& own) {
  const bool alone = !eye.alone.empty();
  for (size_t c = 0; c < 3; c++) {
    const int i = static_cast<int>(c);
    own.light[c] += fixed(path.radiance[i]);
    if (!eye.squares.empty()) {
      const double light = static_cast<double>(fixed(alone ? path.alone_radiance[i] : path.radiance[i])) / kLightUnit;
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
  own.weights += fixed_square(weight);
}

// Adds the light that a path of the other eye found for this pixel.
void add_shared(const PathState& path, size_t pixel, EyeSamples& eye) {
  for (size_t c = 0; c < 3; c++) add(eye.light, 3 * pixel + c, fixed(path.other_radiance[static_cast<int>(c)]));
  if (!eye.weights.empty()) add(eye.weights, pixel, fixed_square(1.0f - path.own_share));
}

// One eye's pixels, and the pixels of the eye that shares their paths.
struct Target {
  EyeSamples& eye;
  EyeSamples* other;
};

// The first rays of a pixel's samples, traced at once, and the counterparts of their hits in the other eye.
struct FirstHits {
  RayPacket packet;
  vec2 uv[RayPacket::kMax];
  Hit hits[RayPacket::kMax];
  Counterpart counterparts[RayPacket::kMax];  // `exists` if both eyes see the hit
};

// Returns false if the picture is empty at the pixel.
[[gnu::flatten]] bool trace_first_rays(Job& job, int eye, int x, int y, int first, FirstHits& out) {
  const vec2 home = pixel_center(job.options, x, y);
  RayPacket& packet = out.packet;
  packet.count = std::min(RayPacket::kMax, job.options.samples - first);
  packet.seed = pixel_seed(job.options, eye, x, y);
  packet.index = static_cast<uint>(first);
  for (int i = 0; i < packet.count; i++) {
    const uint index = packet.index + static_cast<uint>(i);
    const vec2 place = random_pair(packet.seed, index, kPixelPair);
    out.uv[i] = job.tracer.filtered_position(job.filter, x, y, job.options.width, job.options.height, place);
    const FirstRay first_of = first_ray(job, eye, home, out.uv[i], packet.seed, index);
    if (first_of.ray.direction == vec3(0.0f)) return false;
    packet.rays[i] = first_of.ray;
    packet.times[i] = first_of.time;
  }
  job.embree.closest_hits(job.tracer, packet, out.hits);
  return true;
}

// Finds the counterparts of the hits that the other eye sees, too.
[[gnu::flatten]] void find_counterparts(Job& job, int eye, int x, int y, FirstHits& out) {
  const vec2 size(static_cast<float>(job.options.width), static_cast<float>(job.options.height));
  const vec2 pixel(static_cast<float>(x), static_cast<float>(y));
  RayPacket back = out.packet;
  bool any = false;
  for (int i = 0; i < back.count; i++) {
    const Ray ray = out.packet.rays[i];
    Counterpart& found = out.counterparts[i];
    found.exists = false;
    back.lengths[i] = 0.0f;
    if (out.hits[i].t < 0.0f) continue;
    const Camera camera = camera_at_time(job, back.times[i]);
    found = counterpart_of(camera, job.filter, size, eye, pixel, out.uv[i], ray.direction,
                           ray.origin + ray.direction * out.hits[i].t);
    if (!found.exists) continue;
    any = true;
    back.rays[i] = {found.origin, found.direction};
    back.lengths[i] = found.distance * (1.0f - 1e-4f);  // just short of the surface
  }
  if (!any) return;
  bool hidden[RayPacket::kMax];
  job.embree.occluded(job.tracer, back, hidden);
  for (int i = 0; i < back.count; i++) out.counterparts[i].exists &= !hidden[i];
}

// Adds a finished path that began in this pixel.
void add_path(const Job& job, size_t pixel, EyeSamples& eye, OwnLight& own) {
  const PathState& path = job.tracer.path;
  if (job.options.transparent && path.depth < 0.0f) return;  // it hit nothing
  if (path.caught) {
    eye.caught[pixel]++;
    eye.light_with[pixel] += fixed(path.light_with);
    eye.light_without[pixel] += fixed(path.light_without);
    return;
  }
  if (!eye.hits.empty()) eye.hits[pixel]++;
  add_light(path, job.unit, pixel, eye, own);
}

// Traces the packet's samples in `range`. Returns false if the projection has no ray for the pixel. A ray's hit may
// depend on the other rays of its packet where surfaces coincide, so packets are the same for every range.
bool trace_packet(Job& job, const Pass& pass, int x, int y, int packet, SampleRange range, Target target) {
  const size_t width = static_cast<size_t>(job.options.width);
  const size_t pixel = static_cast<size_t>(y) * width + static_cast<size_t>(x);
  FirstHits start;
  if (!trace_first_rays(job, target.eye.eye, x, y, packet * RayPacket::kMax, start)) return false;
  if (job.shares) find_counterparts(job, target.eye.eye, x, y, start);
  const float ours = weight_in(pass, x, y);
  OwnLight own;
  for (int i = 0; i < start.packet.count; i++) {
    const int index = packet * RayPacket::kMax + i;
    if (index < range.begin || index >= range.end) continue;
    job.tracer.ray_time = start.packet.times[i];
    job.tracer.start_path(start.packet.rays[i], job.media, start.packet.seed, static_cast<uint>(index));
    const Counterpart& other = start.counterparts[i];
    const float theirs = job.shares && other.exists ? weight_in(pass, other.x, other.y) : 0.0f;
    if (theirs > 0.0f) job.tracer.share_path(other.direction, other.density * theirs / ours);
    trace_path(job, start.hits[i], [](const PathStep&) {});
    if (theirs > 0.0f) {
      add_shared(job.tracer.path, static_cast<size_t>(other.y) * width + static_cast<size_t>(other.x), *target.other);
    }
    add_path(job, pixel, target.eye, own);
  }
  add_own(own, pixel, target.eye);
  return true;
}

// Takes the job by value: each block traces with its own path state.
void render_block(Job job, const Pass& pass, int block, Target target) {
  const size_t b = static_cast<size_t>(block);
  const int first = samples_of(pass.plan, b, pass.from), last = samples_of(pass.plan, b, pass.to);
  const int x0 = block % pass.plan.columns * kBlockSize, y0 = block / pass.plan.columns * kBlockSize;
  for (int y = y0; y < std::min(y0 + kBlockSize, job.options.height); y++) {
    for (int x = x0; x < std::min(x0 + kBlockSize, job.options.width); x++) {
      if (!is_noisy(pass, b, x, y)) continue;
      const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(job.options.width) + static_cast<size_t>(x);
      if (is_first(pass, job.options) && !target.eye.depth.empty())
        target.eye.depth[pixel] = center_depth(job, target.eye.eye, x, y);
      for (int i = first / RayPacket::kMax; i * RayPacket::kMax < last; i++) {
        if (!trace_packet(job, pass, x, y, i, {first, last}, target)) break;
      }
      target.eye.count[pixel] += static_cast<uint32_t>(last - first);
    }
  }
}

class CpuPasses : public PassDevice {
 public:
  CpuPasses(const Job& job, PictureSamples& samples) : job_(job), samples_(samples) {}

  bool render_blocks(const Pass& pass, BlockRange blocks, const Progress& progress, bool whole) override {
    const int per_eye = static_cast<int>(samples_.noisy.size());
    const int total = per_eye * static_cast<int>(samples_.eyes.size());
    std::atomic<int> done = blocks.begin;
    std::atomic<bool> stop = false;
    std::mutex reporting;
    tbb::parallel_for(blocks.begin, blocks.end, [&](int i) {
      const int work = job_.options.last_tile_first ? total - 1 - i : i;
      if (stop || (!whole && progress.cancelled && progress.cancelled())) {
        stop = true;
        return;
      }
      const size_t eye = static_cast<size_t>(work / per_eye);
      render_block(job_, pass, work % per_eye, {samples_.eyes[eye], job_.shares ? &samples_.eyes[1 - eye] : nullptr});
      done++;
      if (!progress.report) return;
      if (const std::unique_lock free(reporting, std::try_to_lock); free) {
        progress.report(static_cast<double>(done) / total);
      }
    });
    return !stop;
  }

 private:
  const Job& job_;
  PictureSamples& samples_;
};

}  // namespace

struct CpuRenderer::Parts {
  Parts(const Scene& wanted, int threads) : scene(wanted), arena(threads > 0 ? threads : tbb::task_arena::automatic) {
    arena.execute([&] {
      lights = make_lights(scene);
      embree.emplace(scene);
      set_scene(tracer, scene, lights);
      portals = find_portals(scene);
    });
  }

  // Samples the environment through portals, if the viewer sees it through them.
  void use_portals(PathTracer& here, vec3 viewer) const {
    if (lights.environment.light < 0) return;
    const auto escapes = [&](vec3 direction) {
      const Ray ray{viewer, direction};
      here.start_path(ray, no_media(), 0u, 0u);
      return !embree->occluded(here, ray, kFarAway);
    };
    if (!show_the_sky(portals, viewer, escapes)) return;
    here.portals = portals.data();
    here.portal_count = static_cast<int>(portals.size());
  }

  // Precondition: the cameras outlive the job.
  Job make_job(const StereoCamera& stereo, std::span<const Camera> cameras, const RenderOptions& options) const {
    PathTracer here = tracer;
    here.ray_time = 0.5f;
    here.straight_solids = options.caustics == Caustics::kStraight;
    const Media media =
        media_at(here, stereo.position, [&](const Ray& ray) { return embree->closest_hit(here, ray, kHalfAlphaRay); });
    return {*embree,
            here,
            cameras,
            cameras[cameras.size() / 2],
            cameras.size() > 1 || scene.motion_keys > 1,
            media,
            options,
            path_settings(options),
            options.filter == PixelFilter::kBox ? kFilterBox : kFilterBlackmanHarris,
            layer_unit(options),
            can_share(stereo, scene, options)};
  }

  const Scene& scene;
  mutable tbb::task_arena arena;
  LightTable lights;
  std::vector<Portal> portals;
  std::optional<EmbreeScene> embree;
  PathTracer tracer;
};

CpuRenderer::CpuRenderer(const Scene& scene, int threads) : parts_(std::make_unique<Parts>(scene, threads)) {}

CpuRenderer::~CpuRenderer() = default;

void CpuRenderer::update(const SceneChange& change) {
  if (change.instances.empty() && change.meshes.empty() && !change.lights && !change.materials) return;
  parts_->arena.execute([&] {
    update_lights(parts_->scene, parts_->lights);
    if (!change.instances.empty() || !change.meshes.empty() || change.materials) {
      parts_->portals = find_portals(parts_->scene);
    }
    parts_->embree->update(change);
    set_scene(parts_->tracer, parts_->scene, parts_->lights);
  });
}

void CpuRenderer::sample(std::span<const StereoCamera> path, const RenderOptions& options, PictureSamples& samples,
                         const Progress& progress, const KeepSamples& keep, const LightCells* cells) const {
  assert(path.size() % 2 == 1 && fit(samples, options));
  assert(options.transparent || !has_catchers(parts_->scene));
  const StereoCamera& stereo = path[path.size() / 2];
  assert(fit_camera(options, stereo));
  const std::vector<Camera> cameras = cameras_of(path);
  parts_->arena.execute([&] {
    Job job = parts_->make_job(stereo, cameras, options);
    parts_->use_portals(job.tracer, stereo.position);
    const LightCells own = cells ? LightCells() : fill_light_cache(job, progress);
    show_light_cache(job, cells ? *cells : own);
    CpuPasses device(job, samples);
    render_passes(device, make_plan(stereo, options), options, samples, progress, keep);
  });
}

LightCells CpuRenderer::fill_cells(std::span<const StereoCamera> path, const RenderOptions& options,
                                   const Progress& progress) const {
  const StereoCamera& stereo = path[path.size() / 2];
  const std::vector<Camera> cameras = cameras_of(path);
  return parts_->arena.execute([&] {
    Job job = parts_->make_job(stereo, cameras, options);
    parts_->use_portals(job.tracer, stereo.position);
    return fill_light_cache(job, progress);
  });
}

std::vector<std::vector<Hit>> CpuRenderer::center_hits(const StereoCamera& stereo, const RenderOptions& options) const {
  const Camera camera = make_camera(stereo);
  std::vector<std::vector<Hit>> hits;
  parts_->arena.execute([&] {
    const Job job = parts_->make_job(stereo, {&camera, 1}, options);
    for (const int eye : eye_list(options.eyes)) {
      const size_t width = static_cast<size_t>(options.width);
      std::vector<Hit>& own = hits.emplace_back(width * static_cast<size_t>(options.height));
      tbb::parallel_for(0, options.height, [&](int y) {
        Job row = job;
        Hit* to = &own[static_cast<size_t>(y) * width];
        for (int x = 0; x < options.width; x++) to[x] = center_hit(row, eye, x, y);
      });
    }
  });
  return hits;
}

Picture render_cpu(const Scene& scene, const StereoCamera& stereo, const RenderOptions& options,
                   const Progress& progress) {
  check_picture_memory(with_height(options, stereo));  // before the trees are built
  return CpuRenderer(scene, options.threads).render(stereo, options, progress);
}

}  // namespace ods

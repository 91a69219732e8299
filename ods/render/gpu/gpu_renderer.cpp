// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/gpu/gpu_renderer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <optional>

#include "ods/base/error.h"
#include "ods/render/center_hit.h"
#include "ods/render/gpu/gpu_device.h"
#include "ods/render/gpu/gpu_lacks.h"
#include "ods/render/gpu/gpu_passes.h"
#include "ods/render/gpu/gpu_scene.h"
#include "ods/render/media_at.h"
#include "ods/render/render_passes.h"
#include "ods/render/render_target.h"
#include "ods/scene/catchers.h"
#include "ods/scene/portals.h"

namespace ods {
namespace {

// Pixels that are rendered at once: enough to fill the largest cards, 214 MB.
constexpr int kSlots = 1 << 19;
constexpr int kSoftwareSlots = 1 << 13;

bool has_layers(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) { return m.layers >= 0; });
}

// A picture's camera, and the maps and rays that it has, on the device.
class GpuCamera {
 public:
  GpuCamera(GpuDevice& device, const Camera& camera, GpuView& view)
      : device_(device),
        merge_(put(camera.merge_map, camera.merge_texels)),
        head_tilt_(put(camera.head_tilt_map, camera.head_tilt_texels)),
        texel_rays_(put(camera.texel_rays, camera.texel_table)) {
    std::memcpy(view.camera.data(), &camera, kCameraBytes);
    view.merge_map = merge_.address;
    view.head_tilt_map = head_tilt_.address;
    view.texel_rays = texel_rays_.address;
  }
  ~GpuCamera() {
    device_.free(merge_);
    device_.free(head_tilt_);
    device_.free(texel_rays_);
  }
  GpuCamera(const GpuCamera&) = delete;
  GpuCamera& operator=(const GpuCamera&) = delete;

 private:
  template <typename Value>
  GpuBuffer put(const CameraMap& map, const Value* texels) {
    const std::span values(texels, static_cast<size_t>(map.width) * static_cast<size_t>(map.height));
    const GpuBuffer buffer = device_.make_buffer(values.size_bytes());
    device_.upload(buffer, 0, std::as_bytes(values));
    return buffer;
  }

  GpuDevice& device_;
  GpuBuffer merge_, head_tilt_, texel_rays_;
};

}  // namespace

struct GpuRenderer::Parts {
  Parts(const Scene& wanted, std::shared_ptr<GpuDevice> on, int wanted_slots)
      : scene(wanted), device(std::move(on)), slots(wanted_slots) {
    world = make_world(scene);
    on_card.emplace(*device, scene, world);
    stages = make_stages(*device, has_layers(scene) || has_catchers(scene));
    if (slots == 0) slots = device->info().kind == GpuKind::kSoftware ? kSoftwareSlots : kSlots;
  }

  TreeTracer tracer_for(const RenderOptions& options) const {
    TreeTracer tracer = world.tracer;
    tracer.ray_time = 0.5f;
    tracer.straight_solids = options.caustics == Caustics::kStraight;
    return tracer;
  }

  Media media_around(TreeTracer& tracer, vec3 viewer) const {
    return media_at(tracer, viewer, [&](const Ray& ray) { return tracer.nearest_in_tree(ray, kHalfAlphaRay); });
  }

  // Returns whether the viewer sees the environment through the portals.
  bool uses_portals(TreeTracer& tracer, vec3 viewer) const {
    if (world.lights.environment.light < 0) return false;
    return show_the_sky(world.portals, viewer, [&](vec3 direction) {
      const Ray ray{viewer, direction};
      tracer.start_path(ray, no_media(), 0u, 0u);
      return !tracer.along_tree(ray, kFarAway, kShadowRay).blocked;
    });
  }

  GpuView view_of(const StereoCamera& stereo, const RenderOptions& options) const {
    TreeTracer tracer = tracer_for(options);
    GpuView view;
    on_card->describe(view);
    view.media = media_around(tracer, stereo.position);
    view.portal_count = uses_portals(tracer, stereo.position) ? static_cast<int>(world.portals.size()) : 0;
    view.width = options.width, view.height = options.height;
    view.columns = block_columns(options);
    view.blocks = static_cast<int>(block_count(options));
    const std::vector<int> eyes = eye_list(options.eyes);
    view.first_eye = eyes[0], view.second_eye = eyes.size() > 1 ? eyes[1] : -1;
    view.filter_shape = options.filter == PixelFilter::kBox ? kFilterBox : kFilterBlackmanHarris;
    view.bounces = options.bounces;
    view.light_sampling = static_cast<int>(options.light_sampling);
    view.clamp = options.clamp;
    view.layer_unit = static_cast<float>(layer_unit(options));
    view.seed = options.seed;
    view.shares = can_share(stereo, scene, options) ? 1 : 0;
    view.is_transparent = options.transparent ? 1 : 0;
    view.straight_solids = tracer.straight_solids ? 1 : 0;
    return view;
  }

  const Scene& scene;
  std::shared_ptr<GpuDevice> device;
  int slots;
  GpuWorld world;
  std::optional<GpuScene> on_card;
  GpuStages stages{};
  GpuTimes times;
};

GpuRenderer::GpuRenderer(const Scene& scene, std::shared_ptr<GpuDevice> device, int slots)
    : parts_(std::make_unique<Parts>(scene, std::move(device), slots)) {}

GpuRenderer::~GpuRenderer() = default;

const GpuTimes& GpuRenderer::times() const {
  return parts_->times;
}

void GpuRenderer::update(const SceneChange& change) {
  if (change.instances.empty() && change.meshes.empty() && !change.lights && !change.materials) return;
  parts_->on_card.reset();
  parts_->world = make_world(parts_->scene);
  parts_->on_card.emplace(*parts_->device, parts_->scene, parts_->world);
}

void GpuRenderer::sample(std::span<const StereoCamera> path, const RenderOptions& options, PictureSamples& samples,
                         const Progress& progress, const KeepSamples& keep,
                         [[maybe_unused]] const LightCells* cells) const {
  assert(path.size() % 2 == 1 && fit(samples, options));
  assert(!cells);  // CpuRenderer::fill_cells() makes them, for itself
  const bool is_blurred = path.size() > 1 || parts_->scene.motion_keys > 1;
  const std::string lacks = gpu_lacks(parts_->scene, options, is_blurred);
  if (!lacks.empty()) throw Error(ErrorKind::kUsage, lacks);
  const StereoCamera& stereo = path.front();
  assert(fit_camera(options, stereo));
  GpuView view = parts_->view_of(stereo, options);
  const GpuCamera camera(*parts_->device, make_camera(stereo), view);
  GpuPasses passes(*parts_->device, parts_->stages, view, parts_->slots, options, samples);
  render_passes(passes, make_plan(stereo, options), options, samples, progress, keep);
  GpuTimes& times = parts_->times;
  times.trace += passes.times().trace, times.begin += passes.times().begin, times.shade += passes.times().shade;
}

std::vector<std::vector<Hit>> GpuRenderer::center_hits(const StereoCamera& stereo, const RenderOptions& options) const {
  const Camera camera = make_camera(stereo);
  TreeTracer tracer = parts_->tracer_for(options);
  const Media media = parts_->media_around(tracer, stereo.position);
  std::vector<std::vector<Hit>> hits;
  for (const int eye : eye_list(options.eyes)) {
    const size_t width = static_cast<size_t>(options.width);
    std::vector<Hit>& own = hits.emplace_back(width * static_cast<size_t>(options.height));
    tbb::parallel_for(0, options.height, [&](int y) {
      TreeTracer row = tracer;
      Hit* to = &own[static_cast<size_t>(y) * width];
      for (int x = 0; x < options.width; x++) {
        to[x] = center_hit(row, camera, media, options, eye, x, y,
                           [](TreeTracer& each) { return each.nearest_in_tree(each.path.ray, kHalfAlphaRay); });
      }
    });
  }
  return hits;
}

}  // namespace ods

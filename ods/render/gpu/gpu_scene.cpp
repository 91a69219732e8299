// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/gpu/gpu_scene.h"

#include <span>

#include "ods/scene/portals.h"

namespace ods {

GpuWorld make_world(const Scene& scene) {
  GpuWorld world;
  world.lights = make_lights(scene);
  world.tree = make_tree(scene);
  world.portals = find_portals(scene);
  set_scene(world.tracer, scene, world.lights);
  world.tracer.tree_nodes = world.tree.nodes.data();
  world.tracer.tree_triangles = world.tree.triangles.data();
  return world;
}

template <typename T>
uint64_t GpuScene::put(const T* from, size_t count) {
  const GpuBuffer& buffer = buffers_.emplace_back(device_.make_buffer(count * sizeof(T)));
  device_.upload(buffer, 0, std::as_bytes(std::span(from, count)));
  return buffer.address;
}

GpuScene::GpuScene(GpuDevice& device, const Scene& scene, const GpuWorld& world) : device_(device) {
  const auto all = [&](const auto& list) { return put(list.data(), list.size()); };
  view_.vertices = all(scene.vertices);
  view_.triangles = all(scene.triangles);
  view_.meshes = all(scene.meshes);
  view_.instances = all(world.lights.instances);
  view_.materials = all(scene.materials);
  view_.material_layers = all(scene.material_layers);
  view_.textures = all(scene.textures);
  view_.texels = all(scene.texels);
  const bool reduced = !scene.reduced_textures.empty();
  view_.reduced_textures = reduced ? all(scene.reduced_textures) : view_.textures;
  view_.reduced_texels = reduced ? all(scene.reduced_texels) : view_.texels;
  view_.lights = all(world.lights.lights);
  view_.light_picks = all(world.lights.picks);
  view_.light_nodes = all(world.lights.tree.nodes);
  view_.light_ways = all(world.lights.tree.ways);
  view_.environment_texels = all(world.lights.environment_texels);
  view_.environment_rows = all(world.lights.environment_rows);
  view_.portals = all(world.portals);
  view_.tables = put(world.tracer.tables, kTablesSize);
  view_.tree_nodes = all(world.tree.nodes);
  view_.tree_triangles = all(world.tree.triangles);
  view_.environment = world.tracer.environment;
  view_.background = world.tracer.background;
  view_.light_pick_count = world.tracer.light_pick_count;
}

GpuScene::~GpuScene() {
  for (const GpuBuffer& buffer : buffers_) device_.free(buffer);
}

void GpuScene::describe(GpuView& view) const {
  view = view_;
}

}  // namespace ods

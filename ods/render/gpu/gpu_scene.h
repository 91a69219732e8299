// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A scene in the memory of a graphics card, and the tree by which both the card and the host follow rays.
#pragma once
#include <vector>

#include "ods/render/gpu/gpu_device.h"
#include "ods/render/gpu/shaders/shared.h"
#include "ods/render/gpu/tree.h"
#include "ods/render/lights.h"
#include "ods/scene/scene.h"

namespace ods {

// The scene's lights and tree, for the host.
struct GpuWorld {
  LightTable lights;
  SceneTree tree;
  std::vector<Portal> portals;
  TreeTracer tracer;  // reads the scene, the lights and the tree
};

// The scene must outlive the result.
GpuWorld make_world(const Scene& scene);

class GpuScene {
 public:
  // Copies the scene to the device, which must outlive this object.
  GpuScene(GpuDevice& device, const Scene& scene, const GpuWorld& world);
  ~GpuScene();
  GpuScene(const GpuScene&) = delete;
  GpuScene& operator=(const GpuScene&) = delete;

  // Fills in the scene's part of a view: the addresses of its arrays, and its environment.
  void describe(GpuView& view) const;

 private:
  template <typename T>
  uint64_t put(const T* from, size_t count);

  GpuDevice& device_;
  GpuView view_{};
  std::vector<GpuBuffer> buffers_;
};

}  // namespace ods

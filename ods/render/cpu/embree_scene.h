// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scene's triangles in Embree: closest hit and occlusion for the kernel's rays.
#pragma once
#include <memory>

#include "ods/kernel/path.h"
#include "ods/scene/motion.h"

namespace ods {

class EmbreeScene {
 public:
  // Builds the acceleration structures on the calling thread's TBB arena. The scene must outlive this object.
  // Meshes that stand in the scene more than once become Embree instances only where copies would be many: a tree over
  // plain triangles is traced up to twice as fast, and a million of them cost about 150 MB.
  // Where something plays (Animation::playing), what moves has trees of its own beside one of all that stands still.
  explicit EmbreeScene(const Scene& scene, size_t max_copied_triangles = 1500000);
  ~EmbreeScene();

  // What set_time() has changed: only the trees of meshes that were bent are built again, and the one over all parts.
  // Leaves what a new EmbreeScene would be. Precondition: the scene is that of the constructor, with the same
  // clips playing and as many keys of the shutter.
  void update(const SceneChange& change);

  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // Safe from many threads at once, each with a tracer of its own that reads the same scene; it is asked about surfaces
  // with alpha. kind: kPathRay or kHalfAlphaRay.
  Hit closest_hit(PathTracer& tracer, const Ray& ray, int kind) const;
  bool occluded(PathTracer& tracer, const Ray& ray, float length) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace ods

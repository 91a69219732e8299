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
  // Builds the acceleration structures in the calling thread's TBB arena. The scene must outlive this object.
  // Meshes that occur in the scene more than once become Embree instances only if there would be many copies: a tree
  // over plain triangles is traced up to twice as fast, and a million of them cost about 150 MB.
  // If something plays (Animation::playing), what moves has its own trees beside one of all that does not.
  explicit EmbreeScene(const Scene& scene, size_t max_copied_triangles = 1500000);
  ~EmbreeScene();

  // Applies what set_time() changed: rebuilds only the trees of meshes that deformed, and the one over all parts.
  // The result equals a new EmbreeScene. Precondition: the scene is that of the constructor, with the same clips
  // playing and as many keys of the shutter.
  void update(const SceneChange& change);

  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // Safe from many threads at once. Each needs its own tracer, which reads the same scene and decides about surfaces
  // with alpha. kind: how it decides, kPathRay, kShadowRay or kHalfAlphaRay.
  Hit closest_hit(PathTracer& tracer, const Ray& ray, int kind) const;
  bool occluded(PathTracer& tracer, const Ray& ray, float length, int kind = kShadowRay) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scene's triangles in Embree: closest hit and occlusion for the kernel's rays.
#pragma once
#include <memory>

#include "ods/kernel/path.h"
#include "ods/scene/motion.h"

namespace ods {

// Rays that are traced at once, from the samples of one pixel, with nearly the same directions.
struct RayPacket {
  static constexpr int kMax = 16;
  int count = 0;
  Ray rays[kMax];
  float times[kMax];    // values of ray_time
  float lengths[kMax];  // for occluded(); 0 if there is no ray
  uint seed = 0;        // seed of the paths that start with these rays
  uint index = 0;       // index of the first ray's sample; the others follow
};

class EmbreeScene {
 public:
  static constexpr size_t kMaxCopiedTriangles = 1500000;

  // Builds the acceleration structures in the calling thread's TBB arena. The scene must outlive this object. Meshes
  // that occur in the scene more than once become Embree instances only if there would be many copies: a tree over
  // plain triangles is traced up to twice as fast, and a million of them cost about 150 MB. If clips are playing
  // (Animation::playing), moving objects have their own trees beside one tree of all static objects. left_out: for each
  // instance, whether rays never meet it; if empty, rays meet all instances.
  explicit EmbreeScene(const Scene& scene, size_t max_copied_triangles = kMaxCopiedTriangles,
                       const std::vector<char>& left_out = {});
  ~EmbreeScene();

  // Applies changes by set_time(): rebuilds only the trees of meshes that deformed, and the one over all parts.
  // The result equals a new EmbreeScene. Precondition: the scene is that of the constructor, with the same clips
  // playing and as many keys of the shutter.
  void update(const SceneChange& change);

  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // Safe from many threads at once. Each needs its own tracer, which reads the same scene and decides about surfaces
  // with alpha. kind: the kind of ray for these decisions, kPathRay, kShadowRay or kHalfAlphaRay.
  Hit closest_hit(PathTracer& tracer, const Ray& ray, int kind) const;
  // clear: if not null, receives the number of surfaces of clear glass that a shadow ray met. They do not stop it.
  bool occluded(PathTracer& tracer, const Ray& ray, float length, int kind = kShadowRay, int* clear = nullptr) const;

  // Returns whether light arrives along the path's shadow ray, and reduces it by clear glass in between.
  bool reaches_light(PathTracer& tracer) const;

  // Traces the first rays of paths as packets, several times as fast. hits and hidden have packet.count entries.
  void closest_hits(PathTracer& tracer, const RayPacket& packet, Hit* hits) const;
  void occluded(PathTracer& tracer, const RayPacket& packet, bool* hidden) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace ods

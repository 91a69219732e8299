// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scene's triangles in Embree: closest hit and occlusion for the kernel's rays.
#pragma once
#include <memory>

#include "ods/kernel/path.h"
#include "ods/scene/motion.h"

namespace ods {

// Rays that are traced at once: of one pixel's samples, which go nearly the same way.
struct RayPacket {
  static constexpr int kMost = 16;
  int count = 0;
  Ray rays[kMost];
  float times[kMost];    // of ray_time
  float lengths[kMost];  // for occluded(); 0: no ray
  uint seed = 0;         // of the paths that the rays begin
  uint index = 0;        // of the first one's sample; the others follow
};

class EmbreeScene {
 public:
  static constexpr size_t kMaxCopiedTriangles = 1500000;

  // Builds the acceleration structures in the calling thread's TBB arena. The scene must outlive this object.
  // Meshes that occur in the scene more than once become Embree instances only if there would be many copies: a tree
  // over plain triangles is traced up to twice as fast, and a million of them cost about 150 MB.
  // If something plays (Animation::playing), what moves has its own trees beside one of all that does not.
  // left_out: for each instance whether rays never meet it; empty: they meet all.
  explicit EmbreeScene(const Scene& scene, size_t max_copied_triangles = kMaxCopiedTriangles,
                       const std::vector<char>& left_out = {});
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
  // clear, if wanted: the number of surfaces of clear glass that a shadow ray met. They do not stop it.
  bool occluded(PathTracer& tracer, const Ray& ray, float length, int kind = kShadowRay, int* clear = nullptr) const;

  // Whether light comes along the path's shadow ray. Clear glass in between takes its part of it.
  bool reaches_light(PathTracer& tracer) const;

  // The same for the first rays of paths, several times as fast. hits and hidden have packet.count entries.
  void closest_hits(PathTracer& tracer, const RayPacket& packet, Hit* hits) const;
  void occluded(PathTracer& tracer, const RayPacket& packet, bool* hidden) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace ods

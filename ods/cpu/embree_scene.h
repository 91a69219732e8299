// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scene's triangles in Embree: closest hit and occlusion for the kernel's rays.
#pragma once
#include <memory>

#include "ods/kernel/path.h"
#include "ods/scene/scene.h"

namespace ods {

class EmbreeScene {
 public:
  // Builds the acceleration structures on the calling thread's TBB arena. The scene must outlive this object.
  explicit EmbreeScene(const Scene& scene);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // Safe from many threads at once. tracer reads the same scene; key numbers the ray for surfaces with alpha.
  Hit closest_hit(PathTracer& tracer, const Ray& ray, uint key) const;
  bool occluded(PathTracer& tracer, const Ray& ray, float length, uint key) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace ods

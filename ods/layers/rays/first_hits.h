// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The first surfaces of a scene along rays, past thin glass and after one reflection in flat mirrors.
//
// The surfaces that a mirror shows have numbers of instances of their own, as if it were a second scene behind the mirror's plane.
#pragma once
#include <memory>
#include <vector>

#include "ods/layers/rays/mirrors.h"
#include "ods/render/cpu/embree_scene.h"
#include "ods/render/lights.h"
#include "ods/scene/scene.h"

namespace ods {

// The numbers of instances, seen directly and in mirrors. The sky in a mirror counts as an instance.
struct SeenInstances {
  int count = 0;    // of the scene
  int mirrors = 0;  // whose reflections are followed

  int in_mirror(int mirror, int instance) const { return count * (1 + mirror) + instance; }
  int sky_in(int mirror) const { return count * (1 + mirrors) + mirror; }
  int total() const { return count * (1 + mirrors) + mirrors; }

  bool is_sky(int number) const { return number >= count * (1 + mirrors); }
  // -1 if it is seen directly.
  int mirror_of(int number) const { return is_sky(number) ? number - count * (1 + mirrors) : number / count - 1; }
  // The scene's instance. Precondition: it is not the sky.
  int real(int number) const { return number % count; }
};

// A surface as seen along a ray.
struct FirstHit {
  float distance = -1.0f;  // from the place, along the whole path; negative if the ray leaves the scene
  vec3 normal{0.0f};       // of the triangle, towards the place, as it looks from there; unit length
  int instance = -1;       // as numbered by SeenInstances
  int triangle = -1;
  bool front = true;  // its front, as its winding defines it
};

// The first surfaces along rays. A surface with alpha is met at random, with its alpha as the probability.
class FirstHits {
 public:
  // The scene must outlive this object. panes: by instance, whether rays pass it; none if empty.
  explicit FirstHits(const Scene& scene, const std::vector<char>& panes = {});

  // Follows reflections in these mirrors from now on. The sky that they show is at this distance.
  void set_mirrors(std::vector<FlatMirror> mirrors, float sky_distance);

  // Rays from one place; `seen` has as many entries. Safe from many threads at once.
  void look(vec3 from, const vec3* directions, int count, FirstHit* seen) const;

  const Scene& scene() const { return scene_; }
  const std::vector<FlatMirror>& mirrors() const { return mirrors_; }
  float sky_distance() const { return sky_distance_; }
  SeenInstances numbers() const;

  // The mirror that a triangle belongs to; -1 for none.
  int mirror_at(int instance, int triangle) const;

 private:
  void trace(RayPacket& packet, FirstHit* seen) const;
  void follow(vec3 from, const vec3* directions, int count, FirstHit* seen) const;  // those that have met mirrors

  const Scene& scene_;
  LightTable no_lights_;
  EmbreeScene embree_;
  PathTracer tracer_;
  std::vector<FlatMirror> mirrors_;
  float sky_distance_ = 0.0f;
};

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Measures a scene by rays: how far surfaces are, and where the scene is open. All results are functions of the scene
// alone, with the same bits whatever the number of threads. Lengths are in the scene's own units, directions are unit
// vectors.
#pragma once
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "ods/render/cpu/embree_scene.h"
#include "ods/render/lights.h"
#include "ods/scene/scene.h"

namespace ods {

// What a ray meets. Surfaces with less than half alpha do not count, glass does.
struct Sight {
  float distance = std::numeric_limits<float>::infinity();  // infinite: the ray leaves the scene
  bool front = true;                                        // it meets the surface's front, as its winding defines it
  bool two_sided = false;                                   // its material is made to be seen from both sides
  bool clear = false;                                       // the surface lets light through: glass
  vec3 normal{0.0f};                                        // of the triangle, on the side that the ray comes from
  int instance = -1;
  int triangle = -1;

  bool leaves() const { return instance < 0; }
};

class SceneRays {
 public:
  // Builds the acceleration structure for the scene as it stands, without what repeats (ods/stage/repeats.h). The scene
  // must outlive this object, and whoever changes its geometry builds a new one.
  explicit SceneRays(const Scene& scene);

  const Scene& scene() const { return scene_; }

  // Whether rays can meet an instance: it is visible, and no other lies exactly there.
  bool meets(size_t instance) const { return repeats_[instance] == 0 && !is_hidden(scene_, instance); }

  // Safe from many threads at once.
  Sight look(vec3 from, vec3 direction) const;

  // The distance to the first surface; infinite if there is none.
  float distance(vec3 from, vec3 direction) const { return look(from, direction).distance; }

  // Whether light that arrives along this direction comes from outside: glass does not stop it.
  bool is_open(vec3 from, vec3 direction) const;

 private:
  const Scene& scene_;
  LightTable no_lights_;
  std::vector<char> repeats_;
  EmbreeScene embree_;
  PathTracer tracer_;
};

// The unit vector at angles in degrees: yaw from -Z towards +X, elevation from the horizon towards +Y.
vec3 direction_at(float yaw, float elevation);

// Directions spread evenly over the sphere.
std::vector<vec3> sphere_directions(int count);

// How far the nearest surface is from a point, by rays in all directions: things thinner than a tenth of that distance
// may be missed. Infinite if there is none.
float free_radius(const SceneRays& rays, vec3 point);

// Whether free_radius() is at least this.
bool is_free(const SceneRays& rays, vec3 point, float radius);

// The box around what is seen from a point, without the farthest 4 percent in each direction of an axis.
Bounds seen_bounds(const SceneRays& rays, vec3 point);

// The shares of directions from a point that leave the scene, through glass too.
struct Openness {
  float upper = 1.0f;  // of the directions above the horizon
  float whole = 1.0f;
};
Openness openness(const SceneRays& rays, vec3 point);

// What the surfaces around a point show of themselves, as shares of all directions.
struct Surroundings {
  float fronts = 0.0f;
  float backs = 0.0f;                                      // inside a solid model all surfaces show their backs
  float nearest = std::numeric_limits<float>::infinity();  // free_radius()
};
Surroundings surroundings(const SceneRays& rays, vec3 point);

// The height of the floor below a point: of the first surface there, if it is no steeper than 45 degrees.
std::optional<float> floor_below(const SceneRays& rays, vec3 point);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Measures a scene by rays: how far surfaces are, and where the scene is open. All results are functions of the scene
// alone, with the same bits for any number of threads. Lengths are in the scene's own units, directions are unit
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

// The surface that a ray meets. Glass counts, but surfaces with less than half alpha do not.
struct Sight {
  float distance = std::numeric_limits<float>::infinity();  // infinite if the ray leaves the scene
  bool front = true;                                        // it meets the surface's front, as defined by its winding
  bool two_sided = false;                                   // its material is made to be seen from both sides
  bool clear = false;                                       // the surface is glass, which lets light through
  vec3 normal{0.0f};                                        // normal of the triangle, on the ray's side
  int instance = -1;
  int triangle = -1;

  bool leaves() const { return instance < 0; }
};

class SceneRays {
 public:
  // Builds the acceleration structure for the present state of the scene, without repeated surfaces
  // (ods/stage/repeats.h) and outlines (ods/stage/outlines.h). The scene must outlive this object; after a change of
  // its geometry a new one is needed.
  explicit SceneRays(const Scene& scene);

  const Scene& scene() const { return scene_; }

  // Returns whether rays can meet an instance: it is visible, not an outline, and no other one coincides with it.
  bool meets(size_t instance) const { return left_out_[instance] == 0 && !is_hidden(scene_, instance); }

  // Safe from many threads at once.
  Sight look(vec3 from, vec3 direction) const;

  // The distance to the first surface; infinite if there is none.
  float distance(vec3 from, vec3 direction) const { return look(from, direction).distance; }

  // Returns whether light along this direction comes from outside. Glass does not stop it.
  bool is_open(vec3 from, vec3 direction) const;

 private:
  const Scene& scene_;
  LightTable no_lights_;
  std::vector<char> left_out_;
  EmbreeScene embree_;
  PathTracer tracer_;
};

// The unit vector at angles in degrees: yaw from -Z towards +X, elevation from the horizon towards +Y.
vec3 direction_at(float yaw, float elevation);

// Directions spread evenly over the sphere.
std::vector<vec3> sphere_directions(int count);

// The distance from a point to the nearest surface, from rays in all directions, so it may miss objects thinner than a
// tenth of the distance. Infinite if there is none.
float free_radius(const SceneRays& rays, vec3 point);

// Returns whether free_radius() is at least this.
bool is_free(const SceneRays& rays, vec3 point, float radius);

// The box around the surfaces seen from a point, without the farthest 4 percent in each direction of an axis.
Bounds seen_bounds(const SceneRays& rays, vec3 point);

// The fractions of directions from a point that leave the scene, also through glass.
struct Openness {
  float upper = 1.0f;  // fraction of the directions above the horizon
  float whole = 1.0f;
};
Openness openness(const SceneRays& rays, vec3 point);

// The sides of the surfaces around a point, as fractions of all directions.
struct Surroundings {
  float fronts = 0.0f;
  float backs = 0.0f;                                      // inside a solid model all surfaces show their backs
  float nearest = std::numeric_limits<float>::infinity();  // free_radius()
};
Surroundings surroundings(const SceneRays& rays, vec3 point);

// The height of the first surface below a point, if it is no steeper than 45 degrees.
std::optional<float> floor_below(const SceneRays& rays, vec3 point);

}  // namespace ods

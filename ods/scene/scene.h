// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What is rendered. A Scene is the kernel's own records (ods/kernel/scene_data.h) in vectors, plus what people want to
// know of it; loaders and built-in scenes fill it, renderers read it.
#pragma once
#include <string>
#include <vector>

#include "ods/camera/stereo_camera.h"
#include "ods/kernel/scene_data.h"
#include "ods/scene/animation/animation.h"

namespace ods {

// KHR_lights_punctual in world space; every field as in Light.
struct PunctualLight {
  int kind = kLightPoint;  // kLightPoint, kLightSpot or kLightDirectional
  vec3 position{0.0f};
  vec3 direction{0.0f, 0.0f, -1.0f};
  vec3 intensity{1.0f};
  float range = 0.0f;
  float inner_cone = 0.0f;  // radians from the axis
  float outer_cone = 0.7853982f;
};

// Light from infinitely far away: the same everywhere, or a lat-long picture whose centre looks along -Z.
struct Environment {
  vec3 radiance{0.0f};  // multiplies the picture where there is one
  int width = 0;        // 0: uniform
  int height = 0;
  std::vector<vec3> texels;  // rows from the top
};

// A place the scene itself proposes to look from (a camera of the file, or a built-in scene's own).
struct ViewPoint {
  std::string name;
  vec3 position{0.0f};
  float yaw = 0.0f;  // degrees, as in StereoCamera
  float pitch = 0.0f;
  float roll = 0.0f;
};

// Rays start off their surface, by up to this share of its distance from the origin: single precision asks for it.
// Walls thinner than that (1 cm at 330 m, 10 cm at 3.3 km) let a little light through where they meet. A scene belongs
// near the origin; files that reach further than kFirmReach get a warning.
inline constexpr float kThinnestWall = 1.0f / 32768.0f;
inline constexpr float kFirmReach = 3000.0f;  // metres: walls of 10 cm are safe

// What stands at a node of the file: a run of instances.
struct NamedObject {
  std::string name;
  size_t first_instance = 0;
  size_t count = 0;
};

struct Scene {
  std::string name;

  std::vector<Vertex> vertices;
  std::vector<uvec3> triangles;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Material> materials;  // never empty once a mesh exists
  std::vector<Texture> textures;
  std::vector<uint> texels;
  std::vector<Texture> reduced_textures;  // made by reduce_textures(); empty: the textures themselves serve
  std::vector<uint> reduced_texels;

  std::vector<PunctualLight> lights;
  Environment environment;

  std::vector<ViewPoint> view_points;

  std::vector<NamedObject> objects;         // those that have a name, which several may share
  std::vector<std::string> material_names;  // by material; empty, or left out at the end: it has none

  Animation animation;       // what moves: set_time() (ods/scene/motion.h) writes the lists above anew
  std::vector<char> hidden;  // 1: the instance is not there at this time; empty: all are
  int motion_keys = 0;       // of an open shutter, made by open_shutter() (ods/scene/shutter.h); 0: none
  std::vector<MotionPose> motion_poses;
  std::vector<MotionVertex> motion_vertices;

  std::vector<std::string> warnings;  // what of the file is not rendered, or not as it should be, one line each
};

// A white, rough, opaque dielectric with no textures: glTF's defaults, and where every material starts.
Material default_material();

// A slot that reads nothing.
TextureSlot no_texture();

// Whether an instance is not there at this time.
bool is_hidden(const Scene& scene, size_t instance);

// Appends a mesh and returns its index. Precondition: every corner < vertices.size(), material >= 0.
int add_mesh(Scene& scene, const std::vector<Vertex>& vertices, const std::vector<uvec3>& triangles, int material);

// Stands a mesh in the world. Precondition: mesh exists; the matrix is finite (columns as in glTF).
void add_instance(Scene& scene, int mesh, const glm::mat4& object_to_world);

struct Bounds {
  vec3 low{0.0f};
  vec3 high{0.0f};  // low > high on no axis; both 0 for an empty scene
};

// The box around every instanced vertex that is not hidden.
Bounds scene_bounds(const Scene& scene);

// Where to look from when nobody says: the first view point; without one at eye height in the scene, looking along -Z,
// or before it.
ViewPoint default_view(const Scene& scene);

// Whether a surface of it is a lamp. Unlit surfaces are not: they show a colour and light nothing.
bool is_emissive(const Material& material);

// Whether there is anything to see without a sky of one's own. Glowing textures do not count: most are the little lamps
// of a gadget, which leave its picture black.
bool has_light(const Scene& scene);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scene to render: the kernel's own records (ods/kernel/scene_data.h) in vectors, plus information for users.
// Loaders and built-in scenes fill it, renderers read it.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/stereo_camera.h"
#include "ods/kernel/scene_data.h"
#include "ods/scene/animation.h"

namespace ods {

// KHR_lights_punctual in world space; fields as in Light.
struct PunctualLight {
  int kind = kLightPoint;  // kLightPoint, kLightSpot or kLightDirectional
  vec3 position{0.0f};
  vec3 direction{0.0f, 0.0f, -1.0f};
  vec3 intensity{1.0f};
  float range = 0.0f;
  float inner_cone = 0.0f;  // radians from the axis
  float outer_cone = 0.7853982f;
  int cone = kConeSquare;
  float size = 0.0f;
};

// Light from infinity: uniform, or a lat-long picture whose centre looks along -Z.
struct Environment {
  vec3 radiance{0.0f};  // multiplies the picture, if there is one
  int width = 0;        // 0 if uniform
  int height = 0;
  std::vector<vec3> texels;  // rows from the top
};

// The direction at a position of such a picture, in radians: azimuth to the right of -Z, elevation above the horizon.
vec3 direction_of(float azimuth, float elevation);

// A viewpoint of the scene: a camera of the file, or a built-in scene's own.
struct ViewPoint {
  std::string name;
  vec3 position{0.0f};
  float yaw = 0.0f;  // degrees, as in StereoCamera
  float pitch = 0.0f;
  float roll = 0.0f;
};

// The viewpoint for a scene without view points of its own (ods/stage/place.h).
struct Viewing {
  ViewPoint view;                 // its name is the reason for it
  bool is_object = false;         // the scene is an object, seen from outside; a turntable turns it
  bool replaces_cameras = false;  // default_view() returns this one even if the scene has view points
  vec3 middle{0.0f};              // centre of the object
};

// Rays are offset from their surface by up to this fraction of its distance from the origin, because of single
// precision. Walls thinner than that (1 cm at 330 m, 10 cm at 3.3 km) leak a little light where they meet. So scenes
// should be near the origin; files that extend further than kFirmReach get a warning.
inline constexpr float kThinnestWall = 1.0f / 32768.0f;
inline constexpr float kFirmReach = 3000.0f;  // metres: walls of 10 cm are safe

// The instances of a named node of the file.
struct NamedObject {
  std::string name;
  size_t first_instance = 0;
  size_t count = 0;
};

// An extension that the file uses, and how it was handled.
struct UsedExtension {
  std::string name;
  std::string state;  // a name in kExtensionStateTable (ods/scene/gltf/extensions.h)
  std::string how;
  bool required = false;  // the file requires it
};

struct Scene {
  std::string name;

  std::vector<Vertex> vertices;
  std::vector<uvec3> triangles;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Material> materials;              // never empty once a mesh exists
  std::vector<MaterialLayers> material_layers;  // for the materials that have layers (Material::layers)
  std::vector<Texture> textures;
  std::vector<uint> texels;
  std::vector<Texture> reduced_textures;  // made by reduce_textures(); if empty, the full textures are used
  std::vector<uint> reduced_texels;

  std::vector<PunctualLight> lights;
  Environment environment;
  std::optional<Environment> background;  // seen by the camera, gives no light; the environment if not set

  glm::dvec3 origin{0.0};  // the place in the file, with y up, where the scene has its origin; in the file's units

  bool as_painted = false;  // its colours include their lighting: exposure and tone curve must not change them

  // Number of instances at the end of the list that were added: ground and lamp (ods/stage/light/supply.h).
  size_t supplied = 0;

  std::vector<ViewPoint> view_points;
  std::optional<Viewing> viewing;  // set by settle() (ods/stage/place.h)

  std::vector<NamedObject> objects;         // several may have the same name
  std::vector<std::string> material_names;  // by material; may be shorter than `materials`

  Animation animation;       // rewrites the lists above through set_time() (ods/scene/motion.h)
  std::vector<char> hidden;  // 1 if the instance is hidden at this time; empty if all are visible
  int motion_keys = 0;       // keys within an open shutter, made by open_shutter() (ods/scene/shutter.h)
  std::vector<MotionPose> motion_poses;
  std::vector<MotionVertex> motion_vertices;

  bool portable = false;  // trace its rays with the same code on every processor, which is slower

  std::vector<std::string> variants;      // names of the file's sets of materials
  std::vector<UsedExtension> extensions;  // sorted by name

  std::string generator;              // the program that wrote the file, by its own name
  std::vector<std::string> losses;    // data that this program has left out, and the remedy; one line each
  std::vector<std::string> warnings;  // features of the file that are not rendered, or only approximated; one line each
};

// A white, rough, opaque dielectric without textures: glTF's default and every material's starting point.
Material default_material();

// Layers with every extension's default, which have no effect.
MaterialLayers default_layers();

// A slot without a texture.
TextureSlot no_texture();

// Returns whether an instance is hidden at this time.
bool is_hidden(const Scene& scene, size_t instance);
bool is_anything_visible(const Scene& scene);

// Returns whether some rays do not meet an instance (PathLight::is_absent).
bool has_absences(const Instance& instance);

// Appends a mesh and returns its index. Precondition: every corner < vertices.size(), material >= 0.
int add_mesh(Scene& scene, std::vector<Vertex> vertices, std::vector<uvec3> triangles, int material);

// Adds an instance of a mesh. Precondition: the mesh exists; the matrix is finite (columns as in glTF).
void add_instance(Scene& scene, int mesh, const glm::mat4& object_to_world);

struct Bounds {
  vec3 low{0.0f};
  vec3 high{0.0f};  // low > high on no axis; both 0 for an empty scene
};

// The box around the vertices of all visible instances, except lamps of the role kPureLight.
Bounds scene_bounds(const Scene& scene);

// Returns whether the default view is a view point of the scene.
bool uses_own_camera(const Scene& scene);

// The default viewpoint: the scene's first, if it is used; otherwise Scene::viewing; if that is not set, at eye height
// in the scene's bounds or in front of them, looking along -Z.
ViewPoint default_view(const Scene& scene);

// Returns whether a material's surfaces emit light. Unlit materials do not: they show a colour but give no light.
bool is_emissive(const Material& material);

// Returns whether anything is visible without a user's environment. Emissive textures do not count: most are indicator
// lamps of a device, too dim to light its picture.
bool has_light(const Scene& scene);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The data that the kernel may read. C++ sees the arrays as pointers; a shader defines the same functions over its
// buffers.
// Nothing here traces a ray.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/scene_data.h"
namespace ods {
#endif

// A shader has its own value, for the scenes that it is for: drivers remove what a constant condition excludes.
#ifdef __cplusplus
const bool kHasCatchers = true;
#endif

// A node of the tree of lights (ods/kernel/light.h).
struct LightNode {
  vec3 center;  // centre of a sphere around its lights
  float radius;
  vec3 axis;         // unit vector: the middle of the directions that they face
  float spread;      // sine of the maximum angle between the axis and these directions; 2 for 90 degrees or more
  float power;       // power sent to the side that they face,
  float back_power;  // and to the opposite side
  int child;         // the first of two adjacent children; if negative, -1 - the index of the only light
};

// The path from the root to each light: bit i is the child, 0 or 1, that follows after i others.
struct LightWay {
  uint bits;
};

// Tables that the host computes once (ods/render/tables.h), all in one array of floats.
const int kSrgbTable = 0;  // 256 entries: an 8-bit sRGB value -> linear
const int kSrgbSize = 256;
const int kFilterTable = kSrgbTable + kSrgbSize;  // inverse distribution of the pixel filter, 0..1 -> pixels
const int kFilterSize = 513;
const int kGgxTable = kFilterTable + kFilterSize;  // [roughness][cosine][2]: see ggx_albedo() in bsdf.h
const int kGgxSize = 32;
const int kGlassTable = kGgxTable + 2 * kGgxSize * kGgxSize;  // [in, out][reflectance][roughness][cosine]
const int kGlassSize = 16;
const int kSheenTable = kGlassTable + 2 * kGlassSize * kGlassSize * kGlassSize;  // [roughness][cosine]
const int kSheenSize = 32;
// [roughness across][roughness along][turn][cosine][2]: see anisotropic_albedo() in albedo.h
const int kAnisotropicTable = kSheenTable + kSheenSize * kSheenSize;
const int kAnisotropicSize = 16;  // size of the first and the last axis
const int kAnisotropicAlong = 8;
const int kAnisotropicTurns = 4;
const int kAnisotropicCells = kAnisotropicSize * kAnisotropicAlong * kAnisotropicTurns * kAnisotropicSize;
const int kTablesSize = kAnisotropicTable + 2 * kAnisotropicCells;

// In GLSL all functions of the kernel are plain functions, included in order. C++ needs a `this` to find the scene, so
// each header continues the struct of the previous one: SceneView, FilterSampler, TextureReader, SurfaceReader,
// LayerReader, AlbedoReader, LayeredEvaluator, BsdfEvaluator, LightSampler, MediumReader, PathLight, LightCacheReader,
// and PathTracer, which is complete. The inheritance has no other meaning.
#ifdef __cplusplus
struct SceneView {
  const Vertex* vertices = nullptr;
  const uvec3* triangles = nullptr;
  const Mesh* meshes = nullptr;
  const Instance* instances = nullptr;
  const MotionPose* motion_poses = nullptr;
  const MotionVertex* motion_vertices = nullptr;
  int motion_keys = 0;  // 0 or 1 if the shutter opens for an instant only
  const Material* materials = nullptr;
  const MaterialLayers* material_layers = nullptr;
  const Texture* textures = nullptr;
  const uint* texels = nullptr;
  const Texture* reduced_textures = nullptr;  // reduced copies of the textures
  const uint* reduced_texels = nullptr;
  const Light* lights = nullptr;
  const LightPick* light_picks = nullptr;
  int light_pick_count = 0;
  const LightNode* light_nodes = nullptr;
  const LightWay* light_ways = nullptr;  // indexed by light
  EnvironmentInfo environment = {};
  EnvironmentInfo background = {};
  const EnvironmentTexel* environment_texels = nullptr;
  const AliasEntry* environment_rows = nullptr;
  const Portal* portals = nullptr;
  int portal_count = 0;  // 0 if the environment may be visible anywhere
  const float* tables = nullptr;
  const CacheCell* cache_cells = nullptr;
  uint cache_mask = 0;  // number of slots of the light cache - 1, a power of two - 1; 0 if there is no cache
  vec3 cache_viewer{0.0f};

  const Vertex& scene_vertex(uint i) const { return vertices[i]; }
  const uvec3& scene_triangle(uint i) const { return triangles[i]; }
  const Mesh& scene_mesh(int i) const { return meshes[i]; }
  const Instance& scene_instance(int i) const { return instances[i]; }
  const MotionPose& scene_motion_pose(int i) const { return motion_poses[i]; }
  const MotionVertex& scene_motion_vertex(uint i) const { return motion_vertices[i]; }
  int scene_motion_keys() const { return motion_keys; }
  const Material& scene_material(int i) const { return materials[i]; }
  const MaterialLayers& scene_material_layers(int i) const { return material_layers[i]; }
  const Texture& scene_texture(int i) const { return textures[i]; }
  uint scene_texel(uint i) const { return texels[i]; }
  const Texture& scene_reduced_texture(int i) const { return reduced_textures[i]; }
  uint scene_reduced_texel(uint i) const { return reduced_texels[i]; }
  const Light& scene_light(int i) const { return lights[i]; }
  const LightPick& scene_light_pick(int i) const { return light_picks[i]; }
  const LightNode& scene_light_node(int i) const { return light_nodes[i]; }
  const LightWay& scene_light_way(int i) const { return light_ways[i]; }
  int scene_light_pick_count() const { return light_pick_count; }
  const EnvironmentInfo& scene_environment() const { return environment; }
  const EnvironmentInfo& scene_background() const { return background; }
  const EnvironmentTexel& scene_environment_texel(int i) const { return environment_texels[i]; }
  const AliasEntry& scene_environment_row(int i) const { return environment_rows[i]; }
  const Portal& scene_portal(int i) const { return portals[i]; }
  int scene_portal_count() const { return portal_count; }
  float scene_table(int i) const { return tables[i]; }
  const CacheCell& scene_cache_cell(uint i) const { return cache_cells[i]; }
  uint scene_cache_mask() const { return cache_mask; }
  vec3 scene_cache_viewer() const { return cache_viewer; }
};
static_assert(sizeof(LightNode) == 44 && sizeof(LightWay) == 4);
}  // namespace ods
#endif

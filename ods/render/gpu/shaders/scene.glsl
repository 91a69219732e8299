// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The shader's side of ods/kernel/scene_view.h: the same functions over buffers reached by their addresses. Nothing
// moves, and there is no light cache: gpu_lacks() (ods/render/gpu/gpu_lacks.h) refuses scenes that need them, and the
// driver removes their code because these functions return constants. The same goes for the layers of materials, but
// in the shaders for scenes that have some (ODS_WHOLE).
layout(buffer_reference, scalar) readonly buffer Vertices { Vertex at[]; };
layout(buffer_reference, scalar) readonly buffer Triangles { uvec3 at[]; };
layout(buffer_reference, scalar) readonly buffer Meshes { Mesh at[]; };
layout(buffer_reference, scalar) readonly buffer Instances { Instance at[]; };
layout(buffer_reference, scalar) readonly buffer Materials { Material at[]; };
layout(buffer_reference, scalar) readonly buffer LayersOfMaterials { MaterialLayers at[]; };
layout(buffer_reference, scalar) readonly buffer Textures { Texture at[]; };
layout(buffer_reference, scalar) readonly buffer Texels { uint at[]; };
layout(buffer_reference, scalar) readonly buffer Lights { Light at[]; };
layout(buffer_reference, scalar) readonly buffer LightPicks { LightPick at[]; };
layout(buffer_reference, scalar) readonly buffer LightNodes { LightNode at[]; };
layout(buffer_reference, scalar) readonly buffer LightWays { LightWay at[]; };
layout(buffer_reference, scalar) readonly buffer EnvironmentTexels { EnvironmentTexel at[]; };
layout(buffer_reference, scalar) readonly buffer EnvironmentRows { AliasEntry at[]; };
layout(buffer_reference, scalar) readonly buffer Portals { Portal at[]; };
layout(buffer_reference, scalar) readonly buffer TexelTable { TexelRay at[]; };
// As vectors of 16 bytes, which one instruction reads.
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer TreeNodes { vec4 at[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer TreeTriangles { vec4 at[]; };
layout(buffer_reference, scalar) buffer Floats { float at[]; };
layout(buffer_reference, scalar) buffer Words { uint at[]; };
layout(buffer_reference, scalar) buffer Integers { int at[]; };
layout(buffer_reference) buffer Blocks;
layout(buffer_reference) buffer Slots;
layout(buffer_reference) buffer Views;

#include "ods/render/gpu/shaders/shared.h"

layout(buffer_reference, scalar) readonly buffer Blocks { GpuBlock at[]; };
layout(buffer_reference, scalar) buffer Views { GpuView view; };
layout(push_constant, scalar) uniform Call { GpuRound call; };
#define gpu_view call.view.view

float camera_map_texel(Camera camera, int which, int i) {
  if (which == kMapOfMerge) return gpu_view.merge_map.at[i];
  return gpu_view.head_tilt_map.at[i];
}
TexelRay camera_texel_ray(Camera camera, int i) { return gpu_view.texel_rays.at[i]; }

Vertex scene_vertex(uint i) { return gpu_view.vertices.at[i]; }
uvec3 scene_triangle(uint i) { return gpu_view.triangles.at[i]; }
Mesh scene_mesh(int i) {
  Mesh mesh = gpu_view.meshes.at[i];
  mesh.motion = -1;
  return mesh;
}
Instance scene_instance(int i) {
  Instance instance = gpu_view.instances.at[i];
  instance.motion = -1;
  return instance;
}
MotionPose scene_motion_pose(int i) {
  MotionPose none;
  return none;
}
MotionVertex scene_motion_vertex(uint i) {
  MotionVertex none;
  return none;
}
int scene_motion_keys() { return 0; }
Material scene_material(int i) {
  Material material = gpu_view.materials.at[i];
#ifndef ODS_WHOLE
  material.layers = -1;
#endif
  return material;
}
MaterialLayers scene_material_layers(int i) { return gpu_view.material_layers.at[i]; }
Texture scene_texture(int i) { return gpu_view.textures.at[i]; }
uint scene_texel(uint i) { return gpu_view.texels.at[i]; }
Texture scene_reduced_texture(int i) { return gpu_view.reduced_textures.at[i]; }
uint scene_reduced_texel(uint i) { return gpu_view.reduced_texels.at[i]; }
Light scene_light(int i) { return gpu_view.lights.at[i]; }
LightPick scene_light_pick(int i) { return gpu_view.light_picks.at[i]; }
LightNode scene_light_node(int i) { return gpu_view.light_nodes.at[i]; }
LightWay scene_light_way(int i) { return gpu_view.light_ways.at[i]; }
int scene_light_pick_count() { return gpu_view.light_pick_count; }
EnvironmentInfo scene_environment() { return gpu_view.environment; }
EnvironmentInfo scene_background() { return gpu_view.background; }
EnvironmentTexel scene_environment_texel(int i) { return gpu_view.environment_texels.at[i]; }
AliasEntry scene_environment_row(int i) { return gpu_view.environment_rows.at[i]; }
Portal scene_portal(int i) { return gpu_view.portals.at[i]; }
int scene_portal_count() { return gpu_view.portal_count; }
float scene_table(int i) { return gpu_view.tables.at[i]; }
CacheCell scene_cache_cell(uint i) {
  CacheCell none;
  return none;
}
uint scene_cache_mask() { return 0u; }
vec3 scene_cache_viewer() { return vec3(0.0); }
TreeNode scene_tree_node(int i) {
  TreeNodes nodes = gpu_view.tree_nodes;
  vec4 low_a = nodes.at[4 * i];
  vec4 high_a = nodes.at[4 * i + 1];
  vec4 low_b = nodes.at[4 * i + 2];
  vec4 high_b = nodes.at[4 * i + 3];
  return TreeNode(low_a.xyz, floatBitsToInt(low_a.w), high_a.xyz, floatBitsToInt(high_a.w), low_b.xyz,
                  floatBitsToInt(low_b.w), high_b.xyz, floatBitsToInt(high_b.w));
}
TreeTriangle scene_tree_triangle(int i) {
  TreeTriangles triangles = gpu_view.tree_triangles;
  vec4 a = triangles.at[3 * i];
  vec4 b = triangles.at[3 * i + 1];
  vec4 c = triangles.at[3 * i + 2];
  return TreeTriangle(a.xyz, floatBitsToInt(a.w), b.xyz, floatBitsToInt(b.w), c.xyz, floatBitsToInt(c.w));
}

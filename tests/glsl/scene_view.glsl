// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The shader's side of ods/kernel/scene_view.h: the same functions over buffers reached by their addresses.
layout(buffer_reference, scalar) readonly buffer Vertices { Vertex at[]; };
layout(buffer_reference, scalar) readonly buffer Triangles { uvec3 at[]; };
layout(buffer_reference, scalar) readonly buffer Meshes { Mesh at[]; };
layout(buffer_reference, scalar) readonly buffer Instances { Instance at[]; };
layout(buffer_reference, scalar) readonly buffer MotionPoses { MotionPose at[]; };
layout(buffer_reference, scalar) readonly buffer MotionVertices { MotionVertex at[]; };
layout(buffer_reference, scalar) readonly buffer Materials { Material at[]; };
layout(buffer_reference, scalar) readonly buffer MaterialLayersArray { MaterialLayers at[]; };
layout(buffer_reference, scalar) readonly buffer Textures { Texture at[]; };
layout(buffer_reference, scalar) readonly buffer Texels { uint at[]; };
layout(buffer_reference, scalar) readonly buffer Lights { Light at[]; };
layout(buffer_reference, scalar) readonly buffer LightNodes { LightNode at[]; };
layout(buffer_reference, scalar) readonly buffer LightWays { LightWay at[]; };
layout(buffer_reference, scalar) readonly buffer LightPicks { LightPick at[]; };
layout(buffer_reference, scalar) readonly buffer EnvironmentTexels { EnvironmentTexel at[]; };
layout(buffer_reference, scalar) readonly buffer EnvironmentRows { AliasEntry at[]; };
layout(buffer_reference, scalar) readonly buffer Tables { float at[]; };
layout(buffer_reference, scalar) readonly buffer Portals { Portal at[]; };
layout(buffer_reference, scalar) readonly buffer TexelTable { TexelRay at[]; };
layout(buffer_reference, scalar) readonly buffer CacheCells { CacheCell at[]; };

struct View {
  Camera camera;
  EnvironmentInfo environment;
  EnvironmentInfo background;
  int light_pick_count;
  int bounces;
  int motion_keys;
  Vertices vertices;
  Triangles triangles;
  Meshes meshes;
  Instances instances;
  MotionPoses motion_poses;
  MotionVertices motion_vertices;
  Materials materials;
  MaterialLayersArray material_layers;
  Textures textures;
  Texels texels;
  Textures reduced_textures;
  Texels reduced_texels;
  Lights lights;
  LightPicks light_picks;
  LightNodes light_nodes;
  LightWays light_ways;
  EnvironmentTexels environment_texels;
  EnvironmentRows environment_rows;
  Portals portals;
  TexelTable texel_rays;
  int portal_count;
  Tables tables;
  CacheCells cache_cells;
  uint cache_mask;
  vec3 cache_viewer;
};
// The maps of a camera that has them.
layout(binding = 3, scalar) readonly buffer MergeMap { float merge_map[]; };
layout(binding = 4, scalar) readonly buffer HeadTiltMap { float head_tilt_map[]; };
float camera_map_texel(Camera camera, int which, int i) {
  return which == kMapOfMerge ? merge_map[i] : head_tilt_map[i];
}

layout(binding = 2, scalar) uniform ViewBuffer { View view; };

TexelRay camera_texel_ray(Camera camera, int i) { return view.texel_rays.at[i]; }

Vertex scene_vertex(uint i) { return view.vertices.at[i]; }
uvec3 scene_triangle(uint i) { return view.triangles.at[i]; }
Mesh scene_mesh(int i) { return view.meshes.at[i]; }
Instance scene_instance(int i) { return view.instances.at[i]; }
MotionPose scene_motion_pose(int i) { return view.motion_poses.at[i]; }
MotionVertex scene_motion_vertex(uint i) { return view.motion_vertices.at[i]; }
int scene_motion_keys() { return view.motion_keys; }
Material scene_material(int i) { return view.materials.at[i]; }
MaterialLayers scene_material_layers(int i) { return view.material_layers.at[i]; }
Texture scene_texture(int i) { return view.textures.at[i]; }
uint scene_texel(uint i) { return view.texels.at[i]; }
Texture scene_reduced_texture(int i) { return view.reduced_textures.at[i]; }
uint scene_reduced_texel(uint i) { return view.reduced_texels.at[i]; }
Light scene_light(int i) { return view.lights.at[i]; }
LightPick scene_light_pick(int i) { return view.light_picks.at[i]; }
LightNode scene_light_node(int i) { return view.light_nodes.at[i]; }
LightWay scene_light_way(int i) { return view.light_ways.at[i]; }
int scene_light_pick_count() { return view.light_pick_count; }
EnvironmentInfo scene_environment() { return view.environment; }
EnvironmentInfo scene_background() { return view.background; }
EnvironmentTexel scene_environment_texel(int i) { return view.environment_texels.at[i]; }
AliasEntry scene_environment_row(int i) { return view.environment_rows.at[i]; }
CacheCell scene_cache_cell(uint i) { return view.cache_cells.at[i]; }
uint scene_cache_mask() { return view.cache_mask; }
vec3 scene_cache_viewer() { return view.cache_viewer; }
Portal scene_portal(int i) { return view.portals.at[i]; }
int scene_portal_count() { return view.portal_count; }
float scene_table(int i) { return view.tables.at[i]; }

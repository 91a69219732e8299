// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scene as the kernel reads it: plain records in flat arrays, with the same bytes on every device (scalar layout).
// Metres, right-handed, +Y up. Colours and radiances are linear, with Rec. 709 primaries. Angles are radians.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/math.h"
namespace ods {
#endif

struct Vertex {
  vec3 position;
  vec3 normal;   // unit length
  vec4 tangent;  // xyz: unit length, or 0 if there is no tangent; w = +1 or -1: side of the bitangent (glTF)
  vec2 uv0;
  vec2 uv1;
  vec4 color;  // linear, multiplies the base colour; 1,1,1,1 if the file has none
};

// A run of triangles with one material (a glTF primitive). Its triangles index vertices relative to first_vertex.
struct Mesh {
  uint first_vertex;
  uint vertex_count;
  uint first_triangle;
  uint triangle_count;
  int material;
  int motion;  // for a mesh that deforms while the shutter is open: its first row of MotionVertex; else -1
};

// The visibility of an instance to the camera. In reflections and for light all are ordinary, except the last two.
const int kOrdinary = 0;
const int kCatcher = 1;       // invisible except for the shadows that others cast on it (ods/kernel/path.h)
const int kFadingGround = 2;  // has no albedo in the layers and nearly no normal, like the background
const int kDimmedLamp = 3;    // seen at most as bright as kSeenLamp
const int kUnseen = 4;        // transparent for the camera
const int kPureLight = 5;     // transparent for the camera and for all light: it only emits
const int kOutline = 6;       // a toon outline: seen by the camera, transparent in reflections and for all light

// A mesh placed in the world: world = (dot(row0, p1), dot(row1, p1), dot(row2, p1)) with p1 = vec4(p, 1).
struct Instance {
  vec4 row0;
  vec4 row1;
  vec4 row2;
  int mesh;
  int first_light;  // index of the light of its first triangle, -1 if the mesh does not emit; set by make_lights()
  int motion;       // for an instance that moves while the shutter is open: its first MotionPose; else -1
  int role;         // visibility to the camera: kOrdinary, ...
};

// The transform of an instance, and a vertex of a mesh that deforms, at each of the shutter's keys: evenly spaced times
// from its opening to its closing, with linear motion in between. An instance has one row per key; a mesh has as many
// rows per key as it has vertices.
struct MotionPose {
  vec4 row0;
  vec4 row1;
  vec4 row2;
};

struct MotionVertex {
  vec3 position;
  vec3 normal;
  vec3 tangent;
};

const int kWrapRepeat = 0;
const int kWrapMirror = 1;
const int kWrapClamp = 2;

const int kTexelBytes = 0;   // 8 bits each of R, G, B, A with R in the low byte
const int kTexelNormal = 1;  // a unit vector of a normal map: x in the low 16 bits and y in the high ones, 0..65535 for
                             // -1..1; z >= 0 follows from them

// An image with its sampler. Texels are rows from the top.
struct Texture {
  uint first_texel;
  int width;
  int height;
  int wrap_u;
  int wrap_v;
  int srgb;     // 1: R, G, B are stored with the sRGB curve
  int nearest;  // 1: no interpolation
  int packing;  // kTexelBytes or kTexelNormal
};

// The texture that a material reads, and the transform of its coordinates (KHR_texture_transform):
// uv' = offset + axis_u * uv.x + axis_v * uv.y.
struct TextureSlot {
  int texture;  // -1 for none: reads as 1 everywhere
  int uv_set;   // 0 or 1
  vec2 offset;
  vec2 axis_u;
  vec2 axis_v;
};

const int kAlphaOpaque = 0;
const int kAlphaMask = 1;
const int kAlphaBlend = 2;

// glTF 2.0 metallic-roughness with KHR_materials_unlit, _emissive_strength, _ior, _transmission and _volume.
struct Material {
  vec4 base_color;
  vec3 emission;  // radiance, including the emissive strength
  float metallic;
  float roughness;
  float normal_scale;
  float ior;
  float transmission;
  float thickness;             // > 0 if the mesh encloses a volume and refracts, 0 for a thin sheet
  vec3 attenuation_color;      // the colour that white light has after attenuation_distance inside the volume
  float attenuation_distance;  // metres; infinite or <= 0 if clear
  int alpha_mode;
  float alpha_cutoff;
  int double_sided;
  int unlit;
  int layers;                           // index of its MaterialLayers, or -1
  TextureSlot base_color_slot;          // rgb: colour, a: alpha
  TextureSlot metallic_roughness_slot;  // g: roughness, b: metallic
  TextureSlot normal_slot;
  TextureSlot emission_slot;
  TextureSlot transmission_slot;  // r
};

// The parameters that other extensions of glTF add to a Material: KHR_materials_specular, _clearcoat, _sheen,
// _anisotropy, _iridescence, _dispersion and _diffuse_transmission. Factors as in those extensions; each slot
// multiplies its factor. Only materials that need one have this record, so that the others do not become slower.
struct MaterialLayers {
  vec3 specular_color;
  float specular;
  float clearcoat;
  float clearcoat_roughness;
  float clearcoat_normal_scale;
  vec3 sheen_color;  // black for no sheen
  float sheen_roughness;
  float anisotropy;           // strength
  float anisotropy_rotation;  // radians, counter-clockwise from the tangent
  float iridescence;
  float iridescence_ior;
  float iridescence_thinnest;  // nanometres, where the slot's texture is 0
  float iridescence_thickest;  // nanometres, where it is 1
  float dispersion;            // 20 / Abbe number, for volumes
  float diffuse_transmission;
  vec3 diffuse_transmission_color;
  TextureSlot specular_slot;             // a
  TextureSlot specular_color_slot;       // rgb
  TextureSlot clearcoat_slot;            // r
  TextureSlot clearcoat_roughness_slot;  // g
  TextureSlot clearcoat_normal_slot;
  TextureSlot sheen_color_slot;                 // rgb
  TextureSlot sheen_roughness_slot;             // a
  TextureSlot anisotropy_slot;                  // rg: direction, b: strength
  TextureSlot iridescence_slot;                 // r
  TextureSlot iridescence_thickness_slot;       // g
  TextureSlot diffuse_transmission_slot;        // a
  TextureSlot diffuse_transmission_color_slot;  // rgb
};

const int kLightTriangle = 0;
const int kLightPoint = 1;
const int kLightSpot = 2;
const int kLightDirectional = 3;
const int kLightEnvironment = 4;

// The falloff of a spot from its inner to its outer cone; t goes from 0 at the outer one to 1, linear in the cosine.
const int kConeSquare = 0;        // t^2, as KHR_lights_punctual suggests
const int kConeSmooth = 1;        // t^2 (3 - 2 t), as in Cycles
const int kConeSmoothCosine = 2;  // kConeSmooth times the cosine of the angle from the axis: Cycles up to Blender 3.4

// One entry of Walker's alias table: a slot is picked uniformly, then kept with probability `threshold`; otherwise its
// alias is taken.
struct AliasEntry {
  float probability;  // overall probability of picking this entry
  float threshold;
  int alias;
};

struct Light {
  int kind;
  int instance;       // triangle: the instance,
  int triangle;       // and the triangle of its mesh
  vec3 position;      // point, spot
  vec3 direction;     // spot, directional: unit vector along which the light shines
  vec3 intensity;     // point, spot: W/sr (glTF: cd); directional: W/m2 (glTF: lux)
  float range;        // point, spot: metres; unlimited if <= 0
  float cone_scale;   // spot: t = clamp(cos * scale + offset, 0, 1) fades from inner to outer cone
  float cone_offset;  //
  int cone;           //       kConeSquare, ...
  float size;  // point, spot: radius of a sphere, metres; directional: half of its angle, radians. Rays do not hit it
  float probability;  // probability of picking this light
};

// One slot of the alias table from which lights are picked; it contains the lights that have power.
struct LightPick {
  int light;
  float threshold;
  int alias;  // the slot's other light
};

// One texel of a lat-long environment (rows from the top, centre of the picture along -Z of the world).
struct EnvironmentTexel {
  vec3 radiance;
  AliasEntry entry;  // the texel's entry in the table of its row; the rows have a table of their own
};

// A rectangle through which a room sees the environment, such as a window pane: corner + u * along + v * across.
struct Portal {
  vec3 corner;
  vec3 along;  // at right angles to across
  vec3 across;
};

// The properties of an environment besides its texels.
struct EnvironmentInfo {
  vec3 uniform_radiance;  // used if width = 0
  int width;
  int height;
  int first_texel;
  int light;  // index in the light table; -1 if it is not sampled as a light
};

// A slot of the light cache's table (ods/kernel/light_cache.h).
struct CacheCell {
  uint home;
  uint check;  // 0 if the slot is empty
  vec3 light;  // outgoing light over albedo
};

// The hits of a TreeTriangle that the kernel decides about, as a sum.
const int kDecidesAll = 1;     // it has alpha, or is absent for some rays
const int kDecidesShadow = 2;  // it may be clear glass
const int kHasNoBack = 4;      // the file contains the face a second time, for this side
const int kHasNoFront = 8;     // the same, in a mirrored instance

// Maximum depth of a TreeNode.
const int kTreeDepth = 64;

// A node of the tree of boxes over the scene's triangles (ods/kernel/tree.h). Each of its two children is a node or a
// run of triangles.
struct TreeNode {
  vec3 low_a;   // the first child's box
  int first_a;  // its node, or its first triangle
  vec3 high_a;
  int count_a;  // its number of triangles; 0 for a node
  vec3 low_b;   // the second child
  int first_b;
  vec3 high_b;
  int count_b;
};

// A triangle of the tree, in the world.
struct TreeTriangle {
  vec3 a;
  int instance;
  vec3 b;
  int triangle;  // of the instance's mesh
  vec3 c;
  int decides;  // the sum of these numbers; 0: it stops every ray
};

// The point where a ray hit the scene. (u, v) are the barycentric coordinates of the triangle's second and third
// corner.
struct Hit {
  float t;  // distance along the ray; negative if the ray left the scene
  float u;
  float v;
  int instance;
  int triangle;  // counted from the mesh's first_triangle
};

#ifdef __cplusplus
static_assert(sizeof(Vertex) == 72 && sizeof(Mesh) == 24 && sizeof(Instance) == 64 && sizeof(Texture) == 32);
static_assert(sizeof(TextureSlot) == 32 && sizeof(Material) == 248 && sizeof(Light) == 72);
static_assert(sizeof(MaterialLayers) == 88 + 12 * sizeof(TextureSlot));
static_assert(sizeof(EnvironmentTexel) == 24 && sizeof(EnvironmentInfo) == 28 && sizeof(Hit) == 20);
static_assert(sizeof(CacheCell) == 20 && sizeof(Portal) == 36);
static_assert(sizeof(TreeNode) == 64 && sizeof(TreeTriangle) == 48);
}  // namespace ods
#endif

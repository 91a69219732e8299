// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the point on the surface for a hit: its position, its normals, and its material there. Also frames around a
// normal.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/texture.h"
namespace ods {
#endif

struct Surface {
  vec3 position;
  vec3 geometric;  // unit normal of the triangle, on the side from which the ray comes
  vec3 normal;     // unit shading normal, on the same side
  bool front;      // the ray comes from the front side of the triangle, as its winding defines it
  vec3 base_color;
  vec3 emission;
  float metallic;
  float roughness;
  float transmission;
  float ior;
  bool volume;   // the surface encloses a medium
  bool layered;  // it has the layers that read_layers() reads (ods/kernel/surface_layers.h)
};

// Unit vectors at right angles.
struct Frame {
  vec3 tangent;
  vec3 bitangent;
  vec3 normal;
};

// A frame around a unit normal. Source: Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
inline Frame frame_around(vec3 n) {
  Frame frame;
  frame.normal = n;
  float side = n.z < 0.0f ? -1.0f : 1.0f;
  float a = -1.0f / (side + n.z);
  float b = n.x * n.y * a;
  frame.tangent = vec3(1.0f + side * n.x * n.x * a, side * b, -side * n.x);
  frame.bitangent = vec3(b, side + n.y * n.y * a, -n.y);
  return frame;
}

inline vec3 to_frame(Frame frame, vec3 w) {
  return vec3(dot(w, frame.tangent), dot(w, frame.bitangent), dot(w, frame.normal));
}

inline vec3 from_frame(Frame frame, vec3 w) {
  return frame.tangent * w.x + frame.bitangent * w.y + frame.normal * w.z;
}

inline float luminance(vec3 c) {
  return dot(c, vec3(0.2126f, 0.7152f, 0.0722f));
}

// A point slightly off the surface, on the normal's side, so that rays from it do not hit the surface again.
// Source: Waechter and Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems, 2019.
inline float offset_axis(float p, float n) {
  if (abs(p) < 1.0f / 32.0f) return p + n * (1.0f / 65536.0f);
  int steps = int(256.0f * n);
  return intBitsToFloat(floatBitsToInt(p) + (p < 0.0f ? -steps : steps));
}

inline vec3 offset_point(vec3 p, vec3 n) {
  return vec3(offset_axis(p.x, n.x), offset_axis(p.y, n.y), offset_axis(p.z, n.z));
}

inline vec3 to_world(Instance instance, vec3 p) {
  vec4 p1 = vec4(p, 1.0f);
  return vec3(dot(instance.row0, p1), dot(instance.row1, p1), dot(instance.row2, p1));
}

// The object-to-world rotation and scale, for a direction or an edge.
inline vec3 turn_to_world(Instance instance, vec3 v) {
  vec4 v0 = vec4(v, 0.0f);
  return vec3(dot(instance.row0, v0), dot(instance.row1, v0), dot(instance.row2, v0));
}

// -1 if an instance is mirrored, else 1.
inline float handedness_of(Instance instance) {
  vec3 row0 = vec3(instance.row0.x, instance.row0.y, instance.row0.z);
  vec3 row1 = vec3(instance.row1.x, instance.row1.y, instance.row1.z);
  vec3 row2 = vec3(instance.row2.x, instance.row2.y, instance.row2.z);
  return dot(row0, cross(row1, row2)) < 0.0f ? -1.0f : 1.0f;
}

#ifdef __cplusplus
struct SurfaceReader : TextureReader {
#endif

  // The time of the ray: 0 as the shutter opens, 1 as it closes. The device sets it before a path starts.
  float ray_time = 0.0f;

  // A time between two of the shutter's keys.
  struct MotionPlace {
    int key;      // the key before
    float share;  // weight of the key after
  };

  inline MotionPlace motion_place() {
    int last = max(scene_motion_keys() - 1, 1);
    float at = clamp(ray_time, 0.0f, 1.0f) * float(last);
    MotionPlace place;
    place.key = min(int(at), last - 1);
    place.share = at - float(place.key);
    return place;
  }

  // An instance at the ray's time.
  inline Instance instance_now(int index) {
    Instance instance = scene_instance(index);
    if (instance.motion < 0) return instance;
    MotionPlace place = motion_place();
    MotionPose before = scene_motion_pose(instance.motion + place.key);
    MotionPose after = scene_motion_pose(instance.motion + place.key + 1);
    instance.row0 = mix(before.row0, after.row0, place.share);
    instance.row1 = mix(before.row1, after.row1, place.share);
    instance.row2 = mix(before.row2, after.row2, place.share);
    return instance;
  }

  struct Corners {
    uint a;  // vertex indices
    uint b;
    uint c;
    float wa;  // barycentric weights of the hit point
    float wb;
    float wc;
    bool bends;  // the mesh deforms: rows `before` + vertex and `after` + vertex hold the vertex's position, normal and
                 // tangent
    uint before;  // a row of MotionVertex
    uint after;
    float share;
  };

  inline Corners corners_of(Hit hit) {
    Mesh mesh = scene_mesh(scene_instance(hit.instance).mesh);
    uvec3 triangle = scene_triangle(mesh.first_triangle + uint(hit.triangle));
    Corners corners;
    corners.a = mesh.first_vertex + triangle.x;
    corners.b = mesh.first_vertex + triangle.y;
    corners.c = mesh.first_vertex + triangle.z;
    corners.wa = 1.0f - hit.u - hit.v;
    corners.wb = hit.u;
    corners.wc = hit.v;
    corners.bends = mesh.motion >= 0;
    if (corners.bends) {
      MotionPlace place = motion_place();
      corners.before = uint(mesh.motion) + uint(place.key) * mesh.vertex_count - mesh.first_vertex;
      corners.after = corners.before + mesh.vertex_count;
      corners.share = place.share;
    }
    return corners;
  }

  inline vec3 position_now(Corners k, uint vertex) {
    if (!k.bends) return scene_vertex(vertex).position;
    return mix(scene_motion_vertex(k.before + vertex).position, scene_motion_vertex(k.after + vertex).position,
               k.share);
  }

  inline vec3 normal_now(Corners k, uint vertex) {
    if (!k.bends) return scene_vertex(vertex).normal;
    return mix(scene_motion_vertex(k.before + vertex).normal, scene_motion_vertex(k.after + vertex).normal, k.share);
  }

  inline vec3 tangent_now(Corners k, uint vertex) {
    if (!k.bends)
      return vec3(scene_vertex(vertex).tangent.x, scene_vertex(vertex).tangent.y, scene_vertex(vertex).tangent.z);
    return mix(scene_motion_vertex(k.before + vertex).tangent, scene_motion_vertex(k.after + vertex).tangent, k.share);
  }

  inline vec2 uv0_of(Corners k) {
    return scene_vertex(k.a).uv0 * k.wa + scene_vertex(k.b).uv0 * k.wb + scene_vertex(k.c).uv0 * k.wc;
  }
  inline vec2 uv1_of(Corners k) {
    return scene_vertex(k.a).uv1 * k.wa + scene_vertex(k.b).uv1 * k.wb + scene_vertex(k.c).uv1 * k.wc;
  }

  // The fraction of a ray's light that a surface stops, 0..1.
  inline float alpha_of(Material material, Corners k) {
    // In this form three equal corners give exactly their value, which may be the cutoff.
    float a = scene_vertex(k.a).color.w;
    float alpha =
        material.base_color.w * (a + (scene_vertex(k.b).color.w - a) * k.wb + (scene_vertex(k.c).color.w - a) * k.wc);
    alpha = alpha * slot_at(material.base_color_slot, uv0_of(k), uv1_of(k), false).w;
    if (material.alpha_mode == kAlphaMask) return alpha < material.alpha_cutoff ? 0.0f : 1.0f;
    return alpha;
  }

  // Returns whether a ray passes through a hit as if nothing were there: an alpha mask, or alpha blending decided at
  // random by draw, uniform in [0, 1). Every device calls this at each candidate hit of a material that is not opaque.
  inline bool passes(Hit hit, float draw) {
    Material material = scene_material(scene_mesh(scene_instance(hit.instance).mesh).material);
    if (material.alpha_mode == kAlphaOpaque) return false;
    return draw >= alpha_of(material, corners_of(hit));
  }

  // The interpolated normal of the vertices, on the front side. geometric: the triangle's normal there.
  inline vec3 vertex_normal(Instance instance, Corners k, vec3 geometric, float handedness) {
    vec3 row0 = vec3(instance.row0.x, instance.row0.y, instance.row0.z);
    vec3 row1 = vec3(instance.row1.x, instance.row1.y, instance.row1.z);
    vec3 row2 = vec3(instance.row2.x, instance.row2.y, instance.row2.z);
    vec3 n = normal_now(k, k.a) * k.wa + normal_now(k, k.b) * k.wb + normal_now(k, k.c) * k.wc;
    vec3 normal = vec3(dot(cross(row1, row2), n), dot(cross(row2, row0), n), dot(cross(row0, row1), n)) * handedness;
    float size = length(normal);
    return size > 1e-30f ? normal * (1.0f / size) : geometric;
  }

  // The frame of tangent space around a normal on the front side. It follows the vertices' tangents as glTF defines it;
  // its tangent is 0 if they have none.
  inline Frame tangent_frame(Instance instance, Corners k, vec3 normal, float handedness) {
    vec3 local = tangent_now(k, k.a) * k.wa + tangent_now(k, k.b) * k.wb + tangent_now(k, k.c) * k.wc;
    float side =
        scene_vertex(k.a).tangent.w * k.wa + scene_vertex(k.b).tangent.w * k.wb + scene_vertex(k.c).tangent.w * k.wc;
    vec3 t = turn_to_world(instance, local);
    t = t - normal * dot(normal, t);
    float size = length(t);
    Frame frame;
    frame.normal = normal;
    frame.tangent = size > 1e-12f ? t * (1.0f / size) : vec3(0.0f);
    frame.bitangent = cross(normal, frame.tangent) * (side < 0.0f ? -handedness : handedness);
    return frame;
  }

  // Normal from a normal map, on the front side.
  inline vec3 mapped_normal(TextureSlot slot, float scale, Instance instance, Corners k, vec3 normal, float handedness,
                            bool reduced) {
    Frame frame = tangent_frame(instance, k, normal, handedness);
    if (frame.tangent == vec3(0.0f)) return normal;
    vec4 map = slot_at(slot, uv0_of(k), uv1_of(k), reduced);
    float x = (map.x * 2.0f - 1.0f) * scale;
    float y = (map.y * 2.0f - 1.0f) * scale;
    float z = max(map.z * 2.0f - 1.0f, 0.0f);
    vec3 n = frame.tangent * x + frame.bitangent * y + normal * z;
    float n_size = length(n);
    return n_size > 1e-6f ? n * (1.0f / n_size) : normal;
  }

  // A hit's triangle in the world: one corner and the two edges that start there.
  struct Triangle {
    vec3 a;
    vec3 ab;
    vec3 ac;
  };

  inline Triangle triangle_of(Instance instance, Corners k) {
    Triangle triangle;
    // Edges are transformed before the translation: far from the origin, corners rounded in world space would lose
    // small triangles.
    vec3 a = position_now(k, k.a);
    triangle.a = to_world(instance, a);
    triangle.ab = turn_to_world(instance, position_now(k, k.b) - a);
    triangle.ac = turn_to_world(instance, position_now(k, k.c) - a);
    return triangle;
  }

  // Radiance that the surface itself emits from its front or back.
  inline vec3 emission_at(Material material, Corners k, bool front) {
    if (!front && material.double_sided == 0) return vec3(0.0f);
    if (material.emission_slot.texture < 0) return material.emission;
    vec4 glow = slot_at(material.emission_slot, uv0_of(k), uv1_of(k), false);
    return material.emission * vec3(glow.x, glow.y, glow.z);
  }

  // A shading normal that points away from the viewer is bent back to grazing incidence.
  inline vec3 facing_normal(vec3 normal, vec3 direction) {
    float facing = dot(normal, direction);
    return facing > -1e-3f ? normalize(normal - direction * (facing + 2e-3f)) : normal;
  }

  // reduced: use the reduced copies of textures, except for emission, which must match light sampling.
  inline Surface surface_at(Hit hit, vec3 direction, bool reduced) {
    Instance instance = instance_now(hit.instance);
    Material material = scene_material(scene_mesh(instance.mesh).material);
    Corners k = corners_of(hit);
    Triangle triangle = triangle_of(instance, k);
    float handedness = handedness_of(instance);

    Surface surface;
    surface.position = triangle.a + triangle.ab * k.wb + triangle.ac * k.wc;
    vec3 geometric = normalize(cross(triangle.ab, triangle.ac)) * handedness;
    vec3 normal = vertex_normal(instance, k, geometric, handedness);
    if (material.normal_slot.texture >= 0) {
      normal = mapped_normal(material.normal_slot, material.normal_scale, instance, k, normal, handedness, reduced);
    }
    surface.front = dot(geometric, direction) < 0.0f;
    surface.geometric = surface.front ? geometric : -geometric;
    surface.normal = facing_normal(surface.front ? normal : -normal, direction);

    vec2 uv0 = uv0_of(k);
    vec2 uv1 = uv1_of(k);
    vec4 color = scene_vertex(k.a).color * k.wa + scene_vertex(k.b).color * k.wb + scene_vertex(k.c).color * k.wc;
    vec4 base = material.base_color * color * slot_at(material.base_color_slot, uv0, uv1, reduced);
    vec4 mr = slot_at(material.metallic_roughness_slot, uv0, uv1, reduced);
    surface.base_color = vec3(base.x, base.y, base.z);
    surface.emission = emission_at(material, k, surface.front);
    surface.metallic = material.metallic * mr.z;
    surface.roughness = material.roughness * mr.y;
    surface.transmission = material.transmission * slot_at(material.transmission_slot, uv0, uv1, reduced).x;
    surface.ior = material.ior;
    surface.layered = material.layers >= 0;
    bool lets_through = material.transmission > 0.0f ||
                        (surface.layered && scene_material_layers(material.layers).diffuse_transmission > 0.0f);
    surface.volume = lets_through && material.thickness > 0.0f;
    return surface;
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif

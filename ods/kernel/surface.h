// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A hit -> the point on the surface: where it is, how it stands, and what the material is made of there.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/texture.h"
namespace ods {
#endif

struct Surface {
  vec3 position;
  vec3 geometric;  // unit normal of the triangle, on the side that the ray comes from
  vec3 normal;     // unit normal to shade with, on the same side
  bool front;      // the ray comes from the side that the triangle's winding calls its front
  vec3 base_color;
  vec3 emission;
  float metallic;
  float roughness;
  float transmission;
  float ior;
  bool volume;  // the surface encloses a medium
};

inline float luminance(vec3 c) {
  return dot(c, vec3(0.2126f, 0.7152f, 0.0722f));
}

// A point just off the surface, on the side of the normal, from which rays do not find the surface again.
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

#ifdef __cplusplus
struct SurfaceReader : TextureReader {
#endif

  struct Corners {
    Vertex a;
    Vertex b;
    Vertex c;
    float wa;  // weights of the hit point
    float wb;
    float wc;
  };

  inline Corners corners_of(Hit hit) {
    Mesh mesh = scene_mesh(scene_instance(hit.instance).mesh);
    uvec3 triangle = scene_triangle(mesh.first_triangle + uint(hit.triangle));
    Corners corners;
    corners.a = scene_vertex(mesh.first_vertex + triangle.x);
    corners.b = scene_vertex(mesh.first_vertex + triangle.y);
    corners.c = scene_vertex(mesh.first_vertex + triangle.z);
    corners.wa = 1.0f - hit.u - hit.v;
    corners.wb = hit.u;
    corners.wc = hit.v;
    return corners;
  }

  inline vec2 uv0_of(Corners k) {
    return k.a.uv0 * k.wa + k.b.uv0 * k.wb + k.c.uv0 * k.wc;
  }
  inline vec2 uv1_of(Corners k) {
    return k.a.uv1 * k.wa + k.b.uv1 * k.wb + k.c.uv1 * k.wc;
  }

  // The share of a ray that a surface stops, 0..1.
  inline float alpha_of(Material material, Corners k) {
    // In this form equal corners give exactly their value, which may be the cutoff.
    float a = k.a.color.w;
    float alpha = material.base_color.w * (a + (k.b.color.w - a) * k.wb + (k.c.color.w - a) * k.wc);
    alpha = alpha * slot_at(material.base_color_slot, uv0_of(k), uv1_of(k)).w;
    if (material.alpha_mode == kAlphaMask) return alpha < material.alpha_cutoff ? 0.0f : 1.0f;
    return alpha;
  }

  // Whether a ray goes through a hit as if nothing were there (alpha masks; alpha blending as a lottery with the number
  // draw, uniform in [0, 1)). Every device asks this at each candidate hit of a material that is not opaque.
  inline bool passes(Hit hit, float draw) {
    Material material = scene_material(scene_mesh(scene_instance(hit.instance).mesh).material);
    if (material.alpha_mode == kAlphaOpaque) return false;
    return draw >= alpha_of(material, corners_of(hit));
  }

  // Normal of the normal map, on the front side. The frame follows the vertices' tangents as glTF defines it.
  inline vec3 mapped_normal(Material material, Instance instance, Corners k, vec3 normal, float handedness) {
    vec4 tangent = k.a.tangent * k.wa + k.b.tangent * k.wb + k.c.tangent * k.wc;
    vec3 local = vec3(tangent.x, tangent.y, tangent.z);
    vec3 t = vec3(dot(vec3(instance.row0.x, instance.row0.y, instance.row0.z), local),
                  dot(vec3(instance.row1.x, instance.row1.y, instance.row1.z), local),
                  dot(vec3(instance.row2.x, instance.row2.y, instance.row2.z), local));
    t = t - normal * dot(normal, t);
    float size = length(t);
    if (!(size > 1e-12f)) return normal;
    t = t * (1.0f / size);
    vec3 b = cross(normal, t) * (tangent.w < 0.0f ? -handedness : handedness);
    vec4 map = slot_at(material.normal_slot, uv0_of(k), uv1_of(k));
    float x = (map.x * 2.0f - 1.0f) * material.normal_scale;
    float y = (map.y * 2.0f - 1.0f) * material.normal_scale;
    float z = max(map.z * 2.0f - 1.0f, 0.0f);
    vec3 n = t * x + b * y + normal * z;
    float n_size = length(n);
    return n_size > 1e-6f ? n * (1.0f / n_size) : normal;
  }

  inline Surface surface_at(Hit hit, vec3 direction) {
    Instance instance = scene_instance(hit.instance);
    Material material = scene_material(scene_mesh(instance.mesh).material);
    Corners k = corners_of(hit);
    vec3 a = to_world(instance, k.a.position);
    vec3 ab = to_world(instance, k.b.position) - a;
    vec3 ac = to_world(instance, k.c.position) - a;
    vec3 row0 = vec3(instance.row0.x, instance.row0.y, instance.row0.z);
    vec3 row1 = vec3(instance.row1.x, instance.row1.y, instance.row1.z);
    vec3 row2 = vec3(instance.row2.x, instance.row2.y, instance.row2.z);
    vec3 cofactor0 = cross(row1, row2);
    float handedness = dot(row0, cofactor0) < 0.0f ? -1.0f : 1.0f;  // -1: the instance is mirrored

    Surface surface;
    surface.position = a + ab * k.wb + ac * k.wc;
    vec3 geometric = normalize(cross(ab, ac)) * handedness;
    vec3 n = k.a.normal * k.wa + k.b.normal * k.wb + k.c.normal * k.wc;
    vec3 normal = vec3(dot(cofactor0, n), dot(cross(row2, row0), n), dot(cross(row0, row1), n)) * handedness;
    float size = length(normal);
    normal = size > 1e-30f ? normal * (1.0f / size) : geometric;
    if (material.normal_slot.texture >= 0) normal = mapped_normal(material, instance, k, normal, handedness);
    surface.front = dot(geometric, direction) < 0.0f;
    surface.geometric = surface.front ? geometric : -geometric;
    surface.normal = surface.front ? normal : -normal;
    // Where the shading normal looks away from the viewer, bend it back to a grazing view.
    float facing = dot(surface.normal, direction);
    if (facing > -1e-3f) surface.normal = normalize(surface.normal - direction * (facing + 2e-3f));

    vec2 uv0 = uv0_of(k);
    vec2 uv1 = uv1_of(k);
    vec4 color = k.a.color * k.wa + k.b.color * k.wb + k.c.color * k.wc;
    vec4 base = material.base_color * color * slot_at(material.base_color_slot, uv0, uv1);
    vec4 mr = slot_at(material.metallic_roughness_slot, uv0, uv1);
    vec4 glow = slot_at(material.emission_slot, uv0, uv1);
    surface.base_color = vec3(base.x, base.y, base.z);
    surface.emission = vec3(0.0f);
    if (surface.front || material.double_sided == 1)
      surface.emission = material.emission * vec3(glow.x, glow.y, glow.z);
    surface.metallic = material.metallic * mr.z;
    surface.roughness = material.roughness * mr.y;
    surface.transmission = material.transmission * slot_at(material.transmission_slot, uv0, uv1).x;
    surface.ior = material.ior;
    surface.volume = material.transmission > 0.0f && material.thickness > 0.0f;
    return surface;
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif

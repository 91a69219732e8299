// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the layers of a material (MaterialLayers) at a hit. Surfaces without layers do not become slower.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/surface.h"
#include "ods/kernel/thin_film.h"
namespace ods {
#endif

struct SurfaceLayers {
  vec3 specular_color;
  float specular;
  float clearcoat;
  float clearcoat_roughness;
  vec3 clearcoat_normal;  // unit shading normal, on the side from which the ray comes
  vec3 sheen_color;
  float sheen_roughness;
  float anisotropy;
  vec3 anisotropy_direction;  // world space, the direction in which the surface is rougher; 0 if the mesh has no
                              // tangents
  float iridescence;
  ThinFilm film;
  float diffuse_transmission;
  vec3 diffuse_transmission_color;
  vec3 wave_eta;  // relative index of the interface for R, G and B, like make_bsdf()'s eta; 0 if it does not split
                  // colours here
};

#ifdef __cplusplus
struct LayerReader : SurfaceReader {
#endif

  // Scratch: the layers of the surface last passed to read_layers(). Device code need not touch it.
  SurfaceLayers surface_layers;

  // The fraction of the surface's own light that a coat lets through (KHR_materials_clearcoat). cosine: of the viewer
  // to the triangle's normal, without normal maps and reduced textures, so that light sampling gets the same value.
  inline float emission_below_coat(Material material, Corners k, float cosine) {
    MaterialLayers layers = scene_material_layers(material.layers);
    float coat = layers.clearcoat * slot_at(layers.clearcoat_slot, uv0_of(k), uv1_of(k), false).x;
    return 1.0f - clamp(coat, 0.0f, 1.0f) * (0.04f + 0.96f * schlick(cosine));
  }

  inline vec3 slot_color(TextureSlot slot, vec2 uv0, vec2 uv1, bool reduced) {
    vec4 texel = slot_at(slot, uv0, uv1, reduced);
    return vec3(texel.x, texel.y, texel.z);
  }

  // The direction of anisotropy in the world, from its texture and its rotation.
  inline vec3 anisotropy_direction(MaterialLayers layers, Frame frame, vec4 map) {
    vec2 d = vec2(1.0f, 0.0f);
    if (layers.anisotropy_slot.texture >= 0) d = vec2(map.x * 2.0f - 1.0f, map.y * 2.0f - 1.0f);
    vec2 turn = cos_sin(layers.anisotropy_rotation);
    return frame.tangent * (turn.x * d.x - turn.y * d.y) + frame.bitangent * (turn.y * d.x + turn.x * d.y);
  }

  // Sets surface_layers. surface: the result of surface_at() for this hit; surface.layered must be true.
#ifdef __cplusplus
  [[gnu::noinline]]
#endif
  inline void
  read_layers(Hit hit, Surface surface, vec3 direction, bool reduced) {
    Instance instance = instance_now(hit.instance);
    MaterialLayers layers = scene_material_layers(scene_material(scene_mesh(instance.mesh).material).layers);
    Corners k = corners_of(hit);
    vec2 uv0 = uv0_of(k);
    vec2 uv1 = uv1_of(k);
    float handedness = handedness_of(instance);
    vec3 geometric = surface.front ? surface.geometric : -surface.geometric;
    vec3 normal = vertex_normal(instance, k, geometric, handedness);

    SurfaceLayers s;
    s.specular = layers.specular * slot_at(layers.specular_slot, uv0, uv1, reduced).w;
    s.specular_color = layers.specular_color * slot_color(layers.specular_color_slot, uv0, uv1, reduced);
    s.clearcoat = layers.clearcoat * slot_at(layers.clearcoat_slot, uv0, uv1, reduced).x;
    s.clearcoat_roughness = layers.clearcoat_roughness * slot_at(layers.clearcoat_roughness_slot, uv0, uv1, reduced).y;
    s.clearcoat_normal = normal;
    if (layers.clearcoat_normal_slot.texture >= 0) {
      s.clearcoat_normal = mapped_normal(layers.clearcoat_normal_slot, layers.clearcoat_normal_scale, instance, k,
                                         normal, handedness, reduced);
    }
    s.clearcoat_normal = facing_normal(surface.front ? s.clearcoat_normal : -s.clearcoat_normal, direction);
    s.sheen_color = layers.sheen_color * slot_color(layers.sheen_color_slot, uv0, uv1, reduced);
    s.sheen_roughness = layers.sheen_roughness * slot_at(layers.sheen_roughness_slot, uv0, uv1, reduced).w;
    s.anisotropy = 0.0f;
    s.anisotropy_direction = vec3(0.0f);
    if (layers.anisotropy > 0.0f) {
      vec4 map = slot_at(layers.anisotropy_slot, uv0, uv1, reduced);
      s.anisotropy = layers.anisotropy * map.z;
      s.anisotropy_direction = anisotropy_direction(layers, tangent_frame(instance, k, normal, handedness), map);
    }
    s.iridescence = layers.iridescence * slot_at(layers.iridescence_slot, uv0, uv1, reduced).x;
    s.film.ior = layers.iridescence_ior;
    s.film.thickness = mix(layers.iridescence_thinnest, layers.iridescence_thickest,
                           slot_at(layers.iridescence_thickness_slot, uv0, uv1, reduced).y);
    s.diffuse_transmission =
        layers.diffuse_transmission * slot_at(layers.diffuse_transmission_slot, uv0, uv1, reduced).w;
    s.diffuse_transmission_color =
        layers.diffuse_transmission_color * slot_color(layers.diffuse_transmission_color_slot, uv0, uv1, reduced);
    s.wave_eta = vec3(0.0f);
    surface_layers = s;
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif

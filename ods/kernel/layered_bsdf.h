// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes the LayeredBsdf of a surface with layers, and keeps it. At most two are in use, one per eye.
//
// They are not part of Bsdf, and in C++ these functions are never inlined into the path loop, so that surfaces without
// layers do not become slower.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/layer_lobes.h"
namespace ods {
#endif

// Number of microfacets over which the mean reflectance of a film is taken.
const int kFilmNormals = 16;

#ifdef __cplusplus
struct LayeredEvaluator : AlbedoReader {
#endif

  // Scratch: the lobes of the surface for the path's own eye and for the other one, set by make_layered(). They are two
  // variables: an array with a variable index would be in memory on a GPU.
  LayeredBsdf own_layered;
  LayeredBsdf other_layered;

  // The film's reflectance over a base, averaged over the reflecting microfacets.
  inline vec3 mean_film(LayeredBsdf b, vec3 base_f0) {
    if (b.mirror) return film_fresnel(b.film, b.wo.z, base_f0);
    vec3 sum = vec3(0.0f);
    float total = 0.0f;
    float lambda = ggx_lambda(b.wo, b.alpha);
    for (int i = 0; i < kFilmNormals; i++) {
      // Denser samples where u.y is close to 1, as for the tables.
      float at = float(i) + 0.5f;
      float rest = 1.0f - at / float(kFilmNormals);
      vec3 h = ggx_sample_visible(b.wo, b.alpha, vec2(fract(0.618034f * at), 1.0f - rest * rest));
      float cosine = dot(b.wo, h);
      vec3 wi = h * (2.0f * cosine) - b.wo;
      if (wi.z <= 0.0f) continue;
      float weight = rest / (1.0f + lambda + ggx_lambda(wi, b.alpha));
      sum += film_fresnel(b.film, cosine, base_f0) * weight;
      total += weight;
    }
    return total > 0.0f ? sum * (1.0f / total) : film_fresnel(b.film, b.wo.z, base_f0);
  }

  // Sets the frame and the alphas.
  inline LayeredBsdf layered_frame(Surface surface, vec3 direction) {
    LayeredBsdf b;
    b.frame = frame_around(surface.normal);
    float roughness = clamp(surface.roughness, 0.0f, 1.0f);
    float alpha = roughness * roughness;
    b.alpha = vec2(alpha);
    b.mirror = alpha < kSmoothAlpha;
    float strength = clamp(surface_layers.anisotropy, 0.0f, 1.0f);
    if (strength > 0.0f) {
      b.alpha = vec2(mix(alpha, 1.0f, strength * strength), alpha);
      b.mirror = b.alpha.x < kSmoothAlpha;
      b.alpha.y = max(b.alpha.y, kSmoothAlpha);
      vec3 along = surface_layers.anisotropy_direction;
      along = along - surface.normal * dot(surface.normal, along);
      float size = length(along);
      if (size > 1e-6f) {
        b.frame.tangent = along * (1.0f / size);
        b.frame.bitangent = cross(surface.normal, b.frame.tangent);
      }
    }
    b.geometric = surface.geometric;
    b.wo = to_frame(b.frame, -direction);
    b.wo.z = max(b.wo.z, 1e-5f);
    return b;
  }

  // Albedo of the microfacets in Schlick's two parts, like ggx_albedo().
  inline vec2 microfacet_albedo(LayeredBsdf b, float roughness) {
    float s = schlick(b.wo.z);
    if (b.mirror) return vec2(1.0f - s, s);
    if (b.alpha.x > b.alpha.y) return anisotropic_albedo(b.alpha, b.wo);
    return ggx_albedo(roughness, b.wo.z);
  }

  // Sets the specular and the diffuse lobe.
  inline LayeredBsdf layered_base(LayeredBsdf b, Surface surface, vec2 albedo) {
    float metal = clamp(surface.metallic, 0.0f, 1.0f);
    float opaque = (1.0f - metal) * (1.0f - clamp(surface.transmission, 0.0f, 1.0f));
    vec3 base = clamp(surface.base_color, vec3(0.0f), vec3(1.0f));
    float film = b.iridescence;
    float root = (surface.ior - 1.0f) / (surface.ior + 1.0f);
    vec3 f0 = b.dielectric_f0 * b.glass_weight;
    // An index near 1 gives no highlight at grazing angles either (Lagarde 2014).
    vec3 f90 = vec3(b.glass_weight * clamp(50.0f * root * root, 0.0f, 1.0f));

    float lost = 1.0f / max(albedo.x + albedo.y, 1e-3f) - 1.0f;
    vec3 dielectric_gain = vec3(1.0f) + f0 * lost;
    vec3 metal_gain = vec3(1.0f) + base * lost;
    b.specular_f0 = (base * metal_gain * metal + f0 * dielectric_gain * opaque) * (1.0f - film);
    b.specular_f90 = (metal_gain * metal + f90 * dielectric_gain * opaque) * (1.0f - film);
    float left_over = (1.0f - film) * (1.0f - min(largest((f0 * albedo.x + f90 * albedo.y) * dielectric_gain), 1.0f));
    vec3 reflected = b.specular_f0 * albedo.x + b.specular_f90 * albedo.y;
    b.film_dielectric = vec3(0.0f);
    b.film_metal = vec3(0.0f);
    if (film > 0.0f && opaque > 0.0f) {
      vec3 mean = mean_film(b, b.dielectric_f0);
      vec3 gain = vec3(1.0f) + mean * lost;
      vec3 covered = mean * gain * (albedo.x + albedo.y);
      b.film_dielectric = gain * (opaque * film);
      left_over += film * (1.0f - min(largest(covered), 1.0f));
      reflected += covered * (opaque * film);
    }
    if (film > 0.0f && metal > 0.0f) {
      vec3 mean = mean_film(b, b.metal_f0);
      b.film_metal = (vec3(1.0f) + mean * lost) * (metal * film);
      reflected += mean * b.film_metal * (albedo.x + albedo.y);
    }
    float through = clamp(surface_layers.diffuse_transmission, 0.0f, 1.0f);
    vec3 beyond = clamp(surface_layers.diffuse_transmission_color, vec3(0.0f), vec3(1.0f));
    b.diffuse = base * (opaque * left_over * (1.0f - through));
    b.diffuse_through = beyond * (opaque * left_over * through);
    b.p_specular = luminance(reflected);
    return b;
  }

  // The fraction of light that single scattering keeps at rough glass. The table has one alpha and the reflectance of
  // plain indices; for glass with another reflectance, reflection and transmission are re-weighted.
  inline float kept_by_volume(LayeredBsdf b, vec2 albedo) {
    float kept = glass_albedo(b.eta, sqrt(sqrt(b.alpha.x * b.alpha.y)), b.wo.z);
    if (b.eta <= 1.0f) return kept;
    float root = (b.eta - 1.0f) / (b.eta + 1.0f);
    float f0 = root * root;
    float grazing = albedo.y / max(albedo.x + albedo.y, 1e-3f);
    float plain = f0 + (1.0f - f0) * grazing;
    float colored = min(largest(b.glass_color) * f0, 1.0f);
    float reflected = (colored + (1.0f - colored) * grazing) * b.glass_weight;
    float kept_above = albedo.x + albedo.y;
    float kept_below = plain < 0.99f ? (kept - plain * kept_above) / (1.0f - plain) : kept_above;
    return reflected * kept_above + (1.0f - reflected) * clamp(kept_below, 0.0f, 1.0f);
  }

  inline LayeredBsdf layered_glass(LayeredBsdf b, Surface surface, vec2 albedo, float eta) {
    float metal = clamp(surface.metallic, 0.0f, 1.0f);
    float clear = (1.0f - metal) * clamp(surface.transmission, 0.0f, 1.0f);
    b.eta = eta;
    b.thin = !surface.volume;
    b.straight = !b.thin && abs(eta - 1.0f) < 1e-3f;
    b.wave_eta = surface_layers.wave_eta;
    b.glass = clamp(surface.base_color, vec3(0.0f), vec3(1.0f));
    b.glass_gain = clear;
    b.p_glass = clear;
    if (clear <= 0.0f || b.mirror || b.straight) return b;
    float kept = albedo.x + albedo.y;
    if (!b.thin) kept = kept_by_volume(b, albedo);
    b.glass_gain = clear / max(kept, 0.1f);
    return b;
  }

  // Sets sheen and coat, and scales all lobes below them by the light that they leave.
  inline LayeredBsdf layered_top(LayeredBsdf b, Surface surface, vec3 direction) {
    bool outside = b.thin || surface.front;
    vec3 sheen = clamp(surface_layers.sheen_color, vec3(0.0f), vec3(1.0f));
    float coat = clamp(surface_layers.clearcoat, 0.0f, 1.0f);
    b.sheen = vec3(0.0f);
    b.p_sheen = 0.0f;
    b.coat = 0.0f;
    b.p_coat = 0.0f;
    float below = 1.0f;
    float above = 1.0f;
    if (outside && coat > 0.0f) {
      float roughness = clamp(surface_layers.clearcoat_roughness, 0.0f, 1.0f);
      b.coat_alpha = roughness * roughness;
      b.coat_frame = frame_around(surface_layers.clearcoat_normal);
      b.coat_wo = to_frame(b.coat_frame, -direction);
      b.coat_wo.z = max(b.coat_wo.z, 1e-5f);
      b.p_coat = coat * (0.04f + 0.96f * schlick(b.coat_wo.z));
      b.coat = b.p_coat;
      if (b.coat_alpha >= kSmoothAlpha) {
        vec2 albedo = ggx_albedo(roughness, b.coat_wo.z);
        b.coat = b.p_coat / max(albedo.x + albedo.y, 1e-3f);
      }
      above = 1.0f - b.p_coat;
    }
    if (outside && largest(sheen) > 0.0f) {
      b.sheen_alpha = sheen_alpha(surface_layers.sheen_roughness);
      float albedo = sheen_albedo(surface_layers.sheen_roughness, b.wo.z);
      b.sheen = sheen * above;
      b.p_sheen = luminance(b.sheen) * albedo;
      below = 1.0f - largest(sheen) * albedo;
    }
    below = below * above;
    b.specular_f0 = b.specular_f0 * below;
    b.specular_f90 = b.specular_f90 * below;
    b.film_dielectric = b.film_dielectric * below;
    b.film_metal = b.film_metal * below;
    b.diffuse = b.diffuse * below;
    b.diffuse_through = b.diffuse_through * below;
    b.glass_gain = b.glass_gain * below;
    b.p_specular = b.p_specular * below;
    b.p_glass = b.p_glass * below;
    return b;
  }

  // Makes the lobes of a view of the surface last passed to read_layers(). direction, eta: as for make_bsdf().
#ifdef __cplusplus
  [[gnu::noinline, gnu::flatten]]
#endif
  inline void
  make_layered(int view, Surface surface, vec3 direction, float eta) {
    LayeredBsdf b = layered_frame(surface, direction);
    float root = (surface.ior - 1.0f) / (surface.ior + 1.0f);
    b.iridescence = clamp(surface_layers.iridescence, 0.0f, 1.0f);
    b.film = surface_layers.film;
    b.glass_color = max(surface_layers.specular_color, vec3(0.0f));
    b.glass_weight = clamp(surface_layers.specular, 0.0f, 1.0f);
    b.dielectric_f0 = min(b.glass_color * (root * root), vec3(1.0f));
    b.metal_f0 = clamp(surface.base_color, vec3(0.0f), vec3(1.0f));
    vec2 albedo = microfacet_albedo(b, surface.roughness);
    b = layered_base(b, surface, albedo);
    b = layered_glass(b, surface, albedo, eta);
    b = layered_top(b, surface, direction);
    b.p_diffuse = luminance(b.diffuse);
    b.p_through = luminance(b.diffuse_through);
    float total = b.p_coat + b.p_sheen + b.p_specular + b.p_diffuse + b.p_through + b.p_glass;
    float scale = total > 0.0f ? 1.0f / total : 0.0f;
    b.p_coat = b.p_coat * scale;
    b.p_sheen = b.p_sheen * scale;
    b.p_specular = b.p_specular * scale;
    b.p_diffuse = b.p_diffuse * scale;
    b.p_through = b.p_through * scale;
    b.p_glass = b.p_glass * scale;
    if (view == kOwnView) {
      own_layered = b;
    } else {
      other_layered = b;
    }
  }

  inline LayeredBsdf layered_of(int view) {
    if (view == kOwnView) return own_layered;
    return other_layered;
  }

#ifdef __cplusplus
  [[gnu::noinline, gnu::flatten]]
#endif
  inline BsdfValue
  layered_value(int view, vec3 direction) {
    return value_of_layers(layered_of(view), direction);
  }

#ifdef __cplusplus
  [[gnu::noinline, gnu::flatten]]
#endif
  inline BsdfSample
  sample_layered(int view, float pick, vec2 uv) {
    return sample_of_layers(layered_of(view), pick, uv);
  }

  // Fraction of light that passes straight through smooth glass.
#ifdef __cplusplus
  [[gnu::noinline]]
#endif
  inline vec3
  layered_transmittance(int view) {
    LayeredBsdf b = layered_of(view);
    return b.glass * (b.glass_gain * glass_transmittance(glass_reflectance(b, b.wo.z, b.eta)));
  }

  // The albedo for the denoiser: roughly the fraction of white light from all directions that the surface reflects and
  // transmits.
#ifdef __cplusplus
  [[gnu::noinline]]
#endif
  inline vec3
  albedo_of_layers(Surface surface, vec3 direction) {
    float cosine = clamp(-dot(surface.normal, direction), 0.0f, 1.0f);
    vec3 base = clamp(surface.base_color, vec3(0.0f), vec3(1.0f));
    float root = (surface.ior - 1.0f) / (surface.ior + 1.0f);
    vec3 f0 = min(max(surface_layers.specular_color, vec3(0.0f)) * (root * root), vec3(1.0f)) * surface_layers.specular;
    vec3 dielectric = mix(base, clamp(surface_layers.diffuse_transmission_color, vec3(0.0f), vec3(1.0f)),
                          clamp(surface_layers.diffuse_transmission, 0.0f, 1.0f));
    dielectric = dielectric * (1.0f - largest(f0)) + f0;
    vec3 color = mix(dielectric, base, clamp(surface.metallic, 0.0f, 1.0f));
    vec3 sheen = clamp(surface_layers.sheen_color, vec3(0.0f), vec3(1.0f));
    if (largest(sheen) > 0.0f) {
      float albedo = sheen_albedo(surface_layers.sheen_roughness, cosine);
      color = color * (1.0f - largest(sheen) * albedo) + sheen * albedo;
    }
    float coat = clamp(surface_layers.clearcoat, 0.0f, 1.0f) * 0.04f;
    return color * (1.0f - coat) + vec3(coat);
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scattering of light by a surface: glTF 2.0's metallic-roughness model with transmission, energy-conserving.
//
// Every material mixes three lobes:
//   specular GGX reflection of metals and dielectrics with Schlick's Fresnel term, scaled up by the energy that single
//            scattering loses (Turquin, "Practical multiple scattering compensation for microfacet models", 2019);
//   diffuse  Lambert under the dielectric, scaled by the light that the specular lobe above it transmits;
//   glass    reflection and refraction at a dielectric interface (Walter et al. 2007), or transmission through a thin
//            sheet (KHR_materials_transmission), with the same compensation.
// A white surface of any mixture and roughness reflects and transmits exactly the light that it receives.
//
// Radiance is carried divided by the square of the refractive index, so refraction does not change it.
// The path loop only calls make_bsdf, bsdf_value and sample_bsdf. Surfaces with layers (clearcoat, sheen and others)
// have their own lobes in layer_lobes.h; these functions call them.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/layered_bsdf.h"
namespace ods {
#endif

struct Bsdf {
  int view;  // for surfaces with layers, which have other lobes: kOwnView or kOtherView; otherwise -1
  vec3 wo;   // towards the viewer, in the frame
  Frame frame;
  vec3 geometric;
  float alpha;
  float eta;         // index beyond / index on the viewer's side
  bool thin;         // the glass is a sheet: light goes straight through
  bool straight;     // the glass has the same index on both sides: light does not bend, however rough the surface is
  vec3 specular_f0;  // reflectance at normal incidence and at grazing incidence, including weights and compensation
  vec3 specular_f90;
  vec3 diffuse;      // albedo, including all weights
  vec3 glass;        // tint of the transmitted light
  float glass_gain;  // weight and energy compensation of the glass lobe
  float p_specular;  // probabilities of the lobes; they add up to 1
  float p_diffuse;
  float p_glass;
};

#ifdef __cplusplus
struct BsdfEvaluator : LayeredEvaluator {
#endif

  // Makes the BSDF for a ray. direction: the incoming ray's. eta: index beyond the surface over the index on the ray's
  // side. view: kOwnView or kOtherView, for surfaces with layers. Their layers are those last read by read_layers(),
  // and the BSDF is valid until the next one of the same view is made.
  inline Bsdf make_view_bsdf(int view, Surface surface, vec3 direction, float eta) {
    Bsdf bsdf;
    bsdf.view = -1;
    if (surface.layered) {
      bsdf.view = view;
      make_layered(view, surface, direction, eta);
      return bsdf;
    }
    bsdf.geometric = surface.geometric;
    bsdf.frame = frame_around(surface.normal);
    bsdf.wo = to_frame(bsdf.frame, -direction);
    bsdf.wo.z = max(bsdf.wo.z, 1e-5f);
    float roughness = clamp(surface.roughness, 0.0f, 1.0f);
    bsdf.alpha = roughness * roughness;
    bsdf.eta = eta;
    bsdf.thin = !surface.volume;

    float metal = clamp(surface.metallic, 0.0f, 1.0f);
    float clear = (1.0f - metal) * clamp(surface.transmission, 0.0f, 1.0f);
    bsdf.straight = !bsdf.thin && abs(eta - 1.0f) < 1e-3f;
    float opaque = 1.0f - metal - clear;
    vec3 base = clamp(surface.base_color, vec3(0.0f), vec3(1.0f));
    float root = (surface.ior - 1.0f) / (surface.ior + 1.0f);
    float f0 = root * root;
    // An index near 1 gives no highlight at grazing angles either (Lagarde 2014).
    float f90 = clamp(50.0f * f0, 0.0f, 1.0f);

    vec2 albedo = vec2(1.0f, 0.0f);
    float s = schlick(bsdf.wo.z);
    if (bsdf.alpha >= kSmoothAlpha) {
      albedo = ggx_albedo(roughness, bsdf.wo.z);
    } else {
      albedo = vec2(1.0f - s, s);
    }
    float lost = 1.0f / max(albedo.x + albedo.y, 1e-3f) - 1.0f;
    float opaque_gain = 1.0f + f0 * lost;
    vec3 metal_gain = vec3(1.0f) + base * lost;
    bsdf.specular_f0 = base * metal_gain * metal + vec3(opaque * f0 * opaque_gain);
    bsdf.specular_f90 = metal_gain * metal + vec3(opaque * f90 * opaque_gain);
    float covered = min((f0 * albedo.x + f90 * albedo.y) * opaque_gain, 1.0f);
    bsdf.diffuse = base * (opaque * (1.0f - covered));
    bsdf.glass = base;
    bsdf.glass_gain = clear;
    if (clear > 0.0f && bsdf.alpha >= kSmoothAlpha && !bsdf.straight) {
      float kept = bsdf.thin ? albedo.x + albedo.y : glass_albedo(eta, roughness, bsdf.wo.z);
      bsdf.glass_gain = clear / max(kept, 0.1f);
    }

    float specular = luminance(bsdf.specular_f0 * albedo.x + bsdf.specular_f90 * albedo.y);
    float diffuse = luminance(bsdf.diffuse);
    float total = specular + diffuse + clear;
    float scale = total > 0.0f ? 1.0f / total : 0.0f;
    bsdf.p_specular = specular * scale;
    bsdf.p_diffuse = diffuse * scale;
    bsdf.p_glass = clear * scale;
    return bsdf;
  }

  inline Bsdf make_bsdf(Surface surface, vec3 direction, float eta) {
    return make_view_bsdf(kOwnView, surface, direction, eta);
  }

  inline vec3 specular_fresnel(Bsdf bsdf, float cosine) {
    return bsdf.specular_f0 + (bsdf.specular_f90 - bsdf.specular_f0) * schlick(cosine);
  }

  inline float glass_fresnel(Bsdf bsdf, float cosine) {
    return fresnel_dielectric(cosine, bsdf.eta);
  }

  // Value and pdf of reflection off microfacets, without the Fresnel term.
  inline vec2 reflection_value(Bsdf bsdf, vec3 wi) {
    vec3 h = normalize(bsdf.wo + wi);
    float lambda_o = ggx_lambda(bsdf.wo, bsdf.alpha);
    float d = ggx_distribution(h, bsdf.alpha);
    float value = d / (4.0f * bsdf.wo.z * (1.0f + lambda_o + ggx_lambda(wi, bsdf.alpha)));
    float pdf = d / (4.0f * bsdf.wo.z * (1.0f + lambda_o));
    return vec2(value, pdf);
  }

  // Value and pdf of refraction to wi (wi.z < 0), without the Fresnel term.
  inline vec2 refraction_value(Bsdf bsdf, vec3 wi) {
    RefractingFacet facet = refracting_facet(bsdf.wo, wi, bsdf.eta);
    if (facet.cosine <= 0.0f) return vec2(0.0f);
    float lambda_o = ggx_lambda(bsdf.wo, bsdf.alpha);
    float d = ggx_distribution(facet.normal, bsdf.alpha) * facet.cosine * facet.jacobian / bsdf.wo.z;
    return vec2(d / (1.0f + lambda_o + ggx_lambda(wi, bsdf.alpha)), d / (1.0f + lambda_o));
  }

  // BSDF times cosine towards a direction (world space), and the pdf with which sample_bsdf() samples it. Mirrors
  // contribute nothing.
  inline BsdfValue bsdf_value(Bsdf bsdf, vec3 direction) {
    if (bsdf.view >= 0) return layered_value(bsdf.view, direction);
    BsdfValue result;
    result.value = vec3(0.0f);
    result.pdf = 0.0f;
    vec3 wi = to_frame(bsdf.frame, direction);
    bool above = wi.z > 0.0f;
    // A direction that is on different sides of the shading normal and the triangle carries nothing: light would leak.
    if (above != (dot(direction, bsdf.geometric) > 0.0f) || abs(wi.z) < 1e-6f) return result;
    bool rough = bsdf.alpha >= kSmoothAlpha;
    if (above) {
      result.value = bsdf.diffuse * (wi.z / kPi);
      result.pdf = bsdf.p_diffuse * wi.z / kPi;
      if (rough) {
        float cosine = dot(bsdf.wo, normalize(bsdf.wo + wi));
        vec2 reflection = reflection_value(bsdf, wi);
        result.value += specular_fresnel(bsdf, cosine) * reflection.x;
        result.pdf += bsdf.p_specular * reflection.y;
        if (bsdf.p_glass > 0.0f && !bsdf.straight) {
          float fresnel = glass_fresnel(bsdf, cosine);
          result.value += vec3(bsdf.glass_gain * fresnel * reflection.x);
          result.pdf += bsdf.p_glass * fresnel * reflection.y;
        }
      }
    } else if (rough && bsdf.p_glass > 0.0f && !bsdf.straight) {
      vec3 mirrored = vec3(wi.x, wi.y, -wi.z);
      vec2 passage = bsdf.thin ? reflection_value(bsdf, mirrored) : refraction_value(bsdf, wi);
      vec3 h = bsdf.thin ? normalize(bsdf.wo + mirrored) : normalize(bsdf.wo + wi * bsdf.eta);
      float let_through = 1.0f - glass_fresnel(bsdf, abs(dot(bsdf.wo, h)));
      result.value = bsdf.glass * (bsdf.glass_gain * let_through * passage.x);
      result.pdf = bsdf.p_glass * let_through * passage.y;
    }
    return result;
  }

  // Samples the glass lobe: chooses reflection or transmission by Fresnel, using the rest of `pick`, rescaled to 0..1.
  // Local directions.
  inline vec3 sample_glass(Bsdf bsdf, vec3 h, float pick) {
    bool reflected = pick < glass_fresnel(bsdf, dot(bsdf.wo, h));
    vec3 mirror = h * (2.0f * dot(bsdf.wo, h)) - bsdf.wo;
    if (reflected) return mirror;
    if (bsdf.thin) return vec3(mirror.x, mirror.y, -mirror.z);
    return refract_through(bsdf.wo, h, bsdf.eta);
  }

  // The mirror-like parts of a smooth surface have no pdf. Each is chosen with its own probability.
  inline BsdfSample sample_mirror(Bsdf bsdf, bool glass, float pick) {
    vec3 up = vec3(0.0f, 0.0f, 1.0f);
    vec3 wi = glass ? sample_glass(bsdf, up, pick) : vec3(-bsdf.wo.x, -bsdf.wo.y, bsdf.wo.z);
    BsdfSample result;
    result.direction = normalize(from_frame(bsdf.frame, wi));
    result.pdf = 0.0f;
    result.through = wi.z < 0.0f;
    result.weight = vec3(0.0f);
    if (glass) {
      vec3 tint = result.through ? bsdf.glass : vec3(1.0f);
      result.weight = tint * (bsdf.glass_gain / bsdf.p_glass);
    } else {
      result.weight = specular_fresnel(bsdf, bsdf.wo.z) * (1.0f / max(bsdf.p_specular, 1e-20f));  // black surface: 0
    }
    if (wi.z == 0.0f || result.through != (dot(result.direction, bsdf.geometric) < 0.0f)) result.weight = vec3(0.0f);
    return result;
  }

  // Fraction of light that passes straight through smooth glass, which is thin or treated as straight
  // (ods/kernel/path_light.h).
  inline vec3 straight_transmittance(Bsdf bsdf) {
    if (bsdf.view >= 0) return layered_transmittance(bsdf.view);
    return bsdf.glass * (bsdf.glass_gain * (1.0f - glass_fresnel(bsdf, bsdf.wo.z)));
  }

  // pick chooses the lobe, uv the direction; all are uniform in [0, 1).
  inline BsdfSample sample_bsdf(Bsdf bsdf, float pick, vec2 uv) {
    if (bsdf.view >= 0) return sample_layered(bsdf.view, pick, uv);
    bool rough = bsdf.alpha >= kSmoothAlpha;
    bool glass = false;
    vec3 wi = vec3(0.0f);
    vec3 h = vec3(0.0f, 0.0f, 1.0f);
    if (pick < bsdf.p_diffuse) {
      float r = sqrt(uv.x);
      vec2 around = cos_sin(2.0f * kPi * uv.y);
      wi = vec3(r * around.x, r * around.y, sqrt(max(1.0f - uv.x, 1e-9f)));
    } else if (pick < bsdf.p_diffuse + bsdf.p_specular || bsdf.p_glass <= 0.0f) {
      if (!rough) return sample_mirror(bsdf, false, 0.0f);
      h = ggx_sample_visible(bsdf.wo, bsdf.alpha, uv);
      wi = h * (2.0f * dot(bsdf.wo, h)) - bsdf.wo;
    } else {
      float left_over = clamp((pick - bsdf.p_diffuse - bsdf.p_specular) / bsdf.p_glass, 0.0f, 0.9999999f);
      if (!rough || bsdf.straight) return sample_mirror(bsdf, true, left_over);
      h = ggx_sample_visible(bsdf.wo, bsdf.alpha, uv);
      glass = left_over >= glass_fresnel(bsdf, dot(bsdf.wo, h));
      wi = sample_glass(bsdf, h, left_over);
    }
    BsdfSample result;
    result.direction = from_frame(bsdf.frame, wi);
    result.through = wi.z < 0.0f;
    result.weight = vec3(0.0f);
    result.pdf = 0.0f;
    // A microfacet may reflect into the surface, or refract back out: single scattering loses that light.
    float size = length(result.direction);
    if (result.through != glass || !(size > 0.5f)) return result;
    result.direction = result.direction * (1.0f / size);
    BsdfValue value = bsdf_value(bsdf, result.direction);
    result.pdf = value.pdf;
    if (value.pdf > 0.0f) result.weight = value.value * (1.0f / value.pdf);
    return result;
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif

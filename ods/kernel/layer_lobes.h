// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scattering of light by a surface with layers (SurfaceLayers): the lobes of bsdf.h as glTF's extensions change
// them, and the lobes that the extensions add. From the top:
//
//   clearcoat  GGX of index 1.5 about its own normal. It replaces the fraction clearcoat * F(cosine of the viewer) of
//              everything below it, emission included (KHR_materials_clearcoat). It has no effect inside a volume,
//              because the coat is outside.
//   sheen      takes max(sheen color) * its albedo from everything below it (KHR_materials_sheen has two forms; this
//              is the one with the viewer's cosine, in which a white surface stays white).
//   specular   Schlick's term with f0 = min(f0 of the index * color, 1) * weight and f90 = weight
//              (KHR_materials_specular); two alphas (KHR_materials_anisotropy); a thin film in the place of Schlick's
//              term (KHR_materials_iridescence; like the Khronos sample viewer without the specular weight). The layers
//              below a dielectric lose the largest of the three colors' albedos, so they keep their hue.
//   diffuse    Lambert; a part of it is transmitted to the other side (KHR_materials_diffuse_transmission).
//   glass      as in bsdf.h, by the exact Fresnel term F: reflection goes from f0 to f90 as (F - F0) / (1 - F0) does
//              (Cycles' reading), but total reflection stays total. The rest is transmitted.
//
// The energy that single scattering loses is given back as in bsdf.h. If every layer has its default, the result equals
// that of bsdf.h.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/albedo.h"
namespace ods {
#endif

const float kSmoothAlpha = 1e-3f;  // below this the specular and glass lobes are mirrors: one direction, no pdf

// The eye for which a BSDF is evaluated: the one that the path began at, or the other.
const int kOwnView = 0;
const int kOtherView = 1;

struct BsdfValue {
  vec3 value;  // BSDF times cosine
  float pdf;   // pdf with which sample_bsdf() samples the direction, per solid angle
};

struct BsdfSample {
  vec3 direction;  // world, unit length
  vec3 weight;     // BSDF times cosine over pdf; 0 ends the path
  float pdf;       // per solid angle; 0 for a mirror direction, which light sampling cannot find
  bool through;    // the direction leaves on the other side of the surface
};

struct LayeredBsdf {
  Frame frame;  // the frame of all lobes but the coat; the surface is rougher along its tangent
  vec3 wo;      // towards the viewer, in `frame`
  vec3 geometric;
  vec2 alpha;
  bool mirror;  // specular and glass have no width
  float eta;
  bool thin;
  bool straight;
  vec3 specular_f0;  // including weights and compensation, without the film's share
  vec3 specular_f90;
  ThinFilm film;
  float iridescence;
  vec3 film_dielectric;  // weights of the film's reflectance over the dielectric and over the metal
  vec3 film_metal;
  vec3 dielectric_f0;  // reflectance of the layer under the film
  vec3 metal_f0;
  vec3 diffuse;  // albedo, including all weights
  vec3 diffuse_through;
  vec3 glass;        // tint of the transmitted light
  float glass_gain;  // weight and energy compensation
  vec3 glass_color;  // color of the reflection at normal incidence, and the weight of all reflection
  float glass_weight;
  vec3 wave_eta;  // see SurfaceLayers
  vec3 sheen;
  float sheen_alpha;
  Frame coat_frame;
  vec3 coat_wo;
  float coat_alpha;
  float coat;    // weight and energy compensation
  float p_coat;  // probabilities of the lobes; they add up to 1
  float p_sheen;
  float p_specular;
  float p_diffuse;
  float p_through;
  float p_glass;
};

inline float largest(vec3 c) {
  return max(c.x, max(c.y, c.z));
}

inline BsdfValue no_value() {
  BsdfValue value;
  value.value = vec3(0.0f);
  value.pdf = 0.0f;
  return value;
}

// --- reflectance of the base's microfacets

// Reflectance of the base's specular lobe at a microfacet, including weights.
inline vec3 layered_fresnel(LayeredBsdf b, float cosine) {
  vec3 sum = b.specular_f0 + (b.specular_f90 - b.specular_f0) * schlick(cosine);
  if (largest(b.film_dielectric) > 0.0f) sum += b.film_dielectric * film_fresnel(b.film, cosine, b.dielectric_f0);
  if (largest(b.film_metal) > 0.0f) sum += b.film_metal * film_fresnel(b.film, cosine, b.metal_f0);
  return sum;
}

// Reflectance of the glass lobe at a microfacet.
inline vec3 glass_reflectance(LayeredBsdf b, float cosine, float eta) {
  float sin2 = (1.0f - cosine * cosine) / (eta * eta);
  if (sin2 >= 1.0f) return vec3(1.0f);
  float root = (eta - 1.0f) / (eta + 1.0f);
  float f0 = root * root;
  float grazing = schlick(cosine);
  if (f0 < 0.999f) grazing = clamp((fresnel_dielectric(cosine, eta) - f0) / (1.0f - f0), 0.0f, 1.0f);
  vec3 colored = min(b.glass_color * f0, vec3(1.0f));
  vec3 reflected = (colored + (vec3(1.0f) - colored) * grazing) * b.glass_weight;
  if (b.iridescence <= 0.0f) return reflected;
  float in_air = eta < 1.0f ? sqrt(1.0f - sin2) : cosine;
  return mix(reflected, film_fresnel(b.film, in_air, colored), b.iridescence);
}

// Transmittance of glass with this reflectance.
inline float glass_transmittance(vec3 reflectance) {
  return max(1.0f - largest(reflectance), 0.0f);
}

// The probability of sampling the glass lobe by reflection.
inline float reflection_chance(vec3 reflectance) {
  float reflected = luminance(reflectance);
  return reflected / (reflected + glass_transmittance(reflectance));
}

// Value and pdf of reflection off the base's microfacets, without the Fresnel term.
inline vec2 layered_reflection(LayeredBsdf b, vec3 wi) {
  vec3 h = normalize(b.wo + wi);
  float lambda_o = ggx_lambda(b.wo, b.alpha);
  float d = ggx_distribution(h, b.alpha) / (4.0f * b.wo.z);
  return vec2(d / (1.0f + lambda_o + ggx_lambda(wi, b.alpha)), d / (1.0f + lambda_o));
}

// Value and pdf of refraction to wi (wi.z < 0), without the Fresnel term.
inline vec2 layered_refraction(LayeredBsdf b, vec3 wi) {
  RefractingFacet facet = refracting_facet(b.wo, wi, b.eta);
  if (facet.cosine <= 0.0f) return vec2(0.0f);
  float lambda_o = ggx_lambda(b.wo, b.alpha);
  float d = ggx_distribution(facet.normal, b.alpha) * facet.cosine * facet.jacobian / b.wo.z;
  return vec2(d / (1.0f + lambda_o + ggx_lambda(wi, b.alpha)), d / (1.0f + lambda_o));
}

// --- value and pdf of all lobes

// Value and pdf of all lobes but the coat, towards a direction above the surface, in b.frame.
inline BsdfValue layered_above(LayeredBsdf b, vec3 wi) {
  BsdfValue result;
  result.value = b.diffuse * (wi.z / kPi);
  result.pdf = b.p_diffuse * wi.z / kPi;
  if (b.p_sheen > 0.0f) {
    result.value += b.sheen * sheen_value(b.wo, wi, b.sheen_alpha);
    result.pdf += b.p_sheen * (0.5f / kPi);
  }
  if (b.mirror) return result;
  float cosine = dot(b.wo, normalize(b.wo + wi));
  vec2 reflection = layered_reflection(b, wi);
  result.value += layered_fresnel(b, cosine) * reflection.x;
  result.pdf += b.p_specular * reflection.y;
  if (b.p_glass > 0.0f && !b.straight) {
    vec3 reflectance = glass_reflectance(b, cosine, b.eta);
    result.value += reflectance * (b.glass_gain * reflection.x);
    result.pdf += b.p_glass * reflection_chance(reflectance) * reflection.y;
  }
  return result;
}

// Value and pdf of all lobes but the coat, towards a direction below the surface, in b.frame.
inline BsdfValue layered_below(LayeredBsdf b, vec3 wi) {
  BsdfValue result;
  result.value = b.diffuse_through * (-wi.z / kPi);
  result.pdf = b.p_through * -wi.z / kPi;
  if (b.mirror || b.p_glass <= 0.0f || b.straight) return result;
  vec3 mirrored = vec3(wi.x, wi.y, -wi.z);
  vec2 passage = b.thin ? layered_reflection(b, mirrored) : layered_refraction(b, wi);
  vec3 h = b.thin ? normalize(b.wo + mirrored) : normalize(b.wo + wi * b.eta);
  vec3 reflectance = glass_reflectance(b, abs(dot(b.wo, h)), b.eta);
  result.value += b.glass * (b.glass_gain * glass_transmittance(reflectance) * passage.x);
  result.pdf += b.p_glass * (1.0f - reflection_chance(reflectance)) * passage.y;
  return result;
}

// Value and pdf of the coat.
inline BsdfValue coat_value(LayeredBsdf b, vec3 direction) {
  vec3 wi = to_frame(b.coat_frame, direction);
  if (b.p_coat <= 0.0f || b.coat_alpha < kSmoothAlpha || wi.z < 1e-6f) return no_value();
  vec3 h = normalize(b.coat_wo + wi);
  float lambda_o = ggx_lambda(b.coat_wo, b.coat_alpha);
  float d = ggx_distribution(h, b.coat_alpha) / (4.0f * b.coat_wo.z);
  BsdfValue result;
  result.value = vec3(b.coat * d / (1.0f + lambda_o + ggx_lambda(wi, b.coat_alpha)));
  result.pdf = b.p_coat * d / (1.0f + lambda_o);
  return result;
}

// BSDF times cosine towards a direction (world space), and the pdf with which sample_of_layers() samples it.
inline BsdfValue value_of_layers(LayeredBsdf b, vec3 direction) {
  BsdfValue result = no_value();
  bool outside = dot(direction, b.geometric) > 0.0f;
  vec3 wi = to_frame(b.frame, direction);
  // A direction that is on different sides of a shading normal and the triangle carries nothing: light would leak.
  if ((wi.z > 0.0f) == outside && abs(wi.z) >= 1e-6f) {
    if (outside) result = layered_above(b, wi);
    if (!outside) result = layered_below(b, wi);
  }
  if (outside) {
    BsdfValue coat = coat_value(b, direction);
    result.value += coat.value;
    result.pdf += coat.pdf;
  }
  return result;
}

// --- sampling

inline BsdfSample sample_towards(vec3 direction, vec3 weight, bool through) {
  BsdfSample result;
  result.direction = direction;
  result.weight = weight;
  result.pdf = 0.0f;
  result.through = through;
  return result;
}

// Samples smooth glass. `pick` in [0, 1) decides between reflection and transmission by the eta of this path's colour.
// All three colours are reflected in one direction, so all three continue: each is weighted by its own reflectance over
// the probability of this direction, which is the mean over the three colours that the path might have.
inline BsdfSample sample_smooth_glass(LayeredBsdf b, float pick) {
  vec3 up = vec3(0.0f, 0.0f, 1.0f);
  vec3 reflectance = glass_reflectance(b, b.wo.z, b.eta);
  float chance = reflection_chance(reflectance);
  float scale = b.glass_gain / b.p_glass;
  if (pick < chance) {
    vec3 weight = reflectance * (1.0f / chance);
    if (b.wave_eta.x > 0.0f) {
      vec3 red = glass_reflectance(b, b.wo.z, b.wave_eta.x);
      vec3 green = glass_reflectance(b, b.wo.z, b.wave_eta.y);
      vec3 blue = glass_reflectance(b, b.wo.z, b.wave_eta.z);
      float sum = reflection_chance(red) + reflection_chance(green) + reflection_chance(blue);
      weight = vec3(red.x, green.y, blue.z) * (3.0f / sum);
    }
    return sample_towards(from_frame(b.frame, vec3(-b.wo.x, -b.wo.y, b.wo.z)), weight * scale, false);
  }
  vec3 wi = b.thin ? -b.wo : refract_through(b.wo, up, b.eta);
  vec3 weight = b.glass * (glass_transmittance(reflectance) * scale / max(1.0f - chance, 1e-20f));
  return sample_towards(from_frame(b.frame, wi), weight, true);
}

// Drops a sampled mirror direction that is on the wrong side of the triangle.
inline BsdfSample checked_mirror(LayeredBsdf b, BsdfSample found) {
  float size = length(found.direction);
  bool lost = !(size > 0.5f) || found.through != (dot(found.direction, b.geometric) < 0.0f);
  found.direction = found.direction * (1.0f / max(size, 1e-20f));
  if (lost) found.weight = vec3(0.0f);
  return found;
}

// The sample for a direction drawn from a lobe with width. Its weight is the sum of all lobes. through: whether the
// chosen lobe transmits.
inline BsdfSample checked_sample(LayeredBsdf b, vec3 direction, bool through) {
  BsdfSample result = sample_towards(direction, vec3(0.0f), dot(direction, b.geometric) < 0.0f);
  float size = length(direction);
  if (result.through != through || !(size > 0.5f)) return result;
  result.direction = direction * (1.0f / size);
  BsdfValue value = value_of_layers(b, result.direction);
  result.pdf = value.pdf;
  if (value.pdf > 0.0f) result.weight = value.value * (1.0f / value.pdf);
  return result;
}

inline BsdfSample sample_coat(LayeredBsdf b, vec2 uv) {
  if (b.coat_alpha < kSmoothAlpha) {
    vec3 wi = vec3(-b.coat_wo.x, -b.coat_wo.y, b.coat_wo.z);
    return checked_mirror(b, sample_towards(from_frame(b.coat_frame, wi), vec3(b.coat / b.p_coat), false));
  }
  vec3 h = ggx_sample_visible(b.coat_wo, b.coat_alpha, uv);
  vec3 wi = h * (2.0f * dot(b.coat_wo, h)) - b.coat_wo;
  // Light that the coat's microfacets reflect into the surface is lost.
  if (wi.z < 1e-6f) return sample_towards(vec3(0.0f), vec3(0.0f), false);
  return checked_sample(b, from_frame(b.coat_frame, wi), false);
}

// Samples the specular lobe, or the glass lobe with the rest of `pick`, rescaled to 0..1.
inline BsdfSample sample_microfacets(LayeredBsdf b, bool glass, float pick, vec2 uv) {
  if (glass && (b.mirror || b.straight)) return checked_mirror(b, sample_smooth_glass(b, pick));
  if (b.mirror) {
    vec3 weight = layered_fresnel(b, b.wo.z) * (1.0f / max(b.p_specular, 1e-20f));
    return checked_mirror(b, sample_towards(from_frame(b.frame, vec3(-b.wo.x, -b.wo.y, b.wo.z)), weight, false));
  }
  vec3 h = ggx_sample_visible(b.wo, b.alpha, uv);
  float cosine = dot(b.wo, h);
  vec3 wi = h * (2.0f * cosine) - b.wo;
  bool through = glass && pick >= reflection_chance(glass_reflectance(b, cosine, b.eta));
  if (through) wi = b.thin ? vec3(wi.x, wi.y, -wi.z) : refract_through(b.wo, h, b.eta);
  // A microfacet may reflect into the surface, or refract back out: single scattering loses that light.
  if (through != (wi.z < 0.0f)) return sample_towards(vec3(0.0f), vec3(0.0f), false);
  return checked_sample(b, from_frame(b.frame, wi), through);
}

// pick chooses the lobe, uv the direction; all are uniform in [0, 1).
inline BsdfSample sample_of_layers(LayeredBsdf b, float pick, vec2 uv) {
  vec2 around = cos_sin(2.0f * kPi * uv.y);
  float diffuse = b.p_diffuse + b.p_through;
  if (pick < diffuse) {
    float r = sqrt(uv.x);
    bool through = pick >= b.p_diffuse;
    float z = sqrt(max(1.0f - uv.x, 1e-9f));
    return checked_sample(b, from_frame(b.frame, vec3(r * around.x, r * around.y, through ? -z : z)), through);
  }
  float sheen = diffuse + b.p_sheen;
  if (pick < sheen) {
    float r = sqrt(max(1.0f - uv.x * uv.x, 0.0f));
    return checked_sample(b, from_frame(b.frame, vec3(r * around.x, r * around.y, max(uv.x, 1e-5f))), false);
  }
  float coat = sheen + b.p_coat;
  if (pick < coat) return sample_coat(b, uv);
  bool glass = b.p_glass > 0.0f && pick >= coat + b.p_specular;
  float left_over = glass ? clamp((pick - coat - b.p_specular) / b.p_glass, 0.0f, 0.9999999f) : 0.0f;
  return sample_microfacets(b, glass, left_over, uv);
}

#ifdef __cplusplus
}  // namespace ods
#endif

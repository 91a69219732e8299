// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Microfacets in a frame whose z axis is the surface normal: the GGX distribution with Fresnel's reflectances, and the
// "Charlie" distribution of cloth's sheen as KHR_materials_sheen defines it (its Fresnel term is left out, which the
// extension allows).
// Sources: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007; Heitz, "Understanding the
// Masking-Shadowing Function", 2014; Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023;
// Conty Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", 2017.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/camera/camera.h"
#include "ods/kernel/math.h"
namespace ods {
#endif

// Density of microfacet normals h, per projected area. alpha = roughness squared, > 0.
inline float ggx_distribution(vec3 h, float alpha) {
  float a2 = alpha * alpha;
  float c = (h.x * h.x + h.y * h.y) / a2 + h.z * h.z;
  return 1.0f / (kPi * a2 * c * c);
}

// Smith's auxiliary function Lambda; masking is 1 / (1 + lambda).
inline float ggx_lambda(vec3 w, float alpha) {
  float z2 = max(w.z * w.z, 1e-12f);
  return 0.5f * (sqrt(1.0f + alpha * alpha * (w.x * w.x + w.y * w.y) / z2) - 1.0f);
}

inline float ggx_visible_pdf(vec3 wo, vec3 h, float alpha) {
  return max(dot(wo, h), 0.0f) * ggx_distribution(h, alpha) / (wo.z * (1.0f + ggx_lambda(wo, alpha)));
}

// Density for two alphas, along x and along y, both > 0. Sources: Heitz 2014; Dupuy and Benyoub 2023.
inline float ggx_distribution(vec3 h, vec2 alpha) {
  float x = h.x / alpha.x;
  float y = h.y / alpha.y;
  float c = x * x + y * y + h.z * h.z;
  return 1.0f / (kPi * alpha.x * alpha.y * c * c);
}

inline float ggx_lambda(vec3 w, vec2 alpha) {
  float x = alpha.x * w.x;
  float y = alpha.y * w.y;
  return 0.5f * (sqrt(1.0f + (x * x + y * y) / max(w.z * w.z, 1e-12f)) - 1.0f);
}

// Samples a microfacet normal visible from wo (wo.z > 0).
inline vec3 ggx_sample_visible(vec3 wo, vec2 alpha, vec2 u) {
  vec3 stretched = normalize(vec3(alpha.x * wo.x, alpha.y * wo.y, wo.z));
  vec2 around = cos_sin(2.0f * kPi * u.x);
  float z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
  float r = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
  vec3 h = vec3(r * around.x, r * around.y, z) + stretched;
  return normalize(vec3(alpha.x * h.x, alpha.y * h.y, max(h.z, 1e-9f)));
}

// Samples a visible microfacet normal for one alpha; the pdf is ggx_visible_pdf().
inline vec3 ggx_sample_visible(vec3 wo, float alpha, vec2 u) {
  return ggx_sample_visible(wo, vec2(alpha), u);
}

// The weight of the grazing reflectance in Schlick's approximation. cosine: between the ray and the microfacet normal.
inline float schlick(float cosine) {
  float m = clamp(1.0f - cosine, 0.0f, 1.0f);
  float m2 = m * m;
  return m2 * m2 * m;
}

// Reflectance of a smooth interface between dielectrics; eta = index beyond / index on the ray's side.
inline float fresnel_dielectric(float cosine, float eta) {
  float sin2 = (1.0f - cosine * cosine) / (eta * eta);
  if (sin2 >= 1.0f) return 1.0f;
  float beyond = sqrt(1.0f - sin2);
  float parallel = (eta * cosine - beyond) / (eta * cosine + beyond);
  float perpendicular = (cosine - eta * beyond) / (cosine + eta * beyond);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

// The microfacet that refracts between wo and wi (wi.z < 0).
struct RefractingFacet {
  vec3 normal;     // towards wo
  float cosine;    // between wo and the normal; 0 if no facet refracts in this way
  float jacobian;  // solid angle of normals over the solid angle of wi
};

inline RefractingFacet refracting_facet(vec3 wo, vec3 wi, float eta) {
  RefractingFacet facet;
  facet.cosine = 0.0f;
  facet.jacobian = 0.0f;
  facet.normal = wo + wi * eta;
  float size = length(facet.normal);
  if (size < 1e-6f) return facet;
  facet.normal = facet.normal * ((facet.normal.z < 0.0f ? -1.0f : 1.0f) / size);
  float o = dot(wo, facet.normal);
  float i = dot(wi, facet.normal);
  if (o <= 0.0f || i >= 0.0f) return facet;
  float denominator = o + eta * i;
  facet.cosine = o;
  facet.jacobian = eta * eta * -i / max(denominator * denominator, 1e-12f);
  return facet;
}

// Direction refracted at an interface with microfacet normal h (dot(wo, h) > 0); zero at total reflection.
inline vec3 refract_through(vec3 wo, vec3 h, float eta) {
  float cosine = dot(wo, h);
  float sin2 = (1.0f - cosine * cosine) / (eta * eta);
  if (sin2 >= 1.0f) return vec3(0.0f);
  return h * (cosine / eta - sqrt(1.0f - sin2)) - wo * (1.0f / eta);
}

// --- sheen

// Minimum roughness: with fibres closer to parallel, the lobe is too narrow for single precision.
const float kMinSheenRoughness = 0.07f;

inline float sheen_alpha(float roughness) {
  float r = clamp(roughness, kMinSheenRoughness, 1.0f);
  return r * r;
}

// Density of microfacet normals. cosine: between the microfacet normal and the surface normal.
inline float sheen_distribution(float cosine, float alpha) {
  float sin2 = max(1.0f - cosine * cosine, 1e-7f);
  return (2.0f + 1.0f / alpha) * pow(sin2, 0.5f / alpha) / (2.0f * kPi);
}

inline float sheen_lambda_exponent(float x, float alpha) {
  float m = (1.0f - alpha) * (1.0f - alpha);
  float a = mix(21.5473f, 25.3245f, m);
  float b = mix(3.82987f, 3.32435f, m);
  float c = mix(0.19823f, 0.16801f, m);
  float d = mix(-1.97760f, -1.27393f, m);
  float e = mix(-4.32054f, -4.85967f, m);
  return a / (1.0f + b * pow(x, c)) + d * x + e;
}

// Smith's auxiliary function Lambda, as a curve through measured values.
inline float sheen_lambda(float cosine, float alpha) {
  float x = clamp(cosine, 1e-6f, 1.0f);
  if (x < 0.5f) return exp(sheen_lambda_exponent(x, alpha));
  return exp(2.0f * sheen_lambda_exponent(0.5f, alpha) - sheen_lambda_exponent(1.0f - x, alpha));
}

// BRDF times cosine of white sheen. wo.z, wi.z > 0.
inline float sheen_value(vec3 wo, vec3 wi, float alpha) {
  vec3 h = normalize(wo + wi);
  float masking = 1.0f + sheen_lambda(wo.z, alpha) + sheen_lambda(wi.z, alpha);
  return sheen_distribution(h.z, alpha) / (4.0f * wo.z * masking);
}

#ifdef __cplusplus
}  // namespace ods
#endif

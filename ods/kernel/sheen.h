// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The sheen of cloth as KHR_materials_sheen defines it: microfacets of the "Charlie" distribution, in a frame whose z
// axis is the surface normal. Fresnel's term is left out, which the extension allows.
// Source: Conty Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", 2017.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/camera/camera.h"
#include "ods/kernel/math.h"
namespace ods {
#endif

// Fibres closer to parallel than this give a lobe too narrow for single precision.
const float kMinSheenRoughness = 0.07f;

inline float sheen_alpha(float roughness) {
  float r = clamp(roughness, kMinSheenRoughness, 1.0f);
  return r * r;
}

// Density of microfacet normals at this cosine to the surface normal.
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

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The reflectance of a thin film over a base, as KHR_materials_iridescence defines it.
// Source: Belcour and Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence",
// 2017, with the extension's simplifications: no polarisation, Schlick's Fresnel terms, a base without absorption.
// The outside is air, also under a clearcoat (the reading of the Khronos sample viewer).
#ifdef __cplusplus
#pragma once
#include "ods/kernel/microfacets.h"
namespace ods {
#endif

struct ThinFilm {
  float ior;
  float thickness;  // nanometres
};

// Reflectance at normal incidence.
inline float film_interface(float beyond, float here) {
  float root = (beyond - here) / (beyond + here);
  return root * root;
}

// The eye's response to cos(2 pi * path / wavelength + shift), relative to that to white light, as linear RGB.
// path: nanometres. shift: radians, of R, G and B.
inline vec3 film_response(float path, vec3 shift) {
  float phase = 2.0f * kPi * path * 1e-9f;
  float square = phase * phase;
  // Gaussians through the colour matching functions. The scales are each curve's height times the square root of
  // 2 pi times its variance, over the area of the Y curve.
  float x = 0.846590f * cos_of(1.6810e6f * phase + shift.x) * exp(-4.3278e9f * square) +
            0.153868f * cos_of(2.2399e6f * phase + shift.x) * exp(-4.5282e9f * square);
  float y = 1.000222f * cos_of(1.7953e6f * phase + shift.y) * exp(-9.3046e9f * square);
  float z = 1.001122f * cos_of(2.2084e6f * phase + shift.z) * exp(-6.6121e9f * square);
  return vec3(3.2404542f * x - 1.5371385f * y - 0.4985314f * z, -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
              0.0556434f * x - 0.2040259f * y + 1.0572252f * z);
}

// cosine: of the ray in air to the microfacet normal. base_f0: reflectance of the base in air at normal incidence.
inline vec3 film_fresnel(ThinFilm film, float cosine, vec3 base_f0) {
  // A film much thinner than light's wavelengths has no effect of its own.
  float ior = mix(1.0f, film.ior, smoothstep(0.0f, 0.03f, film.thickness));
  float c2 = 1.0f - (1.0f - cosine * cosine) / (ior * ior);
  if (c2 <= 0.0f) return vec3(1.0f);
  c2 = sqrt(c2);
  float top0 = film_interface(ior, 1.0f);
  float top = top0 + (1.0f - top0) * schlick(cosine);
  float let_through = 1.0f - top;
  float top_shift = ior < 1.0f ? 0.0f : kPi;
  vec3 root = sqrt(clamp(base_f0, vec3(0.0f), vec3(0.9999f)));
  vec3 base_ior = (vec3(1.0f) + root) / (vec3(1.0f) - root);
  vec3 bottom0 =
      vec3(film_interface(base_ior.x, ior), film_interface(base_ior.y, ior), film_interface(base_ior.z, ior));
  vec3 bottom = bottom0 + (vec3(1.0f) - bottom0) * schlick(c2);
  vec3 shift = vec3(top_shift) +
               vec3(base_ior.x < ior ? kPi : 0.0f, base_ior.y < ior ? kPi : 0.0f, base_ior.z < ior ? kPi : 0.0f);
  float path = 2.0f * ior * film.thickness * c2;
  vec3 both = clamp(bottom * top, vec3(1e-5f), vec3(0.9999f));
  vec3 amplitude = sqrt(both);
  // Sums of the light that leaves after 1, 2, ... reflections at the base: the mean, then the part due to interference.
  vec3 inner = bottom * (let_through * let_through) / (vec3(1.0f) - both);
  vec3 sum = vec3(top) + inner;
  vec3 wave = (inner - vec3(let_through)) * amplitude;
  sum += wave * (2.0f * film_response(path, shift));
  wave = wave * amplitude;
  sum += wave * (2.0f * film_response(2.0f * path, shift * 2.0f));
  // The curves sometimes leave a colour outside the gamut; the reflectance cannot exceed 1.
  return clamp(sum, vec3(0.0f), vec3(1.0f));
}

#ifdef __cplusplus
}  // namespace ods
#endif

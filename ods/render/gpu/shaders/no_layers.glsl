// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Stands in for ods/kernel/surface_layers.h and ods/kernel/layered_bsdf.h where no material has layers. Drivers inline
// every function, and those two headers are a third of the kernel.
struct SurfaceLayers {
  float anisotropy;
  vec3 clearcoat_normal;
  float diffuse_transmission;
  vec3 wave_eta;
};
SurfaceLayers surface_layers;

void read_layers(Hit hit, Surface surface, vec3 direction, bool reduced) {}
float emission_below_coat(Material material, Corners k, float cosine) { return 1.0; }
void make_layered(int view, Surface surface, vec3 direction, float eta) {}
BsdfValue layered_value(int view, vec3 direction) { return no_value(); }
BsdfSample sample_layered(int view, float pick, vec2 uv) { return sample_towards(vec3(0.0), vec3(0.0), false); }
vec3 layered_transmittance(int view) { return vec3(0.0); }
vec3 albedo_of_layers(Surface surface, vec3 direction) { return vec3(0.0); }

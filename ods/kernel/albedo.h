// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Albedos of the lobes, from the tables (ods/render/tables.h): the fraction of light from all directions that a lobe
// reflects.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/microfacets.h"
#include "ods/kernel/surface_layers.h"
namespace ods {
#endif

// A position between two nodes on one axis of a table: the node before it, and the weight of the next.
struct TablePlace {
  int node;
  float share;
};

// x: 0..1 over the axis.
inline TablePlace table_place(float x, int size) {
  float at = clamp(x, 0.0f, 1.0f) * float(size - 1);
  TablePlace place;
  place.node = min(int(at), size - 2);
  place.share = at - float(place.node);
  return place;
}

#ifdef __cplusplus
struct AlbedoReader : LayerReader {
#endif

  // Albedo of the specular lobe without compensation, in Schlick's two parts: f0 * x + f90 * y. A perfect mirror has
  // the albedo x + y.
  inline vec2 ggx_albedo(float roughness, float cosine) {
    float r = clamp(roughness, 0.0f, 1.0f) * float(kGgxSize - 1);
    float c = clamp(cosine, 0.0f, 1.0f) * float(kGgxSize - 1);
    int r0 = min(int(r), kGgxSize - 2);
    int c0 = min(int(c), kGgxSize - 2);
    float fr = r - float(r0);
    float fc = c - float(c0);
    int at = kGgxTable + 2 * (r0 * kGgxSize + c0);
    int next = at + 2 * kGgxSize;
    float x = mix(mix(scene_table(at), scene_table(at + 2), fc), mix(scene_table(next), scene_table(next + 2), fc), fr);
    float y = mix(mix(scene_table(at + 1), scene_table(at + 3), fc),
                  mix(scene_table(next + 1), scene_table(next + 3), fc), fr);
    return vec2(x, y);
  }

  // Albedo of the rough glass lobe, reflection and transmission together.
  inline float glass_albedo(float eta, float roughness, float cosine) {
    // The axes are stretched towards eta = 1, where glass has no effect, and total reflection starts at the middle of
    // the table.
    float reflectance = sqrt(abs((eta - 1.0f) / (eta + 1.0f)) * 2.0f);
    float place = sqrt(cosine);
    float critical = sqrt(max(1.0f - eta * eta, 0.0f));
    if (eta < 1.0f && cosine < critical) place = 0.5f * sqrt(cosine / critical);
    if (eta < 1.0f && cosine >= critical) place = 0.5f + 0.5f * sqrt((cosine - critical) / max(1.0f - critical, 1e-7f));
    float e = clamp(reflectance, 0.0f, 1.0f) * float(kGlassSize - 1);
    float r = clamp(roughness, 0.0f, 1.0f) * float(kGlassSize - 1);
    float c = clamp(place, 0.0f, 1.0f) * float(kGlassSize - 1);
    int e0 = min(int(e), kGlassSize - 2);
    int r0 = min(int(r), kGlassSize - 2);
    int c0 = min(int(c), kGlassSize - 2);
    float fe = e - float(e0);
    float fr = r - float(r0);
    float fc = c - float(c0);
    int side = eta >= 1.0f ? 0 : 1;
    float sum = 0.0f;
    for (int corner = 0; corner < 8; corner++) {
      int de = corner & 1;
      int dr = (corner >> 1) & 1;
      int dc = corner >> 2;
      float weight = (de == 1 ? fe : 1.0f - fe) * (dr == 1 ? fr : 1.0f - fr) * (dc == 1 ? fc : 1.0f - fc);
      int row = (side * kGlassSize + e0 + de) * kGlassSize + r0 + dr;
      sum += weight * scene_table(kGlassTable + row * kGlassSize + c0 + dc);
    }
    return sum;
  }

  // Like ggx_albedo() for two alphas; wo in the frame whose x axis has alpha.x >= alpha.y.
  inline vec2 anisotropic_albedo(vec2 alpha, vec3 wo) {
    float across = sqrt(alpha.y);
    float along = across < 1.0f ? (sqrt(alpha.x) - across) / (1.0f - across) : 0.0f;
    float turn = wo.x * wo.x / max(wo.x * wo.x + wo.y * wo.y, 1e-12f);
    TablePlace a = table_place(across, kAnisotropicSize);
    TablePlace b = table_place(along, kAnisotropicAlong);
    TablePlace c = table_place(turn, kAnisotropicTurns);
    TablePlace d = table_place(wo.z, kAnisotropicSize);
    vec2 sum = vec2(0.0f);
    for (int corner = 0; corner < 16; corner++) {
      int da = corner & 1;
      int db = (corner >> 1) & 1;
      int dc = (corner >> 2) & 1;
      int dd = corner >> 3;
      float weight = (da == 1 ? a.share : 1.0f - a.share) * (db == 1 ? b.share : 1.0f - b.share) *
                     (dc == 1 ? c.share : 1.0f - c.share) * (dd == 1 ? d.share : 1.0f - d.share);
      int row = ((a.node + da) * kAnisotropicAlong + b.node + db) * kAnisotropicTurns + c.node + dc;
      int at = kAnisotropicTable + 2 * (row * kAnisotropicSize + d.node + dd);
      sum += vec2(scene_table(at), scene_table(at + 1)) * weight;
    }
    return sum;
  }

  // Albedo of white sheen; at most 1.
  inline float sheen_albedo(float roughness, float cosine) {
    TablePlace r = table_place(roughness, kSheenSize);
    TablePlace c = table_place(cosine, kSheenSize);
    int at = kSheenTable + r.node * kSheenSize + c.node;
    float before = mix(scene_table(at), scene_table(at + 1), c.share);
    float after = mix(scene_table(at + kSheenSize), scene_table(at + kSheenSize + 1), c.share);
    return min(mix(before, after, r.share), 1.0f);
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif

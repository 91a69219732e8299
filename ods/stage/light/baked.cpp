// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/baked.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

#include "ods/base/text.h"
#include "ods/kernel/surface.h"
#include "ods/stage/light/areas.h"

namespace ods {
namespace {

constexpr float kBlack = 0.02f;

// Returns whether the emission is the surface's painted colour.
bool paints_by_emission(const Material& material) {
  if (!is_emissive(material)) return false;
  if (luminance(vec3(material.base_color)) < kBlack) return true;
  return material.emission_slot.texture >= 0 && material.base_color_slot.texture == material.emission_slot.texture;
}

bool glows_as_painted(const Material& material) {
  return material.emission_slot.texture >= 0 && paints_by_emission(material);
}

bool has_only_color(const Material& material) {
  return material.base_color_slot.texture >= 0 && material.normal_slot.texture < 0 &&
         material.metallic_roughness_slot.texture < 0 && material.transmission == 0.0f && !is_emissive(material) &&
         luminance(vec3(material.base_color)) > kBlack;
}

// Returns whether the name contains "bake" as a separate word, as opposed to "bakery" or "bakelite".
bool has_word_bake(const std::string& name) {
  for (size_t at = name.find("bake"); at != std::string::npos; at = name.find("bake", at + 1)) {
    const auto is_letter = [&](size_t i) {
      return i < name.size() && std::isalpha(static_cast<unsigned char>(name[i]));
    };
    if (!(at > 0 && is_letter(at - 1)) && !is_letter(at + 4)) return true;
  }
  return false;
}

bool has_baked_name(const Scene& scene, size_t material) {
  if (material >= scene.material_names.size() || scene.materials[material].base_color_slot.texture < 0) return false;
  const std::string name = small_letters(scene.material_names[material]);
  return name.find("baked") != std::string::npos || name.find("lightmap") != std::string::npos || has_word_bake(name);
}

// Measures how the triangles that use one texture cover it.
class Coverage {
 public:
  void add(vec2 a, vec2 b, vec2 c) {
    triangles_++;
    const vec2 low = min(a, min(b, c)), high = max(a, max(b, c));
    if (!(low.x > -kSlack && low.y > -kSlack && high.x < 1.0f + kSlack && high.y < 1.0f + kSlack)) {
      outside_++;
      return;
    }
    if (covers_ > kMany) return;
    const auto cell = [](float at) { return std::clamp(static_cast<int>(at * kCells), 0, kCells - 1); };
    const float whole = edge(a, b, c);
    if (whole == 0.0f) return;
    for (int y = cell(low.y); y <= cell(high.y); y++) {
      for (int x = cell(low.x); x <= cell(high.x); x++) {
        const vec2 p((static_cast<float>(x) + 0.5f) / kCells, (static_cast<float>(y) + 0.5f) / kCells);
        const float u = edge(b, c, p) / whole, v = edge(c, a, p) / whole;
        if (u < 0.0f || v < 0.0f || u + v > 1.0f) continue;
        covers_++;
        char& covered = cells_[static_cast<size_t>(y * kCells + x)];
        distinct_ += covered == 0;
        covered = 1;
      }
    }
  }

  bool is_unique() const {
    return triangles_ >= 100 && outside_ * 50 < triangles_ && distinct_ * 5 > kCells * kCells &&
           (covers_ - distinct_) * 10 < covers_;
  }

 private:
  static float edge(vec2 a, vec2 b, vec2 p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

  static constexpr int kCells = 256;
  static constexpr int kMany = 4 * kCells * kCells;  // more than this cannot be unique
  static constexpr float kSlack = 0.01f;
  std::vector<char> cells_ = std::vector<char>(kCells * kCells);
  int triangles_ = 0, outside_ = 0, covers_ = 0, distinct_ = 0;
};

vec2 place_of(const TextureSlot& slot, const Vertex& vertex) {
  const vec2 uv = slot.uv_set == 0 ? vertex.uv0 : vertex.uv1;
  return slot.offset + slot.axis_u * uv.x + slot.axis_v * uv.y;
}

// The fraction of the area whose texels are used only once.
double unique_area(const Scene& scene, const std::vector<double>& areas) {
  std::map<int, std::pair<Coverage, double>> textures;
  for (size_t i = 0; i < areas.size(); i++) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
    const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
    if (areas[i] == 0.0 || !has_only_color(material)) continue;
    const TextureSlot& slot = material.base_color_slot;
    auto& [coverage, area] = textures[slot.texture];
    area += areas[i];
    for (uint t = 0; t < mesh.triangle_count; t++) {
      const uvec3 k = scene.triangles[mesh.first_triangle + t] + uvec3(mesh.first_vertex);
      coverage.add(place_of(slot, scene.vertices[k.x]), place_of(slot, scene.vertices[k.y]),
                   place_of(slot, scene.vertices[k.z]));
    }
  }
  double unique = 0.0;
  for (const auto& [texture, use] : textures) unique += use.first.is_unique() ? use.second : 0.0;
  return unique;
}

}  // namespace

Paint paint_of(const Scene& scene, bool is_place) {
  const std::vector<double> areas = instance_areas(scene);
  double total = 0.0, unlit = 0.0, glowing = 0.0, named = 0.0, plain = 0.0;
  for (size_t i = 0; i < areas.size(); i++) {
    const auto index = static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].material);
    const Material& material = scene.materials[index];
    total += areas[i];
    if (material.unlit != 0) unlit += areas[i];
    if (glows_as_painted(material)) glowing += areas[i];
    if (has_baked_name(scene, index)) named += areas[i];
    if (has_only_color(material)) plain += areas[i];
  }
  if (!(total > 0.0)) return Paint::kLit;
  if (unlit >= 0.5 * total) return Paint::kUnlit;
  if (unlit + glowing >= 0.5 * total) return Paint::kGlowing;
  if (named >= 0.5 * total) return Paint::kNamed;
  const bool unique = is_place && plain >= 0.8 * total && unique_area(scene, areas) >= 0.8 * total;
  return unique ? Paint::kUnique : Paint::kLit;
}

std::string paint_reason(Paint paint) {
  switch (paint) {
    case Paint::kLit:
      break;
    case Paint::kUnlit:
      return "its materials are unlit";
    case Paint::kGlowing:
      return "its surfaces emit their own colours";
    case Paint::kNamed:
      return "its materials are named as baked";
    case Paint::kUnique:
      return "its textures look like a scan or baked light: each texel is used once, and there are no other maps";
  }
  return "";
}

void show_paint(Scene& scene) {
  for (Material& material : scene.materials) {
    if (paints_by_emission(material)) {
      material.base_color = vec4(material.emission, material.base_color.w);
      // The alpha remains in the base colour's own texture.
      if (material.alpha_mode == kAlphaOpaque || material.base_color_slot.texture < 0) {
        material.base_color_slot = material.emission_slot;
      }
    }
    material.emission = vec3(0.0f);
    material.unlit = 1;
  }
}

}  // namespace ods

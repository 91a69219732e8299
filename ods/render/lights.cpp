// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/lights.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "ods/kernel/light.h"
#include "ods/render/tables.h"
#include "ods/scene/placement.h"
#include "ods/scene/sheet_glass.h"

namespace ods {

// Source: Vose, "A Linear Algorithm for Generating Random Numbers with a Given Distribution", 1991.
std::vector<AliasEntry> make_alias_table(const std::vector<double>& weights) {
  const size_t n = weights.size();
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<AliasEntry> table(n);
  std::vector<double> share(n);
  std::vector<size_t> poor, rich;
  for (size_t i = 0; i < n; i++) {
    const double probability = total > 0.0 ? weights[i] / total : 1.0 / static_cast<double>(n);
    table[i] = {static_cast<float>(probability), 1.0f, static_cast<int>(i)};
    share[i] = probability * static_cast<double>(n);
    (share[i] < 1.0 ? poor : rich).push_back(i);
  }
  while (!poor.empty() && !rich.empty()) {
    const size_t low = poor.back(), high = rich.back();
    poor.pop_back();
    table[low].threshold = static_cast<float>(share[low]);
    table[low].alias = static_cast<int>(high);
    share[high] -= 1.0 - share[low];
    if (share[high] < 1.0) {
      rich.pop_back();
      poor.push_back(high);
    }
  }
  return table;
}

// Luminance of each texel times its solid angle. Adjacent texels contribute, because interpolation spreads them.
static std::vector<double> environment_weights(const Environment& environment) {
  const int w = environment.width, h = environment.height;
  const double pi = std::acos(-1.0);
  std::vector<double> weights(environment.texels.size());
  for (int y = 0; y < h; y++) {
    const double angle = 2.0 * pi / w * (std::cos(pi * y / h) - std::cos(pi * (y + 1) / h));
    for (int x = 0; x < w; x++) {
      double sum = 0.0;
      for (int dy = -1; dy <= 1; dy++) {
        for (int dx = -1; dx <= 1; dx++) {
          const int column = (x + dx + w) % w, row = std::clamp(y + dy, 0, h - 1);
          const double share = (dx == 0 ? 0.75 : 0.125) * (dy == 0 ? 0.75 : 0.125);
          const vec3 texel =
              environment.texels[static_cast<size_t>(row) * static_cast<size_t>(w) + static_cast<size_t>(column)];
          sum += share * luminance(texel * environment.radiance);
        }
      }
      weights[static_cast<size_t>(y) * static_cast<size_t>(w) + static_cast<size_t>(x)] = sum * angle;
    }
  }
  return weights;
}

static Light blank_light(int kind) {
  Light light{};
  light.kind = kind;
  light.instance = -1;
  light.triangle = -1;
  light.direction = vec3(0.0f, 0.0f, -1.0f);
  return light;
}

static Light make_punctual(const PunctualLight& source) {
  Light light = blank_light(source.kind);
  light.position = source.position;
  light.direction = source.direction;
  light.intensity = source.intensity;
  light.range = source.range;
  // KHR_lights_punctual's reference attenuation between the cones.
  const float inner = std::cos(source.inner_cone), outer = std::cos(source.outer_cone);
  light.cone_scale = 1.0f / std::max(0.001f, inner - outer);
  light.cone_offset = -outer * light.cone_scale;
  light.cone = source.cone;
  light.size = source.size;
  return light;
}

namespace {

// An entry of the alias table: a light, or the tree.
struct WeighedLight {
  int light;
  double power;
};

}  // namespace

static double punctual_power(const PunctualLight& source, double scene_radius) {
  const double pi = std::acos(-1.0);
  const double strength = luminance(source.intensity);
  if (source.kind == kLightDirectional) return strength * pi * scene_radius * scene_radius;
  if (source.kind == kLightSpot) return strength * 2.0 * pi * (1.0 - std::cos(source.outer_cone));
  return strength * 4.0 * pi;
}

// The triangle as a light of the tree; without power if it emits nothing.
static TreeLight triangle_in_tree(LightSampler& reader, const Scene& scene, bool closed, int instance_index,
                                  int triangle) {
  constexpr double kInside = 0.01;  // fraction of the light; the viewer may be inside a closed mesh
  TreeLight result;
  Hit hit{0.0f, 0.0f, 0.0f, instance_index, triangle};
  const Instance& instance = scene.instances[static_cast<size_t>(instance_index)];
  const Material& material =
      scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material)];
  const auto place = reader.triangle_of(instance, reader.corners_of(hit));
  const vec3 area = 0.5f * cross(place.ab, place.ac);
  const float size = length(area);
  if (!(size > 0.0f) || !std::isfinite(size)) return result;
  double brightness = 0.0;
  for (int i = 0; i < 16; i++) {
    const float root = std::sqrt((static_cast<float>(i / 4) + 0.5f) / 4.0f);
    const float across = (static_cast<float>(i % 4) + 0.5f) / 4.0f;
    hit.u = root * (1.0f - across);
    hit.v = root * across;
    brightness += luminance(reader.emission_at(material, reader.corners_of(hit), true)) / 16.0;
  }
  const vec3 corners[] = {place.a + place.ab, place.a + place.ac};
  result.bounds = {place.a, place.a};
  for (const vec3 corner : corners) {
    result.bounds = {min(result.bounds.low, corner), max(result.bounds.high, corner)};
  }
  result.axis = area * (handedness_of(instance) / size);
  result.power = brightness * static_cast<double>(size) * std::acos(-1.0);
  if (material.double_sided == 1) result.back_power = result.power * (closed ? kInside : 1.0);
  return result;
}

static void add_triangle_lights(const Scene& scene, LightTable& table, std::vector<TreeLight>& tree) {
  // Reads textures through the kernel, so that both interpret them in the same way.
  LightSampler reader;
  set_scene(reader, scene, table);
  reader.ray_time = 0.5f;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
    const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
    if (!is_emissive(material) || is_hidden(scene, i)) continue;
    table.instances[i].first_light = static_cast<int>(table.lights.size());
    const bool closed = table.closed[static_cast<size_t>(scene.instances[i].mesh)] != 0;
    for (uint t = 0; t < mesh.triangle_count; t++) {
      TreeLight in_tree = triangle_in_tree(reader, scene, closed, static_cast<int>(i), static_cast<int>(t));
      in_tree.light = static_cast<int>(table.lights.size());
      if (in_tree.power > 0.0) tree.push_back(in_tree);
      Light light = blank_light(kLightTriangle);
      light.instance = static_cast<int>(i);
      light.triangle = static_cast<int>(t);
      table.lights.push_back(light);
    }
  }
}

static EnvironmentInfo describe(const Environment& source, size_t first_texel) {
  assert(source.width == 0 ||
         source.texels.size() == static_cast<size_t>(source.width) * static_cast<size_t>(source.height));
  return {source.radiance, source.width, source.height, static_cast<int>(first_texel), -1};
}

static void read_environment(const Scene& scene, LightTable& table) {
  const Environment& source = scene.environment;
  table.environment = describe(source, 0);
  if (source.width == 0) return;
  const std::vector<double> weights = environment_weights(source);
  std::vector<double> row_weights;
  for (auto row = weights.begin(); row != weights.end(); row += source.width) {
    row_weights.push_back(std::accumulate(row, row + source.width, 0.0));
    for (const AliasEntry& entry : make_alias_table({row, row + source.width})) {
      table.environment_texels.push_back({source.texels[table.environment_texels.size()] * source.radiance, entry});
    }
  }
  table.environment_rows = make_alias_table(row_weights);
  table.environment_power = std::accumulate(row_weights.begin(), row_weights.end(), 0.0);
}

static void read_background(const Scene& scene, LightTable& table) {
  if (!scene.background) return;
  table.background = describe(*scene.background, table.environment_texels.size());
  for (const vec3& texel : scene.background->texels) {
    table.environment_texels.push_back({texel * scene.background->radiance, {}});
  }
}

// Adds points and spots to the tree, and suns to the alias table.
static void add_punctual_lights(const Scene& scene, double scene_radius, LightTable& table,
                                std::vector<TreeLight>& tree, std::vector<WeighedLight>& picks) {
  for (const PunctualLight& source : scene.lights) {
    const double power = punctual_power(source, scene_radius);
    if (!(power > 0.0)) continue;
    const int index = static_cast<int>(table.lights.size());
    table.lights.push_back(make_punctual(source));
    if (source.kind == kLightDirectional) {
      picks.push_back({index, power});
      continue;
    }
    const bool spot = source.kind == kLightSpot;
    tree.push_back({index,
                    {source.position - source.size, source.position + source.size},
                    spot ? source.direction : vec3(0.0f, 0.0f, 1.0f),
                    spot ? static_cast<double>(source.outer_cone) : std::acos(-1.0),
                    power,
                    0.0});
  }
}

static void add_environment_light(double scene_radius, LightTable& table, std::vector<WeighedLight>& picks) {
  table.environment.light = -1;
  // The weights are radiance times solid angle; the scene's cross-section receives all of it.
  double power = table.environment_power * std::acos(-1.0) * scene_radius * scene_radius;
  if (!(power > 0.0)) return;
  double others = 0.0;
  for (const WeighedLight& pick : picks) others += pick.power;
  if (others > 0.0) power = std::min(power, others);
  table.environment.light = static_cast<int>(table.lights.size());
  picks.push_back({table.environment.light, power});
  table.lights.push_back(blank_light(kLightEnvironment));
}

void set_scene(SceneView& view, const Scene& scene, const LightTable& lights) {
  view.vertices = scene.vertices.data();
  view.triangles = scene.triangles.data();
  view.meshes = scene.meshes.data();
  view.instances = lights.instances.data();
  view.motion_poses = scene.motion_poses.data();
  view.motion_vertices = scene.motion_vertices.data();
  view.motion_keys = scene.motion_keys;
  view.materials = scene.materials.data();
  view.material_layers = scene.material_layers.data();
  view.textures = scene.textures.data();
  view.texels = scene.texels.data();
  const bool reduced = !scene.reduced_textures.empty();
  view.reduced_textures = reduced ? scene.reduced_textures.data() : view.textures;
  view.reduced_texels = reduced ? scene.reduced_texels.data() : view.texels;
  view.lights = lights.lights.data();
  view.light_picks = lights.picks.data();
  view.light_nodes = lights.tree.nodes.data();
  view.light_ways = lights.tree.ways.data();
  view.light_pick_count = static_cast<int>(lights.picks.size());
  view.environment = lights.environment;
  view.background = scene.background ? lights.background : lights.environment;
  view.environment_texels = lights.environment_texels.data();
  view.environment_rows = lights.environment_rows.data();
  const auto refracts = [](const Material& m) { return m.transmission > 0.0f && m.thickness > 0.0f; };
  TableNeeds needs;
  needs.glass = std::any_of(scene.materials.begin(), scene.materials.end(), refracts);
  for (const MaterialLayers& layers : scene.material_layers) {
    needs.sheen |= layers.sheen_color != vec3(0.0f);
    needs.anisotropy |= layers.anisotropy > 0.0f;
  }
  view.tables = kernel_tables(needs).data();
}

static void fill_picks(const std::vector<WeighedLight>& wanted, const std::vector<TreeLight>& tree, LightTable& table) {
  std::vector<double> weights;
  for (const WeighedLight& each : wanted) weights.push_back(each.power);
  const std::vector<AliasEntry> entries = make_alias_table(weights);
  for (size_t i = 0; i < entries.size(); i++) {
    const float probability = entries[i].probability;
    table.picks.push_back({wanted[i].light, entries[i].threshold, wanted[static_cast<size_t>(entries[i].alias)].light});
    if (wanted[i].light != kTreeOfLights) {
      table.lights[static_cast<size_t>(wanted[i].light)].probability = probability;
    } else {
      for (const TreeLight& light : tree) table.lights[static_cast<size_t>(light.light)].probability = probability;
    }
  }
}

LightTable without_lights(const Scene& scene) {
  LightTable table;
  table.instances = scene.instances;
  return table;
}

void update_lights(const Scene& scene, LightTable& table) {
  table.instances = scene.instances;
  table.lights.clear();
  table.picks.clear();
  std::vector<TreeLight> tree;
  std::vector<WeighedLight> picks;
  const Bounds bounds = scene_bounds(scene);
  const double radius = std::max(0.5 * static_cast<double>(length(bounds.high - bounds.low)), 1e-3);
  add_triangle_lights(scene, table, tree);
  add_punctual_lights(scene, radius, table, tree, picks);
  double power = 0.0;
  for (const TreeLight& light : tree) power += light.power + light.back_power;
  if (power > 0.0) picks.push_back({kTreeOfLights, power});
  add_environment_light(radius, table, picks);
  fill_picks(picks, tree, table);
  table.tree = make_light_tree(std::move(tree), table.lights.size());
}

static void find_closed_emitters(const Scene& scene, LightTable& table) {
  for (const Mesh& mesh : scene.meshes) {
    const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
    table.closed.push_back(is_emissive(material) && material.double_sided == 1 && is_closed(scene, mesh));
  }
}

LightTable make_lights(const Scene& scene) {
  LightTable table;
  find_closed_emitters(scene, table);
  read_environment(scene, table);
  read_background(scene, table);
  update_lights(scene, table);
  return table;
}

}  // namespace ods

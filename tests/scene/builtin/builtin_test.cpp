// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/builtin/builtin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "ods/scene/load/load.h"
#include "tests/support/shape_checks.h"

namespace ods {
namespace {

struct MeshView {
  std::span<const Vertex> vertices;
  std::span<const uvec3> triangles;
};

MeshView mesh_view(const Scene& scene, const Mesh& mesh) {
  return {std::span(scene.vertices).subspan(mesh.first_vertex, mesh.vertex_count),
          std::span(scene.triangles).subspan(mesh.first_triangle, mesh.triangle_count)};
}

const Material& material_of(const Scene& scene, const Mesh& mesh) {
  return scene.materials[static_cast<size_t>(mesh.material)];
}

const Mesh& mesh_of(const Scene& scene, const Instance& instance) {
  return scene.meshes[static_cast<size_t>(instance.mesh)];
}

vec3 in_world(const Instance& instance, vec3 position) {
  const vec4 p(position, 1.0f);
  return {dot(instance.row0, p), dot(instance.row1, p), dot(instance.row2, p)};
}

float distance_to_triangle(vec3 p, vec3 a, vec3 b, vec3 c) {
  const vec3 normal = cross(b - a, c - a);
  const auto beside = [&](vec3 from, vec3 to) { return dot(cross(normal, to - from), p - from) >= 0.0f; };
  if (beside(a, b) && beside(b, c) && beside(c, a)) return std::abs(dot(p - a, normal)) / length(normal);
  const auto to_edge = [&](vec3 from, vec3 to) {
    const float t = clamp(dot(p - from, to - from) / dot(to - from, to - from), 0.0f, 1.0f);
    return length(p - mix(from, to, t));
  };
  return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

// Each scene is made once for all tests of this program.
const Scene& scene_named(const char* name) {
  static std::map<std::string, Scene> made;
  const auto found = made.find(name);
  return found != made.end() ? found->second : made.emplace(name, load_scene(name)).first->second;
}

class EveryBuiltin : public testing::TestWithParam<std::string> {
 protected:
  const Scene& scene = scene_named(GetParam().c_str());
};

TEST_P(EveryBuiltin, MeshesAreSound) {
  ASSERT_FALSE(scene.meshes.empty());
  for (const Mesh& mesh : scene.meshes) {
    SCOPED_TRACE(&mesh - scene.meshes.data());
    ASSERT_LT(static_cast<size_t>(mesh.material), scene.materials.size());
    const MeshView view = mesh_view(scene, mesh);
    expect_sound(view.vertices, view.triangles);
  }
}

TEST_P(EveryBuiltin, RecordsPointToWhatExists) {
  EXPECT_EQ(scene.name, GetParam());
  ASSERT_EQ(scene.view_points.size(), 1u);
  ASSERT_FALSE(scene.instances.empty());
  for (const Instance& instance : scene.instances) {
    ASSERT_LT(static_cast<size_t>(instance.mesh), scene.meshes.size());
    ASSERT_TRUE(std::isfinite(dot(instance.row0 + instance.row1 + instance.row2, vec4(1.0f))));
  }
  for (const Material& material : scene.materials) {
    ASSERT_LT(material.base_color_slot.texture, static_cast<int>(scene.textures.size()));
  }
  size_t texels = 0;
  for (const Texture& texture : scene.textures) {
    EXPECT_EQ(texture.first_texel, texels);
    texels += static_cast<size_t>(texture.width) * static_cast<size_t>(texture.height);
  }
  EXPECT_EQ(texels, scene.texels.size());
  const Environment& sky = scene.environment;
  EXPECT_EQ(sky.texels.size(), static_cast<size_t>(sky.width) * static_cast<size_t>(sky.height));
  for (const vec3& texel : sky.texels) {
    ASSERT_TRUE(std::isfinite(texel.x + texel.y + texel.z) && min(texel.x, min(texel.y, texel.z)) >= 0.0f);
  }
}

TEST_P(EveryBuiltin, VolumesAreClosed) {
  for (const Mesh& mesh : scene.meshes) {
    const Material& material = material_of(scene, mesh);
    if (material.transmission == 0.0f || material.thickness == 0.0f) continue;
    const MeshView view = mesh_view(scene, mesh);
    EXPECT_EQ(open_edges(view.vertices, view.triangles), 0) << "mesh " << &mesh - scene.meshes.data();
    EXPECT_GT(enclosed_volume(view.vertices, view.triangles), 0.0);
  }
}

TEST_P(EveryBuiltin, NothingIsCloserThanHalfAMetre) {
  const vec3 eye = scene.view_points.front().position;
  float nearest = INFINITY;
  for (const Instance& instance : scene.instances) {
    const MeshView view = mesh_view(scene, mesh_of(scene, instance));
    for (const uvec3& t : view.triangles) {
      const auto corner = [&](uint i) { return in_world(instance, view.vertices[i].position); };
      nearest = std::min(nearest, distance_to_triangle(eye, corner(t.x), corner(t.y), corner(t.z)));
    }
  }
  EXPECT_GT(nearest, 0.5f);
}

TEST_P(EveryBuiltin, IsTheSameEveryTime) {
  const Scene again = load_scene(GetParam());
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
  };
  EXPECT_TRUE(same(scene.vertices, again.vertices));
  EXPECT_TRUE(same(scene.triangles, again.triangles));
  EXPECT_TRUE(same(scene.instances, again.instances));
  EXPECT_TRUE(same(scene.materials, again.materials));
  EXPECT_TRUE(same(scene.texels, again.texels));
  EXPECT_TRUE(same(scene.environment.texels, again.environment.texels));
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const BuiltinScene& scene : builtin_scenes()) all.push_back(scene.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryBuiltin, testing::ValuesIn(names()), [](const auto& test) { return test.param; });

TEST(Builtin, NamesAreUniqueAndKnown) {
  const std::vector<std::string> all = names();
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
  for (const std::string& name : all) EXPECT_EQ(find_builtin(name)->name, name);
  EXPECT_EQ(find_builtin(""), nullptr);
  EXPECT_EQ(find_builtin("scene.glb"), nullptr);
}

TEST(Builtin, FractalHasMillionsOfInstancedTriangles) {
  const Scene& scene = scene_named("fractal");
  size_t instanced = 0;
  for (const Instance& instance : scene.instances) instanced += mesh_of(scene, instance).triangle_count;
  EXPECT_GT(instanced, 1000000u);
  EXPECT_LT(scene.triangles.size(), 100000u);
}

TEST(Builtin, RoomHasFewGlowingTriangles) {
  const Scene& scene = scene_named("room");
  uint glowing = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = mesh_of(scene, instance);
    if (material_of(scene, mesh).emission != vec3(0.0f)) glowing += mesh.triangle_count;
  }
  EXPECT_GT(glowing, 0u);
  EXPECT_LE(glowing, 700u);
}

TEST(Builtin, MarkersStandApart) {
  const std::vector<vec3> markers = marker_positions();
  EXPECT_GE(markers.size(), 50u);
  for (size_t i = 0; i < markers.size(); i++) {
    for (size_t k = i + 1; k < markers.size(); k++) {
      EXPECT_LT(dot(normalize(markers[i]), normalize(markers[k])), std::cos(0.1f)) << i << " and " << k;
    }
  }
}

TEST(Builtin, KnownAnswers) {
  EXPECT_FLOAT_EQ(furnace_radiance(0), 0.25f);
  EXPECT_FLOAT_EQ(furnace_radiance(3), 0.46875f);
  // On the axis the disc's irradiance is pi L a2 / (a2 + h2).
  EXPECT_NEAR(lamp_floor_radiance(0.0f, 0.0f), 0.5f * 8.0f * 0.09f / (0.09f + 1.44f), 1e-6f);
  // Far away the disc is a point of intensity L * area: E = pi L a2 h2 / (d2 + h2)2.
  const float far_away = 0.5f * 8.0f * 0.09f * 1.44f / std::pow(81.0f + 1.44f, 2.0f);
  EXPECT_NEAR(lamp_floor_radiance(9.0f, 0.0f) / far_away, 1.0f, 0.01f);
  // Straight through: F = 0.04.
  EXPECT_NEAR(slab_transmittance(vec3(0, 0, -1)).r, 0.96f * 0.96f * 0.9f / (1.0f - 0.0016f * 0.81f), 1e-5f);
}

}  // namespace
}  // namespace ods

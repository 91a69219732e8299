// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/load/join.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/render/cpu/render.h"
#include "ods/scene/load/load.h"
#include "ods/scene/motion.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/pictures.h"

namespace ods::join_test {

// A floor under a lamp, and what is put on it, at a place.
void add_floor(Scene& scene) {
  add_rectangle(scene, vec3(-2, 0, 2), vec3(4, 0, 0), vec3(0, 0, -4), add_material(scene, matte(vec3(0.6f))));
  add_sphere(scene, vec3(0, 3, 0), 0.3f, add_material(scene, glow(vec3(20.0f))), 8);
  scene.environment.radiance = vec3(0.2f);
}

void add_thing(Scene& scene, const glm::mat4& place) {
  const Material red = matte(vec3(0.8f, 0.1f, 0.1f));
  add(scene, make_sphere(0.4f, 16), add_material(scene, red), place);
}

StereoCamera viewer() {
  StereoCamera camera;
  camera.position = vec3(0, 1.2f, 2.5f);
  return camera;
}

TEST(Join, RendersTheSameBitsAsOneScene) {
  const vec3 at(0.5f, 0.4f, -0.25f);
  Scene one;
  add_floor(one);
  add_thing(one, glm::mat4(place_of_object(at, 30.0f)));
  Scene joined, object;
  add_floor(joined);
  add_thing(object, glm::mat4(1.0f));
  object.environment.radiance = vec3(9.0f);  // is not taken
  object.view_points.push_back({"own", vec3(7.0f)});
  join(joined, object, place_of_object(at, 30.0f));
  EXPECT_TRUE(joined.view_points.empty());
  const RenderOptions options = small_render(64, 8);
  EXPECT_EQ(digest(render_cpu(joined, viewer(), options)), digest(render_cpu(one, viewer(), options)));
  join(joined, object, place_of_object(vec3(-1, 0.4f, 0), 0.0f));
  EXPECT_NE(digest(render_cpu(joined, viewer(), options)), digest(render_cpu(one, viewer(), options)));
}

// Counter-clockwise as seen from above: what was ahead is at the left.
TEST(Join, TurnsToTheLeft) {
  const glm::dmat4 place = place_of_object(vec3(1, 2, 3), 90.0f);
  const glm::dvec3 ahead(place * glm::dvec4(0, 0, -1, 1));
  EXPECT_NEAR(ahead.x, 0.0, 1e-9);
  EXPECT_NEAR(ahead.y, 2.0, 1e-9);
  EXPECT_NEAR(ahead.z, 3.0, 1e-9);
}

// Textures, layers, names and lights of the object keep their meaning.
TEST(Join, MovesAllIndices) {
  Scene scene = load_scene("room");
  const Scene object = load_scene("toys");
  const Scene before = scene;
  join(scene, object, place_of_object(vec3(1, 0, 0), 0.0f));
  ASSERT_EQ(scene.meshes.size(), before.meshes.size() + object.meshes.size());
  for (size_t i = 0; i < object.meshes.size(); i++) {
    const Mesh &mesh = scene.meshes[before.meshes.size() + i], &own = object.meshes[i];
    EXPECT_EQ(scene.vertices[mesh.first_vertex].uv0, object.vertices[own.first_vertex].uv0);
    EXPECT_EQ(scene.triangles[mesh.first_triangle], object.triangles[own.first_triangle]);
    const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
    const Material& original = object.materials[static_cast<size_t>(own.material)];
    EXPECT_EQ(material.base_color, original.base_color);
    if (original.base_color_slot.texture < 0) continue;
    const Texture& texture = scene.textures[static_cast<size_t>(material.base_color_slot.texture)];
    const Texture& its = object.textures[static_cast<size_t>(original.base_color_slot.texture)];
    EXPECT_EQ(texture.width, its.width);
    EXPECT_EQ(scene.texels[texture.first_texel], object.texels[its.first_texel]);
  }
  ASSERT_EQ(scene.reduced_textures.size(), scene.textures.size());
  for (size_t i = 0; i < object.textures.size(); i++) {
    const Texture& texture = scene.reduced_textures[before.textures.size() + i];
    EXPECT_EQ(texture.width, object.reduced_textures[i].width);
    EXPECT_EQ(scene.reduced_texels[texture.first_texel], object.reduced_texels[object.reduced_textures[i].first_texel]);
  }
  EXPECT_EQ(scene.lights.size(), before.lights.size() + object.lights.size());
  EXPECT_EQ(scene.instances.size(), before.instances.size() + object.instances.size());
  EXPECT_EQ(scene.objects.size(), before.objects.size() + object.objects.size());
  if (!object.objects.empty()) {
    EXPECT_EQ(scene.objects.back().first_instance, before.instances.size() + object.objects.back().first_instance);
  }
}

// A triangle that moves by 1 m to the right in a second.
GltfBuilder mover() {
  GltfBuilder file = make_triangle();
  const int times = file.add<float>({0.0f, 1.0f}, kFloat, "SCALAR");
  const int places = file.add<float>({0, 0, 0, 1, 0, 0}, kFloat, "VEC3");
  file.json["animations"] = {{{"name", "slide"},
                              {"samplers", {{{"input", times}, {"output", places}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  return file;
}

TEST(Join, PlaysBothAnimations) {
  Scene scene = mover().load();
  join(scene, mover().load(), place_of_object(vec3(0, 5, 0), 90.0f));
  ASSERT_EQ(scene.instances.size(), 2u);
  ASSERT_TRUE(play(scene.animation, ""));
  EXPECT_EQ(scene.animation.playing.size(), 2u);
  set_time(scene, 1.0);
  EXPECT_NEAR(scene.instances[0].row0.w, 1.0f, 1e-5f);
  EXPECT_NEAR(scene.instances[1].row0.w, 0.0f, 1e-5f);
  EXPECT_NEAR(scene.instances[1].row1.w, 5.0f, 1e-5f);
  EXPECT_NEAR(scene.instances[1].row2.w, -1.0f, 1e-5f);  // +X turned to the left is -Z
}

// One joint, which moves the whole triangle: it is placed once, not twice.
TEST(Join, PlacesSkinsByTheirJoints) {
  GltfBuilder file = mover();
  const int joints = file.add<uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, kUbyte, "VEC4");
  const int weights = file.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, kFloat, "VEC4");
  file.primitive()["attributes"]["JOINTS_0"] = joints;
  file.primitive()["attributes"]["WEIGHTS_0"] = weights;
  file.json["nodes"].push_back({{"name", "joint"}});
  file.json["scenes"][0]["nodes"].push_back(1);
  file.json["skins"] = {{{"joints", {1}}}};
  file.node(0)["skin"] = 0;
  file.json["animations"][0]["channels"][0]["target"]["node"] = 1;
  Scene scene;
  add_floor(scene);
  const size_t first = scene.vertices.size();
  join(scene, file.load(), place_of_object(vec3(0, 5, 0), 0.0f));
  const auto world = [&](size_t vertex) {
    const Instance& instance = scene.instances.back();
    const vec4 p(scene.vertices[first + vertex].position, 1.0f);
    return vec3(dot(instance.row0, p), dot(instance.row1, p), dot(instance.row2, p));
  };
  EXPECT_LT(length(world(0) - vec3(0, 5, 0)), 1e-5f);
  ASSERT_TRUE(play(scene.animation, ""));
  set_time(scene, 1.0);
  EXPECT_LT(length(world(0) - vec3(1, 5, 0)), 1e-5f);
}

}  // namespace ods::join_test

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/sheet_glass.h"

#include <gtest/gtest.h>

#include "ods/scene/builtin/shapes.h"
#include "ods/scene/motion.h"
#include "tests/support/moving_files.h"

namespace ods::sheet_glass_test {

Material sheet_glass() {
  Material material = default_material();
  material.transmission = 1.0f;
  return material;
}

// One mesh of glass.
Scene scene_of(const Shape& shape) {
  Scene scene;
  scene.materials.push_back(sheet_glass());
  add_mesh(scene, shape.vertices, shape.triangles, 0);
  add_instance(scene, 0, glm::mat4(1.0f));
  return scene;
}

bool closed(const Shape& shape) {
  const Scene scene = scene_of(shape);
  return is_closed(scene, scene.meshes[0]);
}

Shape without_last_triangle(Shape shape) {
  shape.triangles.pop_back();
  return shape;
}

Shape joined(const Shape& a, const Shape& b) {
  Shape both = a;
  const auto first = static_cast<uint>(a.vertices.size());
  both.vertices.insert(both.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const uvec3& t : b.triangles) both.triangles.push_back(t + first);
  return both;
}

glm::mat4 moved(vec3 offset) {
  glm::mat4 matrix(1.0f);
  matrix[3] = vec4(offset, 1.0f);
  return matrix;
}

TEST(SheetGlass, ClosedMeans) {
  const Shape sphere = make_sphere(0.5f, 24), box = make_box(vec3(1.0f, 2.0f, 0.001f));
  for (const Shape& shape : {sphere, box, make_torus(1.0f, 0.2f, 16, 8), make_cylinder(1.0f, 2.0f, 12)}) {
    EXPECT_TRUE(closed(shape)) << "sharp edges and seams have several vertices at one place";
    EXPECT_FALSE(closed(without_last_triangle(shape)));
    EXPECT_FALSE(closed(inside_out(shape)));
  }
  EXPECT_FALSE(closed(make_quad(vec3(0), vec3(1, 0, 0), vec3(0, 1, 0))));
  EXPECT_FALSE(closed(make_disc(1.0f, 12)));
  Shape turned = sphere;
  std::swap(turned.triangles[5].x, turned.triangles[5].y);
  EXPECT_FALSE(closed(turned)) << "one triangle faces the other way";
}

// A pane of two sides without a rim between them: every edge is there in both directions, and nothing inside.
TEST(SheetGlass, TwoSidesOfASheetAreNotClosed) {
  const Shape pane = make_quad(vec3(0), vec3(1, 0, 0), vec3(0, 1, 0));
  EXPECT_FALSE(closed(joined(pane, inside_out(pane))));
}

TEST(SheetGlass, SeveralBodiesMayTouch) {
  const Shape box = make_box(vec3(1.0f));
  EXPECT_TRUE(closed(joined(box, transformed(box, moved(vec3(1, 1, 0))))))
      << "along an edge, which four triangles have";
  EXPECT_TRUE(closed(joined(box, transformed(inside_out(make_box(vec3(0.5f))), moved(vec3(0.0f)))))) << "hollow";
}

TEST(SheetGlass, IsFoundWhereItIsSeen) {
  Scene scene = scene_of(make_sphere(0.5f, 12));
  const Shape pane = make_quad(vec3(0), vec3(1, 0, 0), vec3(0, 1, 0));
  add_mesh(scene, pane.vertices, pane.triangles, 0);
  EXPECT_EQ(find_sheet_glass(scene).at(0).open_meshes, 0u) << "no instance";
  add_instance(scene, 1, glm::mat4(1.0f));
  add_instance(scene, 1, moved(vec3(3, 0, 0)));
  std::vector<SheetGlass> glass = find_sheet_glass(scene);
  ASSERT_EQ(glass.size(), 1u);
  EXPECT_EQ(glass[0].name, "material 0");
  EXPECT_EQ(glass[0].closed_meshes, 1u);
  EXPECT_EQ(glass[0].open_meshes, 1u);
  scene.material_names = {"Bottle"};
  EXPECT_EQ(find_sheet_glass(scene).at(0).name, "Bottle");
  scene.hidden = {0, 1, 1};
  EXPECT_EQ(find_sheet_glass(scene).at(0).open_meshes, 0u);
  for (const float thickness : {0.1f, 0.0f}) {
    scene.materials[0].thickness = thickness;
    scene.materials[0].transmission = thickness > 0.0f ? 1.0f : 0.0f;
    EXPECT_TRUE(find_sheet_glass(scene).empty());
  }
}

TEST(SheetGlass, ClosedMeshesBecomeSolidAndOpenOnesStay) {
  Scene scene = scene_of(make_sphere(0.5f, 12));
  scene.material_names = {"Bottle"};
  const Shape pane = make_quad(vec3(0), vec3(1, 0, 0), vec3(0, 1, 0));
  add_mesh(scene, pane.vertices, pane.triangles, 0);
  add_instance(scene, 1, glm::mat4(1.0f));
  EXPECT_EQ(make_glass_solid(scene), 1u);
  const Material& solid = scene.materials.at(size_t(scene.meshes[0].material));
  EXPECT_NEAR(solid.thickness, 1.0f, 0.05f);
  EXPECT_EQ(solid.transmission, 1.0f);
  EXPECT_EQ(scene.material_names.at(size_t(scene.meshes[0].material)), "Bottle");
  EXPECT_EQ(scene.meshes[1].material, 0);
  EXPECT_EQ(scene.materials[0].thickness, 0.0f);
  EXPECT_EQ(find_sheet_glass(scene).at(0).closed_meshes, 0u);
  EXPECT_EQ(make_glass_solid(scene), 0u) << "once is enough";
}

// A pane and a body of one animated material: both go on changing.
TEST(SheetGlass, AnimatedMaterialsGoOn) {
  GltfBuilder file = make_triangle();
  file.json["extensionsUsed"] = {"KHR_animation_pointer", "KHR_materials_transmission"};
  const Shape box = make_box(vec3(1.0f));
  std::vector<float> positions;
  std::vector<uint32_t> corners;
  for (const Vertex& v : box.vertices) positions.insert(positions.end(), {v.position.x, v.position.y, v.position.z});
  for (const uvec3& t : box.triangles) corners.insert(corners.end(), {t.x, t.y, t.z});
  GltfJson body = {{"attributes", {{"POSITION", file.add<float>(positions, kFloat, "VEC3")}}}, {"material", 1}};
  body["indices"] = file.add<uint32_t>(corners, kUint, "SCALAR");
  file.primitive()["material"] = 1;
  file.json["meshes"][0]["primitives"].push_back(body);
  const GltfJson glass = {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}};
  file.json["materials"] = {GltfJson::object(), {{"extensions", glass}}};
  animate(file, pointer("/materials/0/pbrMetallicRoughness/roughnessFactor"), {0, 1}, {1, 0.25f}, "SCALAR");
  animate(file, pointer("/materials/1/pbrMetallicRoughness/roughnessFactor"), {0, 1}, {0, 0.5f}, "SCALAR");
  Scene scene = file.load();
  EXPECT_EQ(make_glass_solid(scene), 1u);
  ASSERT_TRUE(play(scene.animation, ""));
  set_time(scene, 1.0);
  EXPECT_EQ(scene.materials[0].roughness, 0.25f);
  for (const Mesh& mesh : scene.meshes) EXPECT_EQ(scene.materials[size_t(mesh.material)].roughness, 0.5f);
  EXPECT_NE(scene.meshes[0].material, scene.meshes[1].material);
}

TEST(SheetGlass, SheetMeans) {
  const auto sheet = [](const Shape& shape) {
    const Scene scene = scene_of(shape);
    return is_sheet(scene, scene.meshes[0]);
  };
  const Shape pane = make_quad(vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)), sphere = make_sphere(0.5f, 24);
  const Shape opposite = transformed(inside_out(pane), moved(vec3(0, 0, -4)));
  EXPECT_TRUE(sheet(pane));
  EXPECT_TRUE(sheet(make_disc(1.0f, 12)));
  EXPECT_TRUE(sheet(joined(pane, opposite))) << "windows in opposite walls";
  EXPECT_TRUE(sheet(joined(pane, inside_out(pane)))) << "two sides in one place";
  Shape dome = sphere;
  std::erase_if(dome.triangles, [&](const uvec3& t) { return sphere.vertices[t.x].position.y < 0.0f; });
  EXPECT_TRUE(sheet(dome));
  EXPECT_FALSE(sheet(sphere));
  EXPECT_FALSE(sheet(without_last_triangle(sphere))) << "a bottle with a hole";
  EXPECT_FALSE(sheet(make_box(vec3(1.0f, 1.0f, 0.004f)))) << "a thick pane";
}

// A window pane as real-time programs write it: one sheet with the thickness of the glass.
TEST(SheetGlass, ASheetWithAVolumeIsThinAndTinted) {
  Scene scene = scene_of(make_quad(vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)));
  const Shape ball = make_sphere(0.5f, 12);
  add_mesh(scene, ball.vertices, ball.triangles, 0);
  add_instance(scene, 1, glm::mat4(1.0f));
  Material& glass = scene.materials[0];
  glass.thickness = 0.02f, glass.attenuation_distance = 0.01f, glass.attenuation_color = vec3(0.5f, 0.8f, 1.0f);
  EXPECT_EQ(make_sheets_thin(scene), 1u);
  const Material& thin = scene.materials.at(size_t(scene.meshes[0].material));
  EXPECT_EQ(thin.thickness, 0.0f);
  EXPECT_NEAR(thin.base_color.x, 0.25f, 1e-5f);
  EXPECT_NEAR(thin.base_color.y, 0.64f, 1e-5f);
  EXPECT_NEAR(thin.base_color.z, 1.0f, 1e-5f);
  EXPECT_EQ(scene.meshes[1].material, 0) << "the ball encloses a volume";
  EXPECT_EQ(scene.materials[0].thickness, 0.02f);
  EXPECT_EQ(make_sheets_thin(scene), 0u);
}

}  // namespace ods::sheet_glass_test

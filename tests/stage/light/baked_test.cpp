// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/baked.h"

#include <gtest/gtest.h>

#include "ods/stage/light/areas.h"
#include "tests/support/scenes.h"

namespace ods {
namespace {

// A square of side 2 in n x n quads with a texture of its own, whose coordinates run from 0 to `repeats`.
void add_painted(Scene& scene, float repeats, int n = 12, const std::string& name = "wall") {
  Material material = default_material();
  material.base_color_slot.texture = add_texture(scene, 4, 4, [](vec2 uv) { return vec3(uv, 0.5f); });
  Shape shape = make_surface(n, n, vec2(repeats), [](float s, float t) { return 2.0f * vec3(s, t, 0.0f); });
  add(scene, shape, add_material(scene, material, name));
}

TEST(Baked, PlainScenesAwaitLight) {
  Scene scene;
  EXPECT_EQ(paint_of(scene, true), Paint::kLit) << "empty";
  add_sphere(scene, vec3(0), 1, add_material(scene, default_material()));
  EXPECT_EQ(paint_of(scene, true), Paint::kLit);
}

TEST(Baked, UnlitMaterialsOnHalfOfTheSurface) {
  Scene scene;
  Material unlit = default_material();
  unlit.unlit = 1;
  add_rectangle(scene, vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), add_material(scene, unlit));
  add_rectangle(scene, vec3(0), vec3(0.9f, 0, 0), vec3(0, 1, 0), add_material(scene, default_material()));
  EXPECT_EQ(paint_of(scene, false), Paint::kUnlit);
  add_rectangle(scene, vec3(0), vec3(0.2f, 0, 0), vec3(0, 1, 0), 1);
  EXPECT_EQ(paint_of(scene, false), Paint::kLit);
  scene.hidden = {0, 1, 0};
  EXPECT_EQ(paint_of(scene, false), Paint::kUnlit) << "what is hidden does not count";
}

TEST(Baked, EmissionThatRepeatsTheColorOrReplacesIt) {
  for (const bool black : {false, true}) {
    Scene scene;
    add_painted(scene, 3.0f);
    Material& material = scene.materials[0];
    material.emission = vec3(0.75f);
    material.emission_slot.texture = 0;
    if (black) material.base_color = vec4(0, 0, 0, 1), material.base_color_slot.texture = -1;
    EXPECT_EQ(paint_of(scene, false), Paint::kGlowing);
    show_paint(scene);
    EXPECT_EQ(material.unlit, 1);
    EXPECT_EQ(vec3(material.base_color), vec3(0.75f));
    EXPECT_EQ(material.base_color_slot.texture, 0);
    EXPECT_EQ(material.emission, vec3(0.0f));
  }
  Scene sign;  // another texture than its colour's: indicator lamps
  add_painted(sign, 3.0f);
  sign.materials[0].emission = vec3(1.0f);
  sign.materials[0].emission_slot.texture = add_texture(sign, 4, 4, [](vec2) { return vec3(0.1f); });
  EXPECT_EQ(paint_of(sign, false), Paint::kLit);
  Scene lamp;  // no texture: a lamp
  add_sphere(lamp, vec3(0), 1, add_material(lamp, glow(vec3(1.0f))));
  EXPECT_EQ(paint_of(lamp, false), Paint::kLit);
}

TEST(Baked, NamesSaySo) {
  for (const char* name : {"Room_Baked", "walls_bake", "bake 01", "LightMap_2", "bakedtexture"}) {
    Scene scene;
    add_painted(scene, 3.0f, 12, name);
    EXPECT_EQ(paint_of(scene, false), Paint::kNamed) << name;
  }
  for (const char* name : {"bakery", "Bakelite", "brakes", "unbaker", "light map"}) {
    Scene scene;
    add_painted(scene, 3.0f, 12, name);
    EXPECT_EQ(paint_of(scene, false), Paint::kLit) << name;
  }
}

TEST(Baked, TexturesOfAPlaceOfWhichEachTexelIsUsedOnce) {
  Scene scan;
  add_painted(scan, 1.0f);
  add_painted(scan, 0.97f);
  EXPECT_EQ(paint_of(scan, true), Paint::kUnique);
  EXPECT_EQ(paint_of(scan, false), Paint::kLit) << "an object looks as well in new light";

  Scene tiled;
  add_painted(tiled, 4.0f);
  EXPECT_EQ(paint_of(tiled, true), Paint::kLit) << "a texture that repeats";

  Scene twice;
  add_painted(twice, 1.0f);
  add_instance(twice, 0, placed(vec3(3, 0, 0)));
  EXPECT_EQ(paint_of(twice, true), Paint::kLit) << "two copies share texels";

  Scene poster;
  add_painted(poster, 1.0f, 2);
  EXPECT_EQ(paint_of(poster, true), Paint::kLit) << "a few triangles are no unwrapping";

  Scene palette;
  add_painted(palette, 0.02f);
  EXPECT_EQ(paint_of(palette, true), Paint::kLit) << "a corner of a palette";

  Scene mapped;
  add_painted(mapped, 1.0f);
  mapped.materials[0].normal_slot.texture = 0;
  EXPECT_EQ(paint_of(mapped, true), Paint::kLit) << "other maps are for light";

  Scene partly;
  add_painted(partly, 1.0f);
  add_rectangle(partly, vec3(0), vec3(2, 0, 0), vec3(0, 1, 0), add_material(partly, default_material()));
  EXPECT_EQ(paint_of(partly, true), Paint::kLit) << "a third has no texture";
}

TEST(Baked, PaintKeepsAlphaAndShowsLamps) {
  Scene scene;
  Material leaf = default_material();
  leaf.base_color = vec4(0.2f, 0.5f, 0.1f, 0.5f);
  leaf.alpha_mode = kAlphaBlend;
  add_material(scene, leaf);
  add_material(scene, glow(vec3(0.5f, 0.25f, 0.0f)));
  show_paint(scene);
  EXPECT_EQ(scene.materials[0].base_color, leaf.base_color);
  EXPECT_EQ(scene.materials[0].alpha_mode, kAlphaBlend);
  EXPECT_EQ(vec3(scene.materials[1].base_color), vec3(0.5f, 0.25f, 0.0f));
}

TEST(Areas, AreInTheWorld) {
  Scene scene;
  add_material(scene, default_material());
  add(scene, make_box(vec3(1, 2, 3)), 0);
  add_instance(scene, 0, placed(vec3(5, 0, 0), 30.0f, vec3(2.0f)));
  scene.hidden = {0, 0};
  std::vector<double> areas = instance_areas(scene);
  EXPECT_NEAR(areas[0], 22.0, 1e-5);
  EXPECT_NEAR(areas[1], 88.0, 1e-4);
  scene.hidden = {1, 0};
  EXPECT_EQ(instance_areas(scene)[0], 0.0);
}

}  // namespace
}  // namespace ods

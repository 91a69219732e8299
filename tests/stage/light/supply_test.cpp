// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Which light a scene gets.
#include "ods/stage/light/supply.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scenes.h"
#include "tests/support/stage_scenes.h"

namespace ods {
namespace {

LightPlan plan_for(const Scene& scene, const LightChoices& choices = {}) {
  const SceneRays rays(scene);
  return plan_light(rays, survey(rays), choices);
}

LightPlan supplied(Scene& scene, const LightChoices& choices = {}) {
  LightPlan plan;
  Survey found;
  {
    const SceneRays rays(scene);
    found = survey(rays);
    plan = plan_light(rays, found, choices);
  }
  apply_light(scene, found, plan, choices);
  return plan;
}

bool says(const LightPlan& plan, const std::string& words) {
  return plan.note.find(words) != std::string::npos;
}

PunctualLight lamp_in(vec3 position, int kind = kLightPoint) {
  PunctualLight light;
  light.kind = kind;
  light.position = position;
  light.direction = vec3(0, -1, 0);
  return light;
}

// A row of eight columns of 45 degrees, of which one is bright.
TEST(Supply, TurnsAndMultipliesTheEnvironment) {
  LightChoices choices;
  choices.surround = Surround::kGiven;
  choices.given = {vec3(1.0f), 8, 1, std::vector<vec3>(8, vec3(0.0f))};
  choices.given.texels[1] = vec3(4.0f, 2.0f, 1.0f);
  const auto columns = [&](float degrees, float strength) {
    Scene scene = make_ball(0.3f);
    scene.background = choices.given;
    choices.turn = degrees, choices.strength = strength;
    supplied(scene, choices);
    EXPECT_EQ(scene.background->texels, scene.environment.texels);
    EXPECT_EQ(scene.environment.radiance, vec3(strength));
    std::vector<float> reds;
    for (const vec3& texel : scene.environment.texels) reds.push_back(texel.x);
    return reds;
  };
  using Reds = std::vector<float>;
  EXPECT_EQ(columns(0.0f, 1.0f), Reds({0, 4, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(columns(90.0f, 2.0f), Reds({0, 0, 0, 4, 0, 0, 0, 0}));
  EXPECT_EQ(columns(-90.0f, 1.0f), Reds({0, 0, 0, 0, 0, 0, 0, 4}));
  EXPECT_EQ(columns(360.0f, 1.0f), columns(0.0f, 1.0f));
  EXPECT_EQ(columns(11.25f, 1.0f), Reds({0, 3, 1, 0, 0, 0, 0, 0})) << "a quarter of a column";
  EXPECT_EQ(columns(-11.25f, 1.0f), Reds({1, 3, 0, 0, 0, 0, 0, 0}));
}

TEST(Supply, FloatingThingsGetAStudioWithoutAGround) {
  Scene scene = make_space();
  const size_t instances = scene.instances.size();
  const LightPlan plan = supplied(scene);
  EXPECT_EQ(plan.surround, Surround::kStudio) << "under a sky there would be a plain with rocks on both sides of it";
  EXPECT_TRUE(says(plan, "floating things")) << plan.note;
  EXPECT_EQ(scene.instances.size(), instances);
  ASSERT_TRUE(scene.background);
  EXPECT_EQ(scene.background->radiance, vec3(0.0f)) << "no grey fog without a floor";
  EXPECT_EQ(scene.background->width, 0);
  EXPECT_GT(scene.environment.width, 0) << "the light stays";
}

TEST(Supply, AnObjectGetsAStudioAndAGround) {
  for (Scene scene : {make_chair(), make_car(), make_ball(0.3f)}) {
    const Bounds bounds = scene_bounds(scene);
    const size_t instances = scene.instances.size();
    const LightPlan plan = supplied(scene);
    EXPECT_EQ(plan.surround, Surround::kStudio);
    EXPECT_TRUE(plan.ground);
    EXPECT_FALSE(plan.lamp);
    EXPECT_TRUE(says(plan, "studio") && says(plan, "`env` 0")) << plan.note;
    ASSERT_EQ(scene.instances.size(), instances + 1);
    EXPECT_EQ(scene.supplied, 1u);
    EXPECT_TRUE(scene.background);
    const float height = bounds.high.y - bounds.low.y;
    const float ground = scene_bounds(scene).low.y;
    EXPECT_LT(ground, bounds.low.y);
    EXPECT_GT(ground, bounds.low.y - 0.01f * height);
  }
}

TEST(Supply, APlaceThatIsOpenUpwardsGetsASky) {
  for (Scene scene : {make_courtyard(), make_landscape(200.0f)}) {
    const size_t instances = scene.instances.size();
    const LightPlan plan = supplied(scene);
    EXPECT_EQ(plan.surround, Surround::kSky);
    EXPECT_EQ(scene.environment.width, 1024);
    EXPECT_EQ(scene.instances.size(), instances) << "no ground, no lamp";
    EXPECT_TRUE(says(plan, fmt::format("`env` sky:elevation={:g},azimuth={:g}", plan.sky.elevation, plan.sky.azimuth)))
        << plan.note;
  }
}

TEST(Supply, AClosedRoomGetsALamp) {
  for (Scene scene : {make_simple_room(), make_walled_room(), make_cave()}) {
    const size_t instances = scene.instances.size();
    const LightPlan plan = supplied(scene);
    EXPECT_FALSE(plan.surround);
    ASSERT_TRUE(plan.lamp);
    EXPECT_EQ(scene.instances.size(), instances + 1);
    EXPECT_TRUE(says(plan, "`lamp` none")) << plan.note;
    EXPECT_TRUE(has_light(scene));
    EXPECT_TRUE(plan_for(scene).note.empty()) << "it has light now";
  }
}

// Lit through a window alone it is rendered as dark as it is.
TEST(Supply, ARoomWithAWindowGetsTheSkyOutside) {
  const Scene scene = make_walled_room(true);
  const LightPlan plan = plan_for(scene);
  EXPECT_GT(plan.windows, kWindows);
  EXPECT_LT(plan.windows, 0.1f);
  EXPECT_EQ(plan.surround, Surround::kSky);
  EXPECT_FALSE(plan.lamp);
  EXPECT_TRUE(says(plan, "windows")) << plan.note;
  EXPECT_EQ(plan_for(make_walled_room()).windows, 0.0f);
}

TEST(Supply, WhatHasLightKeepsIt) {
  Scene lamp = make_simple_room(), sky = make_courtyard(), glow_room = make_simple_room(), object = make_chair();
  lamp.lights.push_back(lamp_in(vec3(0, 2, 0)));
  sky.environment.radiance = vec3(0.5f);
  add_rectangle(glow_room, vec3(-0.3f, 2.5f, -0.3f), vec3(0.6f, 0, 0), vec3(0, 0, 0.6f),
                add_material(glow_room, glow(vec3(4.0f))));
  object.lights.push_back(lamp_in(vec3(0, 3, 0), kLightDirectional));
  for (const Scene& scene : {lamp, sky, glow_room, object}) {
    const LightPlan plan = plan_for(scene);
    EXPECT_TRUE(plan.has_light);
    EXPECT_FALSE(plan.surround || plan.lamp || plan.ground || plan.as_painted);
    EXPECT_EQ(plan.note, "");
  }
}

// Light that does not arrive is none: a sun or a sky outside of a closed room, a gadget's indicator, a lamp elsewhere.
TEST(Supply, LightThatReachesNobodyDoesNotCount) {
  Scene sun = make_simple_room(), sky = make_simple_room(), gadget = make_simple_room(), far = make_simple_room();
  sun.lights.push_back(lamp_in(vec3(0, 2, 0), kLightDirectional));
  sky.environment.radiance = vec3(1.0f);
  add(gadget, make_sphere(0.004f, 8), add_material(gadget, glow(vec3(5.0f))), placed(vec3(1, 1, 0)));
  far.lights.push_back(lamp_in(vec3(0, 20, 0)));
  for (const Scene& scene : {sun, sky, gadget, far}) {
    const LightPlan plan = plan_for(scene);
    EXPECT_FALSE(plan.has_light);
    EXPECT_TRUE(plan.lamp);
  }
  Scene toy = make_chair();
  add(toy, make_sphere(0.02f, 8), add_material(toy, glow(vec3(5.0f))), placed(vec3(0, 1, 0)));
  EXPECT_EQ(plan_for(toy).surround, Surround::kStudio);
}

TEST(Supply, TheUserIsObeyed) {
  LightChoices given;
  given.surround = Surround::kGiven;
  given.given.radiance = vec3(0.25f);
  Scene chair = make_chair();
  LightPlan plan = supplied(chair, given);
  EXPECT_EQ(chair.environment.radiance, vec3(0.25f));
  EXPECT_FALSE(chair.background);
  EXPECT_EQ(chair.supplied, 0u);
  EXPECT_EQ(plan.note, "");
  EXPECT_TRUE(plan_for(make_simple_room(), given).lamp) << "an environment does not reach into a closed room";
  EXPECT_FALSE(plan_for(make_walled_room(true), given).lamp);

  LightChoices sky;
  sky.surround = Surround::kSky;
  sky.sky = {60.0f, 10.0f};
  Scene car = make_car(), yard = make_courtyard();
  EXPECT_TRUE(supplied(car, sky).ground);
  plan = supplied(yard, sky);
  EXPECT_EQ(plan.sky.elevation, 60.0f);
  EXPECT_EQ(plan.sky.azimuth, 10.0f);
  sky.ground = false;
  EXPECT_FALSE(plan_for(make_car(), sky).ground);

  LightChoices none;
  none.lamp = LampChoice::kNone;
  plan = plan_for(make_simple_room(), none);
  EXPECT_FALSE(plan.lamp || plan.surround);
  EXPECT_EQ(plan.note, "");

  LightChoices lamp;
  lamp.lamp = LampChoice::kPlaced;
  lamp.lamp_position = vec3(1.0f, 2.0f, 1.0f);
  plan = plan_for(make_walled_room(true), lamp);
  ASSERT_TRUE(plan.lamp);
  EXPECT_EQ(plan.lamp->position, lamp.lamp_position);
  EXPECT_EQ(plan.surround, Surround::kSky) << "outside";
}

TEST(Supply, UnlitShowsAllAsItIsPainted) {
  LightChoices choices;
  choices.unlit = true;
  Scene room = make_simple_room(), chair = make_chair();
  const LightPlan plan = supplied(room, choices);
  EXPECT_FALSE(plan.lamp);
  EXPECT_EQ(plan.note, "");
  for (const Material& material : room.materials) EXPECT_EQ(material.unlit, 1);
  EXPECT_FALSE(supplied(chair, choices).ground);
}

TEST(Supply, WhatIsPaintedWithItsLightIsShownAsItIs) {
  Scene room = make_simple_room();
  const int texture = add_texture(room, 4, 4, [](vec2) { return vec3(0.5f); });
  for (Material& material : room.materials) {
    material.emission = vec3(1.0f);
    material.emission_slot.texture = material.base_color_slot.texture = texture;
  }
  LightChoices lamp;
  lamp.lamp = LampChoice::kPlaced;
  // Emission from all surfaces is light enough, and would be added to the colours.
  const LightPlan plan = supplied(room);
  EXPECT_EQ(plan.paint, Paint::kGlowing);
  EXPECT_TRUE(plan.as_painted);
  EXPECT_FALSE(plan.lamp);
  EXPECT_TRUE(says(plan, "emit their own colours")) << plan.note;
  EXPECT_EQ(room.materials[0].unlit, 1);
}

TEST(Supply, OfTwoKindsOfPaintTheFilesOwnNeedsNoChange) {
  Scene room = make_simple_room();
  for (Material& material : room.materials) material.unlit = 1;
  const LightPlan plan = plan_for(room);
  EXPECT_EQ(plan.paint, Paint::kUnlit);
  EXPECT_FALSE(plan.lamp);
  EXPECT_TRUE(says(plan, "its materials are unlit")) << plan.note;
}

// In a narrow yard the default sun lights only the upper walls.
TEST(Supply, TheSunStandsWhereItLightsWhatIsSeen) {
  Scene slot = with_materials();
  add_block(slot, vec3(-3, -0.2f, -30), vec3(3, 0, 30), 0);
  add_block(slot, vec3(-3.5f, 0, -30), vec3(-2, 12, 30));
  add_block(slot, vec3(2, 0, -30), vec3(3.5f, 12, 30));
  const SceneRays rays(slot);
  const SkyOptions sun = best_sun(rays, vec3(0, 1.6f, 0));
  EXPECT_EQ(std::abs(std::remainder(sun.azimuth, 180.0f)) < 20.0f, true) << sun.azimuth << ": along the lane";
  const Scene plain = make_landscape(200.0f, 0.0f);
  const SceneRays open(plain);
  const SkyOptions usual = best_sun(open, vec3(0.3f, 1.6f, 0.2f));
  EXPECT_EQ(usual.elevation, SkyOptions().elevation);
  EXPECT_EQ(usual.azimuth, SkyOptions().azimuth);
}

// A room with a window and a lamp of its own does not get a sky, and a note reports it.
TEST(Supply, NothingBehindAWindowIsSaid) {
  Scene room = make_walled_room(true);
  PunctualLight lamp;
  lamp.position = vec3(0, 2, 0), lamp.intensity = vec3(10.0f);
  room.lights.push_back(lamp);
  const LightPlan plan = plan_for(room);
  EXPECT_FALSE(plan.surround);
  EXPECT_NE(plan.advice.find("`env` sky"), std::string::npos) << plan.advice;
  EXPECT_EQ(plan_for(make_walled_room(true)).advice, "") << "it gets a sky";
  LightChoices choices;
  choices.surround = Surround::kSky;
  EXPECT_EQ(plan_for(room, choices).advice, "") << "the user chose one";
}

TEST(Supply, AGlowingPaneIsNamed) {
  Scene room = make_walled_room(true);
  room.material_names = {"wall", "wood", "window pane"};
  add(room, make_box(vec3(0.02f, 1.0f, 1.0f)), add_material(room, glow(vec3(5.0f))), placed(vec3(3.1f, 1.5f, 0)));
  const LightPlan plan = plan_for(room);
  EXPECT_TRUE(plan.has_light);
  EXPECT_NE(plan.advice.find("'window pane'"), std::string::npos) << plan.advice;
}

TEST(Supply, PaintedScenesSaySo) {
  Scene room = make_simple_room();
  for (Material& material : room.materials) material.unlit = 1;
  const SceneRays rays(room);
  const Survey found = survey(rays);
  const LightPlan plan = plan_light(rays, found);
  apply_light(room, found, plan);
  EXPECT_TRUE(room.as_painted);
  Scene lit = make_simple_room();
  const SceneRays lit_rays(lit);
  const Survey lit_found = survey(lit_rays);
  apply_light(lit, lit_found, plan_light(lit_rays, lit_found));
  EXPECT_FALSE(lit.as_painted);
}

TEST(Supply, EmissionLevelIsThePowerOverTheSurface) {
  Scene scene = with_materials();
  add_rectangle(scene, vec3(0), vec3(3, 0, 0), vec3(0, 1, 0), 0);
  EXPECT_EQ(emission_level(scene), 0.0f);
  add_rectangle(scene, vec3(0), vec3(1, 0, 0), vec3(0, 0, 1), add_material(scene, glow(vec3(8.0f))));
  EXPECT_NEAR(emission_level(scene), 2.0f, 1e-5f);
  scene.materials.back().emission_slot.texture = add_texture(scene, 8, 8, [](vec2 uv) { return vec3(uv.x < 0.5f); });
  EXPECT_NEAR(emission_level(scene), 1.0f, 1e-4f);
}

}  // namespace
}  // namespace ods

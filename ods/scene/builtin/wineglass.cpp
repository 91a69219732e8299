// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// "wineglass": glass, wine and water on a laid table. Liquids overlap the wall of their glass slightly: where media
// overlap, the one with the highest index of refraction counts, so the boundary is the glass's own and no
// film of air remains.
#include <cmath>

#include "ods/kernel/camera/camera.h"
#include "ods/scene/builtin/builder.h"
#include "ods/scene/builtin/makers.h"
#include "ods/scene/builtin/patterns.h"

namespace ods {

static const float kTable = 0.74f;  // height of the table top

namespace {

struct Vessel {
  std::vector<vec2> inside;   // radius and height from the axis at the bottom to the rim
  std::vector<vec2> outside;  // profile from the axis under the foot to the rim, in the same form
};

}  // namespace

static Shape vessel_shape(const Vessel& vessel, int segments) {
  std::vector<vec2> profile = vessel.outside;
  profile.insert(profile.end(), vessel.inside.rbegin(), vessel.inside.rend());
  return make_lathe(profile, segments);
}

// The liquid in a vessel up to a height, half a millimetre wider than its inside.
static Shape filling_shape(const Vessel& vessel, float height, int segments) {
  const float overlap = 0.0005f;
  std::vector<vec2> profile = {vessel.inside.front() - vec2(0.0f, overlap)};
  for (size_t i = 1; i < vessel.inside.size(); i++) {
    const vec2 a = vessel.inside[i - 1], b = vessel.inside[i];
    if (b.y >= height) {
      const float t = (height - a.y) / (b.y - a.y);
      profile.push_back(vec2(mix(a.x, b.x, t) + overlap, height));
      break;
    }
    profile.push_back(b + vec2(overlap, -overlap));
  }
  profile.push_back(vec2(0.0f, height));
  return make_lathe(profile, segments);
}

static Vessel wine_vessel() {
  Vessel v;
  v.outside = {{0.0f, 0.0f}, {0.034f, 0.0f}, {0.0355f, 0.001f}};
  const std::vector<vec2> stem = {{0.0355f, 0.001f}, {0.0340f, 0.0026f}, {0.0150f, 0.0055f}, {0.0055f, 0.013f},
                                  {0.0040f, 0.040f}, {0.0040f, 0.075f},  {0.0070f, 0.089f},  {0.0240f, 0.104f},
                                  {0.0385f, 0.126f}, {0.0420f, 0.150f},  {0.0385f, 0.185f},  {0.0335f, 0.218f}};
  const std::vector<vec2> smooth = smooth_profile(stem, 8);
  v.outside.insert(v.outside.end(), smooth.begin() + 1, smooth.end());
  v.inside = smooth_profile({{0.0f, 0.0945f},
                             {0.010f, 0.0960f},
                             {0.0238f, 0.1065f},
                             {0.0370f, 0.1270f},
                             {0.0406f, 0.1500f},
                             {0.0372f, 0.1850f},
                             {0.0325f, 0.2176f}},
                            8);
  return v;
}

static Vessel water_vessel() {
  Vessel v;
  v.outside =
      smooth_profile({{0.0f, 0.0f}, {0.029f, 0.0f}, {0.0325f, 0.004f}, {0.0345f, 0.04f}, {0.0385f, 0.1050f}}, 6);
  v.inside =
      smooth_profile({{0.0f, 0.008f}, {0.026f, 0.008f}, {0.0305f, 0.012f}, {0.0328f, 0.04f}, {0.0368f, 0.1048f}}, 6);
  return v;
}

static Vessel carafe_vessel() {
  Vessel v;
  v.outside = {{0.0f, 0.0f}, {0.055f, 0.0f}};
  const std::vector<vec2> body = smooth_profile({{0.055f, 0.0f},
                                                 {0.064f, 0.006f},
                                                 {0.068f, 0.05f},
                                                 {0.058f, 0.12f},
                                                 {0.030f, 0.175f},
                                                 {0.026f, 0.215f},
                                                 {0.038f, 0.262f}},
                                                8);
  v.outside.insert(v.outside.end(), body.begin() + 1, body.end());
  v.inside = smooth_profile({{0.0f, 0.010f},
                             {0.050f, 0.010f},
                             {0.0605f, 0.016f},
                             {0.0650f, 0.05f},
                             {0.0552f, 0.119f},
                             {0.0272f, 0.1745f},
                             {0.0234f, 0.215f},
                             {0.0362f, 0.2618f}},
                            8);
  return v;
}

namespace {

struct Liquids {
  int glass, red, white, water;
};

}  // namespace

static Liquids add_liquids(Scene& scene) {
  const auto liquid = [&](float ior, vec3 color, float distance) {
    Material material = glass(ior);
    material.attenuation_color = color;
    material.attenuation_distance = distance;
    return add_material(scene, material);
  };
  Liquids all;
  all.glass = add_material(scene, glass(1.5f));
  all.red = liquid(1.34f, vec3(0.70f, 0.09f, 0.11f), 0.02f);
  all.white = liquid(1.34f, vec3(0.93f, 0.80f, 0.34f), 0.04f);
  all.water = liquid(1.333f, vec3(0.90f, 0.97f, 0.98f), 0.5f);
  return all;
}

static void add_glasses(Scene& scene) {
  const Liquids liquids = add_liquids(scene);
  const auto stand = [&](const Vessel& vessel, int filling, float level, vec2 place, int segments) {
    const glm::mat4 at = placed(vec3(place.x, kTable + 0.0005f, place.y));
    add(scene, vessel_shape(vessel, segments), liquids.glass, at);
    if (filling >= 0) add(scene, filling_shape(vessel, level, segments), filling, at);
  };
  stand(wine_vessel(), liquids.red, 0.152f, {0.03f, -0.66f}, 128);
  stand(wine_vessel(), liquids.white, 0.148f, {0.25f, -0.86f}, 96);
  stand(wine_vessel(), -1, 0.0f, {-0.30f, -1.02f}, 96);
  stand(water_vessel(), liquids.water, 0.075f, {0.17f, -0.64f}, 96);
  stand(water_vessel(), liquids.water, 0.06f, {-0.42f, -0.80f}, 96);
  stand(carafe_vessel(), liquids.red, 0.15f, {-0.13f, -0.82f}, 128);
}

static void add_plates(Scene& scene) {
  const int china = add_material(scene, paint(vec3(0.82f, 0.81f, 0.78f), 0.12f));
  const int band = add_material(scene, metal(vec3(1.0f, 0.74f, 0.35f), 0.15f));
  const int linen = add_material(scene, paint(vec3(0.42f, 0.10f, 0.08f), 0.9f));
  const int steel = add_material(scene, metal(vec3(0.85f, 0.84f, 0.82f), 0.12f));
  const Shape plate = make_lathe(smooth_profile({{0.0f, 0.004f},
                                                 {0.06f, 0.004f},
                                                 {0.07f, 0.0f},
                                                 {0.078f, 0.001f},
                                                 {0.125f, 0.016f},
                                                 {0.127f, 0.0175f},
                                                 {0.125f, 0.019f},
                                                 {0.08f, 0.007f},
                                                 {0.072f, 0.006f},
                                                 {0.0f, 0.006f}},
                                                5),
                                 96);
  const Shape handle = make_rounded_box(vec3(0.014f, 0.004f, 0.11f), 0.0019f, 2);
  const Shape blade = make_rounded_box(vec3(0.018f, 0.002f, 0.10f), 0.0009f, 1);
  for (const float side : {-1.0f, 1.0f}) {
    const vec3 at(side * 0.40f - 0.02f, kTable + 0.0005f, -0.66f);
    add(scene, plate, china, placed(at));
    add(scene, make_torus(0.118f, 0.0012f, 96, 8), band, placed(at + vec3(0.0f, 0.0168f, 0.0f)));
    add(scene, make_cushion(vec3(0.12f, 0.03f, 0.12f), 16), linen,
        placed(at + vec3(0.0f, 0.017f, 0.0f), 20.0f + 40.0f * side));
    add(scene, handle, steel, placed(at + vec3(0.16f, 0.003f, 0.04f)));
    add(scene, blade, steel, placed(at + vec3(0.162f, 0.003f, -0.06f)));
  }
}

static void add_fruit(Scene& scene) {
  const int bowl = add_material(scene, paint(vec3(0.05f, 0.11f, 0.16f), 0.2f));
  const Shape shape = make_lathe(smooth_profile({{0.0f, 0.0f},
                                                 {0.05f, 0.0f},
                                                 {0.055f, 0.006f},
                                                 {0.10f, 0.035f},
                                                 {0.135f, 0.078f},
                                                 {0.138f, 0.081f},
                                                 {0.134f, 0.082f},
                                                 {0.097f, 0.041f},
                                                 {0.05f, 0.014f},
                                                 {0.0f, 0.012f}},
                                                6),
                                 96);
  const vec3 at(0.10f, kTable, -1.12f);
  add(scene, shape, bowl, placed(at));
  const Shape fruit = make_lathe(smooth_profile({{0.0f, -0.030f},
                                                 {0.012f, -0.034f},
                                                 {0.034f, -0.020f},
                                                 {0.038f, 0.004f},
                                                 {0.030f, 0.026f},
                                                 {0.012f, 0.033f},
                                                 {0.004f, 0.029f},
                                                 {0.0f, 0.026f}},
                                                5),
                                 48);
  const Shape stalk = make_tube({{0.0f, 0.026f, 0.0f}, {0.001f, 0.036f, 0.0f}, {0.005f, 0.046f, 0.001f}}, 0.0012f, 8);
  const int skins[] = {add_material(scene, paint(vec3(0.55f, 0.03f, 0.02f), 0.25f)),
                       add_material(scene, paint(vec3(0.42f, 0.46f, 0.05f), 0.25f)),
                       add_material(scene, paint(vec3(0.85f, 0.30f, 0.015f), 0.45f))};
  const int wood = add_material(scene, paint(vec3(0.08f, 0.04f, 0.02f), 0.8f));
  const vec3 places[] = {{-0.055f, 0.068f, 0.02f},
                         {0.03f, 0.064f, 0.055f},
                         {0.05f, 0.066f, -0.03f},
                         {-0.03f, 0.066f, -0.05f},
                         {0.0f, 0.118f, 0.0f}};
  for (int i = 0; i < 5; i++) {
    const glm::mat4 place = placed(at + places[i], 70.0f * float(i)) * turned(vec3(1, 0, 0), 18.0f * float(i - 2));
    add(scene, fruit, skins[i % 3], place);
    add(scene, stalk, wood, place);
  }
}

static void add_table(Scene& scene) {
  const int grain = add_texture(scene, 1024, 512, wood_grain);
  const int wood = add_material(scene, textured(paint(vec3(0.44f, 0.21f, 0.09f), 0.22f), grain, vec2(1.6f, 0.8f)));
  add(scene, make_rounded_box(vec3(2.2f, 0.045f, 1.15f), 0.012f, 3), wood,
      placed(vec3(0.0f, kTable - 0.0225f, -1.06f)));
  for (const vec2 leg : {vec2(-0.95f, -0.62f), vec2(0.95f, -0.62f), vec2(-0.95f, -1.50f), vec2(0.95f, -1.50f)}) {
    add(scene, make_cylinder(0.035f, 0.70f, 32), wood, placed(vec3(leg.x, 0.35f, leg.y)));
  }
}

// Glass on columns, so that there are objects on every side.
static void add_columns(Scene& scene, int stone) {
  const int clear = add_material(scene, glass(1.5f));
  Material tinted = glass(1.5f);
  tinted.attenuation_color = vec3(0.25f, 0.65f, 0.85f);
  tinted.attenuation_distance = 0.15f;
  const int blue = add_material(scene, tinted);
  const Shape shaft = make_lathe({{0.0f, 0.0f},
                                  {0.24f, 0.0f},
                                  {0.24f, 0.06f},
                                  {0.17f, 0.1f},
                                  {0.15f, 0.85f},
                                  {0.21f, 0.93f},
                                  {0.21f, 0.98f},
                                  {0.0f, 0.98f}},
                                 64);
  const Shape ornaments[] = {
      transformed(make_sphere(0.18f, 96), placed(vec3(0.0f, 0.1801f, 0.0f))),
      transformed(make_torus(0.15f, 0.05f, 96, 32), placed(vec3(0.0f, 0.2001f, 0.0f)) * turned(vec3(1, 0, 0), 90.0f)),
      transformed(vessel_shape(carafe_vessel(), 96), placed(vec3(0.0f, 0.0005f, 0.0f), 0.0f, vec3(1.5f))),
  };
  for (int i = 0; i < 6; i++) {
    const float azimuth = 55.0f + 50.0f * float(i), distance = i % 2 == 0 ? 1.9f : 2.6f;
    const glm::mat4 foot = placed(vec3(0.0f), azimuth) * placed(vec3(0.0f, 0.0f, -distance));
    add(scene, shaft, stone, foot);
    add(scene, ornaments[i % 3], i % 2 == 0 ? clear : blue, foot * placed(vec3(0.0f, 0.98f, 0.0f)));
  }
}

// Marble tiles inside a round balustrade.
static void add_terrace(Scene& scene) {
  const int veins = add_texture(scene, 512, 512, marble);
  const int tiles = add_texture(scene, 1024, 1024, [](vec2 p) {
    const vec2 cell = floor(p * 4.0f), t = abs(fract(p * 4.0f) - 0.5f);
    if (max(t.x, t.y) > 0.49f) return vec3(0.12f, 0.11f, 0.10f);
    const bool dark = (static_cast<int>(cell.x) + static_cast<int>(cell.y)) % 2 == 0;
    return (dark ? vec3(0.42f, 0.33f, 0.27f) : vec3(0.86f, 0.82f, 0.76f)) * marble(fract(p + 0.37f * cell));
  });
  const int stone = add_material(scene, textured(paint(vec3(0.92f, 0.86f, 0.78f), 0.35f), veins, vec2(1.0f)));
  const int floor = add_material(scene, textured(paint(vec3(1.0f), 0.3f), tiles, vec2(2.4f)));
  add(scene, mapped_from_above(make_disc(4.6f, 96)), floor, placed(vec3(0.0f), 45.0f));
  add_columns(scene, stone);
  const float ring = 4.2f;
  const Shape baluster = make_lathe(smooth_profile({{0.0f, 0.1f},
                                                    {0.07f, 0.1f},
                                                    {0.07f, 0.14f},
                                                    {0.04f, 0.18f},
                                                    {0.075f, 0.32f},
                                                    {0.06f, 0.42f},
                                                    {0.03f, 0.58f},
                                                    {0.035f, 0.68f},
                                                    {0.065f, 0.72f},
                                                    {0.065f, 0.76f},
                                                    {0.0f, 0.76f}},
                                                   4),
                                    24);
  const int mesh = add_mesh(scene, baluster.vertices, baluster.triangles, stone);
  for (int i = 0; i < 96; i++)
    add_instance(scene, mesh, placed(vec3(0.0f), 3.75f * float(i)) * placed(vec3(0.0f, 0.0f, -ring)));
  const auto band = [&](float low, float high, float half) {
    add(scene,
        make_lathe(
            {{ring - half, low}, {ring + half, low}, {ring + half, high}, {ring - half, high}, {ring - half, low}}, 96),
        stone);
  };
  band(0.0f, 0.1f, 0.14f);
  band(0.75f, 0.84f, 0.12f);
}

// A low, hazy sun over hills: its wide glow gives glass bright edges and is still easy to sample.
static vec3 late_afternoon(vec3 d) {
  const float azimuth = std::atan2(d.x, -d.z);
  const vec3 sun = normalize(vec3(-0.72f, 0.42f, -0.62f));
  const float towards = max(dot(d, sun), 0.0f);
  const float ridge = 0.03f + 0.07f * noise(vec2(azimuth * 3.0f + 32.0f, 0.5f), 64, 3u) +
                      0.015f * noise(vec2(azimuth * 14.0f + 64.0f, 0.5f), 128, 4u);
  if (d.y < ridge) {
    const vec3 meadow = mix(vec3(0.22f, 0.26f, 0.10f), vec3(0.30f, 0.34f, 0.38f), smoothstep(-0.12f, ridge, d.y));
    return meadow * (0.9f + 0.2f * fractal_noise(vec2(azimuth * 20.0f + 64.0f, d.y * 60.0f + 64.0f), 256, 4, 5u));
  }
  vec3 sky = mix(vec3(1.05f, 0.86f, 0.66f), vec3(0.22f, 0.40f, 0.78f), pow(smoothstep(0.0f, 0.9f, d.y), 0.6f));
  const vec2 flat = vec2(d.x, d.z) / (d.y + 0.12f);
  const float cloud = smoothstep(0.5f, 0.78f, fractal_noise(flat * vec2(1.6f, 1.1f) + 64.0f, 128, 5, 6u));
  sky = mix(sky, vec3(1.25f, 1.12f, 0.98f), 0.8f * cloud * smoothstep(0.02f, 0.2f, d.y));
  return sky + vec3(1.1f, 0.62f, 0.25f) * pow(towards, 10.0f) +
         vec3(9.0f, 7.4f, 5.2f) * smoothstep(0.972f, 0.982f, towards);
}

Scene make_wineglass() {
  Scene scene;
  add_terrace(scene);
  add_table(scene);
  add_plates(scene);
  add_fruit(scene);
  add_glasses(scene);
  scene.environment = make_environment(1024, late_afternoon);
  scene.view_points = {{"seated", vec3(0.0f, 1.05f, -0.04f)}};
  return scene;
}

}  // namespace ods

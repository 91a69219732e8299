// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/builtin/decor.h"

#include "ods/kernel/camera/camera.h"
#include "ods/scene/builtin/builder.h"
#include "ods/scene/builtin/patterns.h"

namespace ods {

// A cone of fabric, open at both ends, emissive on both sides.
static void add_shade(Scene& scene, const Finishes& f, const glm::mat4& place, float low, float high, float height) {
  const float h = 0.5f * height;
  add(scene, make_lathe({{low, -h}, {high, h}}, 24), f.shade, place);
  Shape rims = transformed(make_torus(low, 0.004f, 48, 8), placed(vec3(0.0f, -h, 0.0f)));
  append(rims, transformed(make_torus(high, 0.004f, 48, 8), placed(vec3(0.0f, h, 0.0f))));
  for (int i = 0; i < 3; i++) {
    const float angle = 2.0f * kPi * float(i) / 3.0f;
    append(rims, make_tube({{0.0f, h - 0.02f, 0.0f}, {high * sin(angle), h, high * cos(angle)}}, 0.002f, 6));
  }
  add(scene, rims, f.brass, place);
}

void add_floor_lamp(Scene& scene, const Finishes& f, const glm::mat4& place) {
  const Shape stand = make_lathe({{0.0f, 0.0f},
                                  {0.15f, 0.0f},
                                  {0.152f, 0.008f},
                                  {0.145f, 0.018f},
                                  {0.02f, 0.024f},
                                  {0.011f, 0.04f},
                                  {0.011f, 1.40f},
                                  {0.0f, 1.40f}},
                                 40);
  add(scene, stand, f.brass, place);
  add_shade(scene, f, place * placed(vec3(0.0f, 1.50f, 0.0f)), 0.25f, 0.19f, 0.34f);
}

void add_table_lamp(Scene& scene, const Finishes& f, const glm::mat4& place) {
  const Shape body = make_lathe(smooth_profile({{0.0f, 0.0f},
                                                {0.06f, 0.0f},
                                                {0.065f, 0.01f},
                                                {0.095f, 0.08f},
                                                {0.085f, 0.15f},
                                                {0.035f, 0.21f},
                                                {0.018f, 0.24f},
                                                {0.0f, 0.242f}},
                                               6),
                                56);
  add(scene, body, f.dark_ceramic, place);
  add(scene, make_cylinder(0.008f, 0.12f, 16), f.brass, place * placed(vec3(0.0f, 0.29f, 0.0f)));
  add_shade(scene, f, place * placed(vec3(0.0f, 0.41f, 0.0f)), 0.18f, 0.13f, 0.23f);
}

void add_lantern(Scene& scene, const Finishes& f, const glm::mat4& place, float drop, float radius) {
  add(scene, make_tube({{0.0f, 0.0f, 0.0f}, {0.0f, -drop + radius, 0.0f}}, 0.004f, 10), f.iron, place);
  add(scene, make_cylinder(0.05f, 0.03f, 32), f.iron, place * placed(vec3(0.0f, -0.015f, 0.0f)));
  const glm::mat4 middle = place * placed(vec3(0.0f, -drop, 0.0f));
  // A hoop on every ring hides the small number of triangles in the paper.
  const int rings = 6;
  std::vector<vec2> paper;
  Shape hoops;
  for (int i = 0; i <= rings; i++) {
    const float phi = kPi * (float(i) / float(rings) - 0.5f);
    const bool pole = i == 0 || i == rings;
    paper.push_back(radius * vec2(pole ? 0.0f : cos(phi), sin(phi)));
    if (!pole) {
      append(hoops, transformed(make_torus(paper.back().x, 0.003f, 48, 6), placed(vec3(0.0f, paper.back().y, 0.0f))));
    }
  }
  add(scene, make_lathe(paper, 20), f.lantern, middle);
  add(scene, hoops, f.linen, middle);
}

// One leaf along +Z from the origin, folded a little along its middle and bent down; unit length.
static Shape leaf_shape() {
  return make_surface(6, 12, vec2(0.4f, 1.0f), [](float s, float t) {
    const float x = 2.0f * s - 1.0f;
    const float width = 0.24f * pow(sin(kPi * pow(mix(0.02f, 0.985f, t), 0.75f)), 0.9f);
    return vec3(x * width, 0.05f * x * x + 0.10f * sin(kPi * t) - 0.30f * t * t, t);
  });
}

void add_plant(Scene& scene, const Finishes& f, const glm::mat4& place, float height, int leaves, uint seed) {
  const float pot = 0.16f * pow(height, 0.6f);
  const Shape vessel = make_lathe(smooth_profile({{0.0f, 0.0f},
                                                  {0.7f, 0.0f},
                                                  {0.74f, 0.05f},
                                                  {0.95f, 1.1f},
                                                  {1.0f, 1.65f},
                                                  {0.97f, 1.68f},
                                                  {0.93f, 1.65f},
                                                  {0.9f, 1.5f},
                                                  {0.0f, 1.5f}},
                                                 4),
                                  48);
  add(scene, vessel, seed % 2 == 0 ? f.ceramic : f.dark_ceramic, place * placed(vec3(0.0f), 0.0f, vec3(pot)));
  add(scene, make_disc(0.9f * pot, 32), f.soil, place * placed(vec3(0.0f, 1.51f * pot, 0.0f)));
  const Shape leaf = leaf_shape();
  const int mesh = add_mesh(scene, leaf.vertices, leaf.triangles, f.leaf);
  Shape stems;
  for (int i = 0; i < leaves; i++) {
    const auto random = [&](int what) { return hash01(i, what, seed); };
    const float yaw = 137.5f * float(i) + 30.0f * random(0), angle = glm::radians(yaw);
    const float top = mix(0.45f, 1.0f, (float(i) + random(1)) / float(leaves)) * height;
    const float reach = mix(0.30f, 0.10f, top / height) * height * mix(0.7f, 1.2f, random(2));
    const vec3 away(sin(angle), 0.0f, -cos(angle));
    const vec3 foot(0.25f * pot * away + vec3(0.0f, 1.48f * pot, 0.0f)), tip(reach * away + vec3(0.0f, top, 0.0f));
    std::vector<vec3> path;
    for (int k = 0; k <= 6; k++) {
      const float t = float(k) / 6.0f;
      path.push_back(mix(foot, tip, vec3(t * t, t, t * t)));
    }
    append(stems, make_tube(path, 0.004f + 0.003f * height, 7));
    const float length = mix(0.20f, 0.32f, random(3)) * pow(height, 0.7f);
    add_instance(scene, mesh,
                 place * placed(tip, yaw + 180.0f) * turned(vec3(1, 0, 0), mix(-30.0f, 25.0f, random(4))) *
                     placed(vec3(0.0f), 0.0f, vec3(length)));
  }
  add(scene, stems, f.stem, place);
}

static const vec3 kBindings[] = {
    {0.30f, 0.03f, 0.03f}, {0.03f, 0.09f, 0.20f}, {0.04f, 0.14f, 0.08f}, {0.42f, 0.26f, 0.09f}, {0.62f, 0.54f, 0.40f},
    {0.10f, 0.05f, 0.03f}, {0.50f, 0.14f, 0.05f}, {0.05f, 0.20f, 0.24f}, {0.22f, 0.08f, 0.20f}, {0.55f, 0.36f, 0.05f}};

// A book of unit size standing on y = 0, its spine towards +Z: boards, a rounded spine, and pages set back inside.
BookMeshes add_book_meshes(Scene& scene, int pages) {
  const int spine = add_texture(scene, 64, 256, book_spine);
  Shape cover = transformed(make_rounded_box(vec3(1.0f, 1.0f, 0.10f), 0.045f, 2), placed(vec3(0.0f, 0.5f, 0.45f)));
  for (const float side : {-1.0f, 1.0f}) {
    append(cover, transformed(make_box(vec3(0.07f, 1.0f, 0.95f)), placed(vec3(side * 0.465f, 0.5f, -0.025f))));
  }
  BookMeshes meshes;
  for (const vec3& binding : kBindings) {
    const int material = add_material(scene, textured(paint(binding, 0.55f), spine, vec2(1.0f)));
    meshes.covers.push_back(add_mesh(scene, cover.vertices, cover.triangles, material));
  }
  const Shape block = transformed(make_box(vec3(0.88f, 0.95f, 0.92f)), placed(vec3(0.0f, 0.5f, -0.02f)));
  meshes.pages = add_mesh(scene, block.vertices, block.triangles, pages);
  return meshes;
}

static void add_book(Scene& scene, const BookMeshes& meshes, const glm::mat4& place, vec3 size, uint binding) {
  const glm::mat4 scaled = place * placed(vec3(0.0f), 0.0f, size);
  add_instance(scene, meshes.covers[binding % meshes.covers.size()], scaled);
  add_instance(scene, meshes.pages, scaled);
}

void add_books(Scene& scene, const Finishes& f, const glm::mat4& place, vec3 size, uint seed) {
  const float gap_at = hash01(7, 7, seed);
  float x = -0.5f * size.x + 0.01f;
  for (int i = 0; x < 0.5f * size.x - 0.06f; i++) {
    const auto random = [&](int what) { return hash01(i, what, seed); };
    const uint binding = static_cast<uint>(random(0) * 9.99f);
    const float height = size.y * mix(0.62f, 0.92f, random(1)), width = mix(0.016f, 0.05f, random(2) * random(2));
    const float depth = min(mix(0.15f, 0.23f, random(3)), size.z - 0.05f);
    const float front = 0.5f * size.z - 0.035f - 0.02f * random(4);
    const bool at_gap = x > (gap_at - 0.5f) * size.x && x < (gap_at - 0.5f) * size.x + 0.09f;
    if (at_gap && gap_at > 0.45f && x + 0.24f < 0.5f * size.x) {
      // Three books lying flat, with an object on top.
      float y = 0.0f;
      for (int k = 0; k < 3; k++) {
        const float thick = mix(0.02f, 0.045f, random(10 + k));
        const glm::mat4 lying = placed(vec3(x + 0.11f, y, front - 0.09f), mix(-6.0f, 6.0f, random(20 + k))) *
                                turned(vec3(0, 0, 1), 90.0f) * placed(vec3(0.5f * thick, -0.1f, 0.0f));
        add_book(scene, f.books, place * lying, vec3(thick, 0.2f, 0.16f), binding + 3u * static_cast<uint>(k));
        y += thick + 0.001f;
      }
      add_vase(scene, seed % 3 == 0 ? f.brass : f.ceramic, place * placed(vec3(x + 0.11f, y, front - 0.09f)),
               min(0.13f, size.y - y - 0.03f), static_cast<int>(seed % 3));
      x += 0.23f;
      continue;
    }
    add_book(scene, f.books, place * placed(vec3(x + 0.5f * width, 0.0f, front - 0.5f * depth)),
             vec3(width, height, depth), binding);
    x += width + 0.0015f;
  }
}

int add_painting(Scene& scene, int number) {
  return add_texture(scene, 512, 384, [number](vec2 p) { return painting(p, number); });
}

void add_picture(Scene& scene, const glm::mat4& place, vec2 size, int painting, int frame) {
  const int mount = add_material(scene, paint(vec3(0.78f, 0.75f, 0.68f), 0.9f));
  const float border = 0.035f, margin = 0.06f;
  const vec2 inner = size - 2.0f * margin;
  add(scene, make_box(vec3(size, 0.012f)), mount, place);
  add(scene, make_quad(vec3(-0.5f * inner, 0.009f), vec3(inner.x, 0.0f, 0.0f), vec3(0.0f, inner.y, 0.0f)),
      add_material(scene, textured(paint(vec3(1.0f), 0.6f), painting, inner)), place);
  Shape bars;
  for (const float side : {-1.0f, 1.0f}) {
    append(bars, transformed(make_rounded_box(vec3(border, size.y + border, 0.035f), 0.008f, 2),
                             placed(vec3(0.5f * side * size.x, 0.0f, 0.0f))));
    append(bars, transformed(make_rounded_box(vec3(size.x - border, border, 0.034f), 0.008f, 2),
                             placed(vec3(0.0f, 0.5f * side * size.y, 0.0f))));
  }
  add(scene, bars, frame, place);
}

void add_curtain(Scene& scene, int material, const glm::mat4& place, float width, float drop, float phase) {
  const Shape cloth = make_surface(120, 10, vec2(1.8f * width, drop), [=](float s, float t) {
    const float down = 1.0f - t;  // t runs upwards
    const float fold = 0.045f * mix(0.7f, 1.15f, down) * sin(2.0f * kPi * 7.0f * s + phase + 0.5f * sin(9.0f * s));
    const float sway = 0.02f * down * sin(5.0f * s + 3.0f * down + phase);
    return vec3((s - 0.5f) * width * mix(0.92f, 1.06f, down * down) + 0.012f * sin(31.0f * s), -drop * down,
                fold + sway);
  });
  add(scene, cloth, material, place);
}

void add_vase(Scene& scene, int material, const glm::mat4& place, float height, int form) {
  static const std::vector<vec2> forms[] = {
      {{0.0f, 0.0f},
       {0.20f, 0.0f},
       {0.22f, 0.03f},
       {0.42f, 0.40f},
       {0.30f, 0.72f},
       {0.14f, 0.88f},
       {0.19f, 1.0f},
       {0.15f, 0.97f},
       {0.0f, 0.6f}},
      {{0.0f, 0.0f},
       {0.28f, 0.0f},
       {0.30f, 0.04f},
       {0.34f, 0.5f},
       {0.27f, 0.85f},
       {0.29f, 1.0f},
       {0.25f, 0.97f},
       {0.0f, 0.5f}},
      {{0.0f, 0.0f},
       {0.3f, 0.0f},
       {0.48f, 0.2f},
       {0.5f, 0.45f},
       {0.25f, 0.72f},
       {0.10f, 0.8f},
       {0.12f, 1.0f},
       {0.08f, 0.98f},
       {0.0f, 0.7f}},
  };
  add(scene, make_lathe(smooth_profile(forms[form], 6), 48), material, place * placed(vec3(0.0f), 0.0f, vec3(height)));
}

void add_candle(Scene& scene, const Finishes& f, const glm::mat4& place, float height) {
  const Shape holder = make_lathe(smooth_profile({{0.0f, 0.0f},
                                                  {0.045f, 0.0f},
                                                  {0.046f, 0.006f},
                                                  {0.012f, 0.02f},
                                                  {0.009f, 0.6f * height},
                                                  {0.02f, 0.64f * height},
                                                  {0.02f, 0.67f * height},
                                                  {0.0f, 0.67f * height}},
                                                 4),
                                  32);
  add(scene, holder, f.brass, place);
  add(scene, make_cylinder(0.011f, 0.33f * height, 24), f.cream, place * placed(vec3(0.0f, 0.83f * height, 0.0f)));
}

static void add_wine_glass(Scene& scene, const Finishes& f, const glm::mat4& place, int wine) {
  std::vector<vec2> profile = smooth_profile({{0.0f, 0.0f},
                                              {0.034f, 0.0f},
                                              {0.035f, 0.002f},
                                              {0.012f, 0.006f},
                                              {0.004f, 0.02f},
                                              {0.004f, 0.075f},
                                              {0.022f, 0.098f},
                                              {0.041f, 0.14f},
                                              {0.034f, 0.205f}},
                                             5);
  const std::vector<vec2> inside =
      smooth_profile({{0.0328f, 0.2048f}, {0.0396f, 0.14f}, {0.0212f, 0.0995f}, {0.0f, 0.0915f}}, 8);
  profile.insert(profile.end(), inside.begin(), inside.end());
  add(scene, make_lathe(profile, 64), f.glass, place);
  const Shape filling = make_lathe({{0.0f, 0.091f},
                                    {0.0145f, 0.0948f},
                                    {0.0217f, 0.0990f},
                                    {0.0300f, 0.1110f},
                                    {0.0362f, 0.1240f},
                                    {0.0396f, 0.1360f},
                                    {0.0f, 0.1360f}},
                                   64);
  add(scene, filling, wine, place);
}

void add_wine_and_fruit(Scene& scene, const Finishes& f, const glm::mat4& place) {
  Material red = glass(1.34f);
  red.attenuation_color = vec3(0.70f, 0.09f, 0.11f);
  red.attenuation_distance = 0.02f;
  const int wine = add_material(scene, red);
  add_wine_glass(scene, f, place * placed(vec3(0.34f, 0.0f, 0.10f)), wine);
  add_wine_glass(scene, f, place * placed(vec3(0.20f, 0.0f, -0.14f)), wine);
  const Shape bowl = make_lathe(smooth_profile({{0.0f, 0.0f},
                                                {0.06f, 0.0f},
                                                {0.065f, 0.008f},
                                                {0.13f, 0.04f},
                                                {0.165f, 0.085f},
                                                {0.168f, 0.089f},
                                                {0.163f, 0.089f},
                                                {0.125f, 0.047f},
                                                {0.0f, 0.018f}},
                                               6),
                                64);
  const glm::mat4 middle = place * placed(vec3(-0.06f, 0.0f, 0.02f));
  add(scene, bowl, f.dark_ceramic, middle);
  const int skins[] = {add_material(scene, paint(vec3(0.85f, 0.30f, 0.02f), 0.45f)),
                       add_material(scene, paint(vec3(0.50f, 0.03f, 0.02f), 0.25f)),
                       add_material(scene, paint(vec3(0.40f, 0.45f, 0.05f), 0.28f))};
  const Shape fruit = make_lathe(smooth_profile({{0.0f, -0.030f},
                                                 {0.012f, -0.033f},
                                                 {0.034f, -0.018f},
                                                 {0.038f, 0.004f},
                                                 {0.030f, 0.026f},
                                                 {0.012f, 0.033f},
                                                 {0.004f, 0.030f},
                                                 {0.0f, 0.027f}},
                                                4),
                                 32);
  const vec3 places[] = {{-0.06f, 0.073f, 0.03f},
                         {0.04f, 0.071f, 0.06f},
                         {0.065f, 0.074f, -0.03f},
                         {-0.02f, 0.071f, -0.065f},
                         {0.005f, 0.128f, 0.0f}};
  for (int i = 0; i < 5; i++)
    add(scene, fruit, skins[i % 3],
        middle * placed(places[i], 50.0f * float(i)) * turned(vec3(1, 0, 0), 20.0f * float(i - 2)));
  const float thick[] = {0.035f, 0.022f, 0.028f};
  float y = 0.0f;
  for (int i = 0; i < 3; i++) {
    const glm::mat4 lying = placed(vec3(-0.40f, y, 0.05f), 9.0f * float(i) - 6.0f) * turned(vec3(0, 0, 1), 90.0f) *
                            placed(vec3(0.5f * thick[i], -0.15f + 0.02f * float(i), 0.0f));
    add_book(scene, f.books, place * lying, vec3(thick[i], 0.3f - 0.04f * float(i), 0.22f - 0.02f * float(i)),
             1u + 3u * static_cast<uint>(i));
    y += thick[i] + 0.0005f;
  }
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scenes with closed-form answers.
#include "ods/kernel/camera/camera.h"
#include "ods/scene/builtin/builder.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/builtin/makers.h"

namespace ods {

static const float kFurnaceAlbedo = 0.5f, kFurnaceEmission = 0.25f;

Scene make_furnace() {
  Scene scene;
  Material wall = matte(vec3(kFurnaceAlbedo));
  wall.emission = vec3(kFurnaceEmission);
  add(scene, inside_out(make_box(vec3(4.0f, 3.0f, 5.0f))), add_material(scene, wall));
  scene.view_points = {{"middle", vec3(0.3f, 0.2f, -0.4f)}};
  return scene;
}

float furnace_radiance(int bounces) {
  float sum = 0.0f, left = kFurnaceEmission;
  for (int segment = 0; segment <= bounces; segment++) {
    sum += left;
    left *= kFurnaceAlbedo;
  }
  return sum;
}

std::vector<vec3> marker_positions() {
  std::vector<vec3> positions;
  const float distances[] = {0.7f, 1.3f, 3.0f, 8.0f, 40.0f, 500.0f};
  const float elevations[] = {-80.0f, -55.0f, -30.0f, -12.0f, 0.0f, 9.0f, 25.0f, 48.0f, 76.0f};
  int number = 0;
  for (const float elevation : elevations) {
    // Seven per ring, each ring rotated a little, with one of them on the seam behind the viewer.
    const int ring = 7;
    for (int i = 0; i < ring; i++) {
      const float seam = number % 2 == 0 ? 180.0f : 179.0f;
      const float theta = glm::radians(seam + 360.0f * float(i) / float(ring)), phi = glm::radians(elevation);
      const vec3 direction(sin(theta) * cos(phi), sin(phi), -cos(theta) * cos(phi));
      positions.push_back(distances[number % 6] * direction);
      number++;
    }
  }
  return positions;
}

Scene make_marker_spheres() {
  Scene scene;
  const Shape ball = make_sphere(kMarkerSize, 24);
  const int mesh = add_mesh(scene, ball.vertices, ball.triangles, add_material(scene, glow(vec3(kMarkerRadiance))));
  for (const vec3& position : marker_positions()) {
    add_instance(scene, mesh, placed(position, 0.0f, vec3(length(position))));
  }
  scene.view_points = {{"middle"}};
  return scene;
}

static const float kLampRadius = 0.3f, kLampHeight = 1.2f, kLampAlbedo = 0.5f, kLampRadiance = 8.0f;

Scene make_lamp() {
  Scene scene;
  add(scene, make_floor(20.0f, 20.0f), add_material(scene, matte(vec3(kLampAlbedo))));
  // The polygon that approximates the disc has the disc's area.
  const int corners = 96;
  const float step = 2.0f * kPi / float(corners);
  const Shape disc = make_disc(kLampRadius * sqrt(step / sin(step)), corners);
  const int light = add_material(scene, glow(vec3(kLampRadiance)));
  add(scene, disc, light, placed(vec3(0.0f, kLampHeight, 0.0f)) * turned(vec3(1, 0, 0), 180.0f));
  scene.view_points = {{"beside", vec3(0.0f, 1.0f, 1.8f)}};
  return scene;
}

float lamp_floor_radiance(float x, float z) {
  const float a2 = kLampRadius * kLampRadius, h2 = kLampHeight * kLampHeight, d2 = x * x + z * z;
  const float sum = d2 + h2 + a2;
  const float share = 0.5f * (1.0f - (d2 + h2 - a2) / sqrt(sum * sum - 4.0f * a2 * d2));
  return kLampAlbedo * kLampRadiance * share;
}

static const float kSlabThickness = 0.1f, kSlabIor = 1.5f;
static const vec3 kSlabColor(0.9f, 0.7f, 0.4f);  // transmittance of kSlabThickness

Scene make_slab() {
  Scene scene;
  Material clear = glass(kSlabIor);
  clear.attenuation_color = kSlabColor;
  clear.attenuation_distance = kSlabThickness;
  add(scene, make_box(vec3(8.0f, 8.0f, kSlabThickness)), add_material(scene, clear), placed(vec3(0.0f, 0.0f, -1.5f)));
  scene.environment = make_environment(256, [](vec3 direction) { return vec3(direction.z < 0.0f ? 1.0f : 0.0f); });
  scene.view_points = {{"before"}};
  return scene;
}

vec3 slab_transmittance(vec3 direction) {
  const float cos_out = abs(direction.z);
  const float cos_in = sqrt(1.0f - (1.0f - cos_out * cos_out) / (kSlabIor * kSlabIor));
  const float parallel = (kSlabIor * cos_out - cos_in) / (kSlabIor * cos_out + cos_in);
  const float across = (cos_out - kSlabIor * cos_in) / (cos_out + kSlabIor * cos_in);
  const float reflected = 0.5f * (parallel * parallel + across * across);
  const vec3 left = pow(kSlabColor, vec3(1.0f / cos_in));
  return (1.0f - reflected) * (1.0f - reflected) * left / (1.0f - reflected * reflected * left * left);
}

}  // namespace ods

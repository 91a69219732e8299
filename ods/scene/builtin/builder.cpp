// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/builtin/builder.h"

#include <tbb/parallel_for.h>

#include <glm/gtc/matrix_transform.hpp>

#include "ods/image/tone.h"
#include "ods/kernel/camera/camera.h"

namespace ods {

vec3 around(float azimuth, float distance, float height) {
  const float a = glm::radians(azimuth);
  return {distance * sin(a), height, -distance * cos(a)};
}

glm::mat4 placed(vec3 position, float yaw, vec3 scale) {
  return glm::translate(glm::mat4(1.0f), position) * turned(vec3(0, 1, 0), -yaw) * glm::scale(glm::mat4(1.0f), scale);
}

glm::mat4 turned(vec3 axis, float degrees) {
  return glm::rotate(glm::mat4(1.0f), glm::radians(degrees), axis);
}

Material paint(vec3 color, float roughness) {
  Material material = default_material();
  material.base_color = vec4(color, 1.0f);
  material.roughness = roughness;
  return material;
}

Material matte(vec3 color) {
  Material material = paint(color, 1.0f);
  material.ior = 1.0f;
  return material;
}

Material metal(vec3 color, float roughness) {
  Material material = paint(color, roughness);
  material.metallic = 1.0f;
  return material;
}

Material glow(vec3 radiance) {
  Material material = matte(vec3(0.0f));
  material.emission = radiance;
  return material;
}

Material glass(float ior) {
  Material material = paint(vec3(1.0f), 0.0f);
  material.ior = ior;
  material.transmission = 1.0f;
  material.thickness = 1.0f;
  return material;
}

static uint to_srgb8(float linear) {
  return static_cast<uint>(srgb_encode(clamp(linear, 0.0f, 1.0f)) * 255.0f + 0.5f);
}

int add_texture(Scene& scene, int width, int height, const std::function<vec3(vec2)>& color) {
  const Texture texture = {
      static_cast<uint>(scene.texels.size()), width, height, kWrapRepeat, kWrapRepeat, 1, 0, kTexelBytes};
  scene.textures.push_back(texture);
  scene.texels.resize(scene.texels.size() + static_cast<size_t>(width) * static_cast<size_t>(height));
  tbb::parallel_for(0, height, [&, first = scene.texels.data() + texture.first_texel](int y) {
    uint* row = first + static_cast<size_t>(y) * static_cast<size_t>(width);
    for (int x = 0; x < width; x++) {
      const vec3 c = color((vec2(x, y) + 0.5f) / vec2(width, height));
      row[x] = to_srgb8(c.r) | to_srgb8(c.g) << 8 | to_srgb8(c.b) << 16 | 255u << 24;
    }
  });
  return static_cast<int>(scene.textures.size()) - 1;
}

Material textured(Material material, int texture, vec2 size) {
  material.base_color_slot.texture = texture;
  material.base_color_slot.axis_u = vec2(1.0f / size.x, 0.0f);
  material.base_color_slot.axis_v = vec2(0.0f, 1.0f / size.y);
  return material;
}

int add_material(Scene& scene, const Material& material, const std::string& name) {
  scene.materials.push_back(material);
  if (!name.empty()) {
    scene.material_names.resize(scene.materials.size());
    scene.material_names.back() = name;
  }
  return static_cast<int>(scene.materials.size()) - 1;
}

int add(Scene& scene, const Shape& shape, int material, const glm::mat4& object_to_world) {
  const int mesh = add_mesh(scene, shape.vertices, shape.triangles, material);
  add_instance(scene, mesh, object_to_world);
  return mesh;
}

Environment make_environment(int width, const std::function<vec3(vec3)>& radiance) {
  Environment environment;
  environment.radiance = vec3(1.0f);
  environment.width = width;
  environment.height = width / 2;
  environment.texels.resize(static_cast<size_t>(width) * static_cast<size_t>(environment.height));
  tbb::parallel_for(0, environment.height, [&](int y) {
    const float elevation = (0.5f - (float(y) + 0.5f) / float(environment.height)) * kPi;
    for (int x = 0; x < width; x++) {
      const float azimuth = ((float(x) + 0.5f) / float(width) - 0.5f) * 2.0f * kPi;
      environment.texels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] =
          radiance(direction_of(azimuth, elevation));
    }
  });
  return environment;
}

PunctualLight make_sun(float azimuth, float elevation, vec3 irradiance) {
  PunctualLight sun;
  sun.kind = kLightDirectional;
  sun.direction = -direction_of(glm::radians(azimuth), glm::radians(elevation));
  sun.intensity = irradiance;
  return sun;
}

}  // namespace ods

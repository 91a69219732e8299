// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// EXT_lights_image_based: the first level of its cube map becomes a lat-long environment. Its irradiance coefficients
// and blurred levels are only needed without path tracing.
// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Vendor/EXT_lights_image_based
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "ods/image/tone.h"
#include "ods/kernel/camera/projection.h"
#include "ods/scene/gltf/nodes.h"
#include "ods/scene/gltf/textures.h"

namespace ods {

using glm::dvec3;

namespace {

struct CubeMap {
  int size = 0;
  std::vector<Texels> faces;  // +X, -X, +Y, -Y, +Z, -Z
  std::vector<float> linear;  // linear light of each 8-bit value

  vec3 radiance_at(size_t face, int x, int y) const;
};

struct CubePlace {
  size_t face;
  vec2 uv;  // 0..1 from the picture's top left corner
};

}  // namespace

// RGBD: light above 1 is stored divided by alpha. The extension does not define the curve of the colours; they are read
// as sRGB, like other colours of glTF, and like Babylon.js writes and reads them.
vec3 CubeMap::radiance_at(size_t face, int x, int y) const {
  const uint32_t texel =
      faces[face].values[static_cast<size_t>(y) * static_cast<size_t>(size) + static_cast<size_t>(x)];
  const float share = static_cast<float>(std::max(texel >> 24, 1u)) / 255.0f;
  return vec3(linear[texel & 255u], linear[texel >> 8 & 255u], linear[texel >> 16 & 255u]) / share;
}

static CubeMap read_cube(const GltfFile& file, const JsonValue& level) {
  std::vector<TexelSource> sources;
  for (const JsonValue& face : level) {
    const int image = face.is_number() ? static_cast<int>(std::clamp(face.number, -1.0, 1e9)) : -1;
    sources.push_back({element(file, file.images, image, "image").first});
  }
  if (sources.size() != 6) fail(file, "has an image-based light without six faces; the file is damaged");
  CubeMap cube{0, decode_pictures(file, sources), linear_from_encoded(255)};
  cube.size = cube.faces[0].width;
  for (const Texels& face : cube.faces) {
    if (face.width == cube.size && face.height == cube.size) continue;
    fail(file, "has an image-based light whose faces are not squares of one size; the file is damaged");
  }
  return cube;
}

// Position of a direction in OpenGL's cube maps.
static CubePlace place_of(vec3 d) {
  const vec3 size = abs(d);
  if (size.x >= size.y && size.x >= size.z) {
    return {d.x > 0.0f ? 0u : 1u, vec2(d.x > 0.0f ? -d.z : d.z, -d.y) / (2.0f * size.x) + 0.5f};
  }
  if (size.y >= size.z) return {d.y > 0.0f ? 2u : 3u, vec2(d.x, d.y > 0.0f ? d.z : -d.z) / (2.0f * size.y) + 0.5f};
  return {d.z > 0.0f ? 4u : 5u, vec2(d.z > 0.0f ? d.x : -d.x, -d.y) / (2.0f * size.z) + 0.5f};
}

static vec3 light_from(const CubeMap& cube, vec3 direction) {
  const CubePlace place = place_of(direction);
  const vec2 last = vec2(static_cast<float>(cube.size - 1));
  const vec2 at = clamp(place.uv * static_cast<float>(cube.size) - 0.5f, vec2(0.0f), last);
  const glm::ivec2 low(at), high = min(low + 1, glm::ivec2(last));
  const vec2 share = at - vec2(low);
  const auto texel = [&](int x, int y) { return cube.radiance_at(place.face, x, y); };
  return mix(mix(texel(low.x, low.y), texel(high.x, low.y), share.x),
             mix(texel(low.x, high.y), texel(high.x, high.y), share.x), share.y);
}

// to_cube: rotates a direction in the world into the cube map's frame.
static Environment unroll(const CubeMap& cube, const glm::mat3& to_cube) {
  constexpr int kWidest = 4096, kSamples = 2;  // along a texel's side
  Environment environment;
  environment.width = std::clamp(4 * cube.size, 16, kWidest);
  environment.height = environment.width / 2;
  environment.texels.resize(static_cast<size_t>(environment.width) * static_cast<size_t>(environment.height));
  const vec2 size(environment.width, environment.height);
  tbb::parallel_for(0, environment.height, [&](int y) {
    for (int x = 0; x < environment.width; x++) {
      vec3 sum(0.0f);
      for (int i = 0; i < kSamples * kSamples; i++) {
        const vec2 place = (vec2(i % kSamples, i / kSamples) + 0.5f) / float(kSamples);
        const vec2 angle = ((vec2(x, y) + place) / size - 0.5f) * vec2(2.0f * kPi, -kPi);
        sum += light_from(cube, to_cube * direction_of(angle.x, angle.y));
      }
      environment.texels[static_cast<size_t>(y * environment.width + x)] = sum / float(kSamples * kSamples);
    }
  });
  return environment;
}

void read_image_light(const GltfFile& file, Scene& scene, int chosen) {
  if (file.scenes.empty()) return;
  const int index = chosen != -1 ? chosen : std::max(0, index_in(file, file.json.root(), "scene"));
  const JsonValue& shown = record(file, file.scenes, index, "scene");
  const int number_of_light = index_in(file, extension(shown, "EXT_lights_image_based"), "light");
  if (number_of_light == -1) return;
  const JsonValue& light = record(file, file.image_lights, number_of_light, "image-based light");
  const JsonValue& levels = light["specularImages"];
  const double intensity = number(light, "intensity", 1.0);
  if (levels.size() == 0 || !(intensity > 0.0)) {
    warn(scene, "an image-based light without images or intensity is ignored");
    return;
  }
  const CubeMap cube = read_cube(file, *levels.begin());
  const std::vector<double> turn = numbers(light, "rotation", {0.0, 0.0, 0.0, 1.0});
  const glm::dmat3 to_world(trs_matrix(dvec3(0.0), {turn[0], turn[1], turn[2], turn[3]}, dvec3(1.0)));
  scene.environment = unroll(cube, glm::mat3(glm::transpose(to_world)));
  scene.environment.radiance = vec3(static_cast<float>(std::min(intensity, 1e6)));
}

}  // namespace ods

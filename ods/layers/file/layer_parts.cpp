// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/file/layer_parts.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <map>
#include <mutex>
#include <numbers>

#include "ods/base/error.h"
#include "ods/image/image_file.h"

namespace ods {

// --- textures

static std::string encoded(const Image& image, FileFormat format, int quality, const std::string& name,
                           const std::function<void()>& band_done) {
  assert(image.width > 0 && image.height > 0);
  FileHeader header;
  header.format = format;
  header.width = image.width, header.height = image.height;
  header.quality = quality;
  for (const char* channel : {"R", "G", "B", "A"}) {
    if (static_cast<int>(header.channels.size()) < image.channels) header.channels.push_back({channel});
  }
  MemorySink sink("the texture of " + name);
  write_image(
      sink, header, [&](int y, std::span<float> row) { std::memcpy(row.data(), image.at(0, y), row.size_bytes()); },
      band_done);
  return sink.take();
}

std::vector<LayerPart> layer_parts(const LayeredScene& scene, FileFormat opaque, FileFormat alpha, int quality,
                                   const Progress& progress) {
  std::vector<LayerPart> parts;
  std::map<std::string, int> numbers;
  for (const LayerMesh& mesh : scene.meshes) {
    if (mesh.triangles.empty()) continue;
    const int number = numbers[mesh.noun]++;
    const bool is_first_sky = mesh.kind == LayerKind::kSky && number == 0;
    const std::string name = is_first_sky ? "sky" : fmt::format("{} {}", mesh.noun, number);
    const std::vector<ChangePlace>& changes = scene.film.change.places;
    const size_t index = static_cast<size_t>(&mesh - scene.meshes.data());
    const ChangePlace change = index < changes.size() ? changes[index] : ChangePlace{};
    parts.push_back({&mesh, name, has_alpha(mesh.kind) ? alpha : opaque, "", change});
  }
  const auto check = [&] {
    if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "cancelled");
  };
  std::mutex mutex;
  size_t done = 0;
  tbb::parallel_for(size_t{0}, parts.size(), [&](size_t i) {
    LayerPart& part = parts[i];
    assert(part.mesh->texture.channels == (has_alpha(part.mesh->kind) ? 4 : 3));
    part.texture = encoded(part.mesh->texture, part.format, quality, part.name, check);
    const std::lock_guard lock(mutex);
    done++;
    if (progress.report) progress.report(static_cast<double>(done) / static_cast<double>(parts.size()));
  });
  return parts;
}

FilmTextures film_textures(const LayerFilm& film, FileFormat opaque, FileFormat alpha, int quality,
                           const Progress& progress) {
  const size_t lights = film.light_times.size(), moving = film.lights.size();
  const std::vector<Image>& ratios = film.change.ratios;
  FilmTextures textures;
  for (size_t i = 0; i < moving; i++) {
    const FileFormat format = film.lights[i].front().channels == 4 ? alpha : opaque;
    textures.moving.push_back({fmt::format("film {}", i), format, std::vector<std::string>(lights)});
  }
  textures.change = {"changes", opaque, std::vector<std::string>(ratios.size())};
  const auto check = [&] {
    if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "cancelled");
  };
  const auto encode = [&](const std::vector<Image>& images, FilmTexture& texture) {
    tbb::parallel_for(size_t{0}, images.size(), [&](size_t i) {
      texture.lights[i] = encoded(images[i], texture.format, quality, texture.name, check);
    });
  };
  for (size_t i = 0; i < moving; i++) encode(film.lights[i], textures.moving[i]);
  encode(ratios, textures.change);
  return textures;
}

MeshOrder order_of(const LayerMesh& mesh) {
  if (mesh.kind != LayerKind::kBlended) return drawing_order(mesh.triangles, mesh.positions.size());
  MeshOrder order;
  std::vector<uint> places(mesh.positions.size(), ~0u);  // of the old vertices
  for (const uvec3& corners : mesh.triangles) {
    for (int i = 0; i < 3; i++) {
      uint& place = places[corners[i]];
      if (place == ~0u) {
        place = static_cast<uint>(order.vertices.size());
        order.vertices.push_back(corners[i]);
      }
      order.corners.push_back(place);
    }
  }
  return order;
}

// --- positions

vec3 stored_position(const LayeredScene& scene, const LayerMesh& mesh, size_t vertex) {
  const vec3 position = mesh.positions[vertex];
  return mesh.kind == LayerKind::kSky ? position : position - scene.box.center;
}

float rounding_step(const LayeredScene& scene, const LayerMesh& mesh, const vec3& stored) {
  constexpr float kNearest = 0.05f;  // metres; what is nearer is not looked at
  const vec3 from_box = max(abs(stored) - 0.5f * scene.box.size, vec3(0.0f));
  const bool is_sky = mesh.kind == LayerKind::kSky;
  const float distance = is_sky ? length(stored) : std::max(length(from_box), kNearest);
  const float pixel = 2.0f * std::numbers::pi_v<float> / static_cast<float>(scene.width);
  return 0.25f * pixel * distance * 2.0f /
         std::numbers::sqrt3_v<float>;  // the corner of a cube of steps moves farthest
}

static float farthest_of(const LayeredScene& scene, bool is_sky) {
  float distance = 0.0f;
  for (const LayerMesh& mesh : scene.meshes) {
    if ((mesh.kind == LayerKind::kSky) != is_sky) continue;
    for (size_t i = 0; i < mesh.positions.size(); i++) {
      distance = std::max(distance, length(stored_position(scene, mesh, i)));
    }
  }
  return distance;
}

// The distance of the sky's nearest triangle from its middle.
static float nearest_sky(const LayeredScene& scene) {
  float nearest = INFINITY;
  for (const LayerMesh& mesh : scene.meshes) {
    if (mesh.kind != LayerKind::kSky) continue;
    for (const uvec3& corners : mesh.triangles) {
      const vec3 a = mesh.positions[corners.x], b = mesh.positions[corners.y], c = mesh.positions[corners.z];
      const vec3 normal = cross(b - a, c - a);
      if (length(normal) > 0.0f) nearest = std::min(nearest, std::abs(dot(normal, a)) / length(normal));
    }
  }
  return nearest;
}

float sky_scale(const LayeredScene& scene) {
  constexpr float kLeast = 100.0f;  // metres: a head's motion within the box shifts it by some minutes of arc
  const float nearest = nearest_sky(scene);
  const bool has_extent = nearest > 0.0f && nearest < INFINITY;
  return has_extent ? std::max(kLeast, 2.0f * farthest_of(scene, false)) / nearest : 1.0f;
}

float farthest(const LayeredScene& scene) {
  return std::max(farthest_of(scene, false), sky_scale(scene) * farthest_of(scene, true));
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/rays/first_hits.h"

#include <algorithm>
#include <utility>

namespace ods {

FirstHits::FirstHits(const Scene& scene, const std::vector<char>& panes)
    : scene_(scene), no_lights_(without_lights(scene)), embree_(scene, EmbreeScene::kMaxCopiedTriangles, panes) {
  set_scene(tracer_, scene_, no_lights_);
  tracer_.ray_time = 0.5f;
}

void FirstHits::set_mirrors(std::vector<FlatMirror> mirrors, float sky_distance) {
  mirrors_ = std::move(mirrors);
  sky_distance_ = sky_distance;
}

SeenInstances FirstHits::numbers() const {
  return {static_cast<int>(scene_.instances.size()), static_cast<int>(mirrors_.size())};
}

int FirstHits::mirror_at(int instance, int triangle) const {
  for (size_t i = 0; i < mirrors_.size(); i++) {
    const FlatMirror& mirror = mirrors_[i];
    if (mirror.instance != instance) continue;
    if (std::ranges::binary_search(mirror.triangles, static_cast<uint>(triangle))) return static_cast<int>(i);
  }
  return -1;
}

void FirstHits::trace(RayPacket& packet, FirstHit* seen) const {
  PathTracer tracer = tracer_;  // it has state while it decides about alpha
  Hit found[RayPacket::kMax];
  packet.seed = hash_pair(static_cast<uint>(floatBitsToInt(packet.rays[0].direction.x)),
                          static_cast<uint>(floatBitsToInt(packet.rays[0].direction.y)));
  embree_.closest_hits(tracer, packet, found);
  for (int i = 0; i < packet.count; i++) {
    seen[i] = FirstHit();
    if (found[i].t < 0.0f) continue;
    const Instance instance = tracer.instance_now(found[i].instance);
    const auto triangle = tracer.triangle_of(instance, tracer.corners_of(found[i]));
    const vec3 normal = normalize(cross(triangle.ab, triangle.ac)) * handedness_of(instance);
    const bool front = dot(normal, packet.rays[i].direction) < 0.0f;
    seen[i] = {found[i].t, front ? normal : -normal, found[i].instance, found[i].triangle, front};
  }
}

void FirstHits::look(vec3 from, const vec3* directions, int count, FirstHit* seen) const {
  RayPacket packet;
  for (float& time : packet.times) time = 0.5f;
  for (int begin = 0; begin < count; begin += packet.count) {
    packet.count = std::min(count - begin, RayPacket::kMax);
    for (int i = 0; i < packet.count; i++) packet.rays[i] = {from, directions[begin + i]};
    trace(packet, seen + begin);
  }
  if (!mirrors_.empty()) follow(from, directions, count, seen);
}

void FirstHits::follow(vec3 from, const vec3* directions, int count, FirstHit* seen) const {
  const SeenInstances numbers = this->numbers();
  std::vector<std::pair<int, int>> reflected;  // ray and mirror
  for (int i = 0; i < count; i++) {
    const int mirror = seen[i].instance < 0 ? -1 : mirror_at(seen[i].instance, seen[i].triangle);
    if (mirror >= 0 && dot(mirrors_[static_cast<size_t>(mirror)].normal, directions[i]) < 0.0f) {
      reflected.emplace_back(i, mirror);
    }
  }
  RayPacket packet;
  for (float& time : packet.times) time = 0.5f;
  FirstHit beyond[RayPacket::kMax];
  for (size_t begin = 0; begin < reflected.size(); begin += static_cast<size_t>(packet.count)) {
    packet.count = static_cast<int>(std::min(reflected.size() - begin, size_t{RayPacket::kMax}));
    for (int i = 0; i < packet.count; i++) {
      const auto [ray, number] = reflected[begin + static_cast<size_t>(i)];
      const FlatMirror& mirror = mirrors_[static_cast<size_t>(number)];
      const vec3 at = offset_point(from + directions[ray] * seen[ray].distance, mirror.normal);
      packet.rays[i] = {at, reflected_direction(mirror, directions[ray])};
    }
    trace(packet, beyond);
    for (int i = 0; i < packet.count; i++) {
      const auto [ray, number] = reflected[begin + static_cast<size_t>(i)];
      FirstHit& one = seen[ray];
      if (beyond[i].instance < 0) {
        one = {sky_distance_, -directions[ray], numbers.sky_in(number), 0, true};
        continue;
      }
      const vec3 normal = reflected_direction(mirrors_[static_cast<size_t>(number)], beyond[i].normal);
      one = {one.distance + beyond[i].distance, normal, numbers.in_mirror(number, beyond[i].instance),
             beyond[i].triangle, beyond[i].front};
    }
  }
}

}  // namespace ods

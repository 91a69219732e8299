// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/rays/seen_mirrors.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ods {

namespace {

constexpr float kLeastAngle = 0.1f * 3.0462e-4f;  // steradians: 0.1 square degrees
constexpr size_t kMostCandidates = 64;            // those that would be the largest if nothing hid them
constexpr int kPoints = 256;                      // of a mirror, to which rays go
constexpr int kGrid = 24;                         // of points around a mirror
constexpr float kWallBehind = 0.1f;               // metres between a mirror and the wall on which it hangs
constexpr float kMostOpen = 0.02f;                // share of the surroundings that may be open

struct Candidate {
  FlatMirror mirror;
  float angle = 0.0f;  // steradians
};

float area_of(const FlatMirror& mirror, size_t first) {
  const vec3* const at = &mirror.corners[first];
  return 0.5f * length(cross(at[1] - at[0], at[2] - at[0]));
}

// The solid angle of an area around a point of the mirror.
float angle_of(const FlatMirror& mirror, vec3 point, vec3 eye, float area) {
  const vec3 ray = point - eye;
  const float distance = length(ray);
  return area * height_above(mirror, eye) / (distance * distance * distance);
}

float whole_angle(const FlatMirror& mirror, vec3 eye) {
  float sum = 0.0f;
  for (size_t i = 0; i < mirror.corners.size(); i += 3) {
    const vec3 middle = (mirror.corners[i] + mirror.corners[i + 1] + mirror.corners[i + 2]) / 3.0f;
    sum += angle_of(mirror, middle, eye, area_of(mirror, i));
  }
  return sum;
}

// The part of it that nothing hides: at points spread evenly over the triangles.
float seen_angle(const FirstHits& hits, const FlatMirror& mirror, vec3 eye) {
  float area = 0.0f, seen = 0.0f, passed = 0.0f;
  for (size_t i = 0; i < mirror.corners.size(); i += 3) area += area_of(mirror, i);
  int number = 0;
  for (size_t i = 0; i < mirror.corners.size(); i += 3) {
    passed += area_of(mirror, i);
    for (; number < kPoints && (static_cast<float>(number) + 0.5f) * area <= passed * kPoints; number++) {
      const float u = std::sqrt(fract(0.7548777f * static_cast<float>(number))),
                  v = fract(0.5698403f * static_cast<float>(number));
      const vec3 point =
          mirror.corners[i] * (1.0f - u) + mirror.corners[i + 1] * (u * (1.0f - v)) + mirror.corners[i + 2] * (u * v);
      const vec3 direction = normalize(point - eye);
      FirstHit found;
      hits.look(eye, &direction, 1, &found);
      const bool is_it = found.instance == mirror.instance &&
                         std::ranges::binary_search(mirror.triangles, static_cast<uint>(found.triangle));
      if (is_it) seen += angle_of(mirror, point, eye, area / kPoints);
    }
  }
  return seen;
}

// Returns whether what is behind the plane is hidden around the mirror: no eye looks past it farther than to the wall.
bool is_on_wall(const FirstHits& hits, const FlatMirror& mirror, vec3 middle, vec3 size) {
  const Frame frame = frame_around(mirror.normal);
  vec2 low(1e30f), high(-1e30f);
  for (const vec3& corner : mirror.corners) {
    const vec2 at(dot(frame.tangent, corner), dot(frame.bitangent, corner));
    low = min(low, at), high = max(high, at);
  }
  const float margin = std::max({size.x, size.y, size.z});
  low -= margin, high += margin;
  int open = 0, all = 0;
  for (int i = 0; i < kGrid * kGrid; i++) {
    const vec2 at = mix(low, high, (vec2(i % kGrid, i / kGrid) + 0.5f) / static_cast<float>(kGrid));
    const vec3 point = frame.tangent * at.x + frame.bitangent * at.y + mirror.normal * mirror.height;
    if (is_in_outline(mirror, point, 0.0f)) continue;
    for (int place = 0; place < 9; place++) {
      const vec3 corner(place & 1 ? 0.5f : -0.5f, place & 2 ? 0.5f : -0.5f, place & 4 ? 0.5f : -0.5f);
      const vec3 eye = middle + (place == 8 ? vec3(0.0f) : corner * size);
      const vec3 direction = normalize(point - eye);
      FirstHit found;
      hits.look(eye, &direction, 1, &found);
      all++;
      if (found.instance < 0 || height_above(mirror, eye + found.distance * direction) < -kWallBehind) open++;
    }
  }
  return static_cast<float>(open) <= kMostOpen * static_cast<float>(all);
}

}  // namespace

std::vector<FlatMirror> seen_mirrors(const FirstHits& hits, vec3 middle, vec3 size) {
  std::vector<Candidate> candidates;
  for (FlatMirror& mirror : find_mirrors(hits.scene())) {
    if (!turn_to(mirror, middle)) continue;
    const float angle = whole_angle(mirror, middle);
    if (angle >= kLeastAngle) candidates.push_back({std::move(mirror), angle});
  }
  const auto largest_first = [](const Candidate& a, const Candidate& b) { return a.angle > b.angle; };
  std::ranges::stable_sort(candidates, largest_first);
  if (candidates.size() > kMostCandidates) candidates.resize(kMostCandidates);
  for (Candidate& one : candidates) one.angle = seen_angle(hits, one.mirror, middle);
  std::ranges::stable_sort(candidates, largest_first);
  std::vector<FlatMirror> mirrors;
  for (Candidate& one : candidates) {
    if (one.angle < kLeastAngle || mirrors.size() == kMostMirrors) break;
    if (is_on_wall(hits, one.mirror, middle, size)) mirrors.push_back(std::move(one.mirror));
  }
  return mirrors;
}

}  // namespace ods

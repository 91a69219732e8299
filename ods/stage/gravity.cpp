// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/gravity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <numeric>
#include <string_view>
#include <vector>

#include "ods/camera/projection.h"
#include "ods/kernel/surface.h"
#include "ods/scene/things.h"

namespace ods {

namespace {

constexpr int kAxisX = 0, kAxisY = 1, kAxisZ = 2;
constexpr std::string_view kFloors[] = {"floor", "floors", "ground", "boden",  "fussboden",
                                        "sol",   "suelo",  "piso",   "terrain"};
constexpr std::string_view kCeilings[] = {"ceiling", "ceilings", "decke", "plafond", "techo"};

struct Box {
  Bounds bounds;
  bool empty = true;

  void add(vec3 p) {
    bounds.low = empty ? p : min(bounds.low, p);
    bounds.high = empty ? p : max(bounds.high, p);
    empty = false;
  }
  void add(const Bounds& other) { add(other.low), add(other.high); }
  vec3 size() const { return bounds.high - bounds.low; }
};

const Mesh& mesh_of(const Scene& scene, const Instance& instance) {
  return scene.meshes[static_cast<size_t>(instance.mesh)];
}

std::array<int, 2> level_axes(int up) {
  return up == kAxisY   ? std::array{kAxisX, kAxisZ}
         : up == kAxisZ ? std::array{kAxisX, kAxisY}
                        : std::array{kAxisY, kAxisZ};
}

// --- names

// The words of a name, in lower case: "FloorTiles_2" has "floor" and "tiles".
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words(1);
  bool was_small = false;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalpha(letter) == 0 || (was_small && std::isupper(letter) != 0)) words.emplace_back();
    if (std::isalpha(letter) != 0) words.back() += static_cast<char>(std::tolower(letter));
    was_small = std::islower(letter) != 0;
  }
  return words;
}

template <size_t kCount>
bool has_word(const std::string& name, const std::string_view (&wanted)[kCount]) {
  return std::ranges::any_of(words_of(name), [&](const std::string& word) {
    return std::ranges::find(wanted, std::string_view(word)) != std::end(wanted);
  });
}

// Returns whether a thing is thin along an axis, wide along both others, and at the scene's bottom (or its top).
bool is_level(const Box& thing, const Box& all, int up, bool at_the_top) {
  const auto [a, b] = level_axes(up);
  const vec3 size = thing.size(), whole = all.size();
  if (size[up] > 0.15f * std::min(size[a], size[b])) return false;
  if (size[a] < 0.4f * whole[a] || size[b] < 0.4f * whole[b]) return false;
  if (whole[up] < 0.1f * std::max(whole[a], whole[b])) return false;
  const float height = (0.5f * (thing.bounds.low[up] + thing.bounds.high[up]) - all.bounds.low[up]) / whole[up];
  return at_the_top ? height > 0.75f : height < 0.25f;
}

struct NameSigns {
  std::string z;  // the first thing that is level with z up
  bool y = false;
};

NameSigns names_in(const Scene& scene, const std::vector<std::optional<Bounds>>& boxes, const Box& all) {
  const Things things = things_of(scene);
  std::vector<Box> of_thing(things.names.size());
  for (size_t i = 0; i < boxes.size(); i++) {
    if (boxes[i]) of_thing[static_cast<size_t>(things.of_instance[i])].add(*boxes[i]);
  }
  NameSigns signs;
  for (size_t k = 0; k < of_thing.size(); k++) {
    const bool is_floor = has_word(things.names[k], kFloors), is_ceiling = has_word(things.names[k], kCeilings);
    if (of_thing[k].empty || is_floor == is_ceiling) continue;
    if (is_level(of_thing[k], all, kAxisY, is_ceiling)) signs.y = true;
    if (signs.z.empty() && is_level(of_thing[k], all, kAxisZ, is_ceiling)) signs.z = things.names[k];
  }
  return signs;
}

// --- cameras

struct CameraSigns {
  bool z = false, y = false;
};

CameraSigns cameras_in(const Scene& scene) {
  CameraSigns signs;
  for (const ViewPoint& view : scene.view_points) {
    const auto rad = [](float degrees) { return glm::radians(static_cast<double>(degrees)); };
    const auto [right, up, back] = orientation(rad(view.yaw), rad(view.pitch), rad(view.roll));
    if (up.y > 0.7) signs.y = true;
    if (up.z > 0.9 && std::abs(back.x) > 0.5) signs.z = true;
  }
  return signs;
}

// --- a room and what stands in it

// The connected parts of an instance: of each, its box and its triangles.
struct Part {
  Box box;
  std::vector<uint> triangles;
};

std::vector<Part> parts_of(const Scene& scene, const Instance& instance) {
  const Mesh& mesh = mesh_of(scene, instance);
  std::vector<vec3> places(mesh.vertex_count);
  std::vector<uint> root(mesh.vertex_count);
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](uint v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  std::map<std::array<float, 3>, uint> welded;
  for (uint v = 0; v < mesh.vertex_count; v++) {
    const vec3 p = scene.vertices[mesh.first_vertex + v].position;
    places[v] = to_world(instance, p);
    root[v] = welded.try_emplace({p.x, p.y, p.z}, v).first->second;
  }
  const auto corners = [&](uint k) { return scene.triangles[mesh.first_triangle + k]; };
  for (uint k = 0; k < mesh.triangle_count; k++) {
    const uvec3 t = corners(k);
    root[find(t.y)] = find(t.x);
    root[find(t.z)] = find(t.x);
  }
  std::map<uint, Part> parts;
  for (uint k = 0; k < mesh.triangle_count; k++) {
    const uvec3 t = corners(k);
    Part& part = parts[find(t.x)];
    for (const uint v : {t.x, t.y, t.z}) part.box.add(places[v]);
    part.triangles.push_back(k);
  }
  std::vector<Part> found;
  for (auto& [key, part] : parts) found.push_back(std::move(part));
  return found;
}

struct Room {
  vec3 size;
  float slack = 0.0f;
  std::array<std::map<int, float>, 3> levels;  // of the walls, floor and ceiling: area by axis and height, in slacks
  std::vector<Box> things;

  bool is_large(int axis, int height) const {
    const auto [a, b] = level_axes(axis);
    float area = 0.0f;
    for (int h = height - 1; h <= height + 1; h++) {
      const auto found = levels[static_cast<size_t>(axis)].find(h);
      if (found != levels[static_cast<size_t>(axis)].end()) area += found->second;
    }
    return area > 0.25f * size[a] * size[b];
  }
  int step(float height) const { return static_cast<int>(std::floor(height / slack)); }
};

// Parts that span the scene along two axes are its walls, floor and ceiling; all other parts are things.
void add_part(Room& room, const Scene& scene, const Instance& instance, const Part& part) {
  int spans = 0;
  for (int axis = 0; axis < 3; axis++) spans += part.box.size()[axis] > 0.6f * room.size[axis] ? 1 : 0;
  if (spans < 2) {
    room.things.push_back(part.box);
    return;
  }
  const Mesh& mesh = mesh_of(scene, instance);
  for (const uint k : part.triangles) {
    const uvec3 t = scene.triangles[mesh.first_triangle + k];
    const auto at = [&](uint v) { return to_world(instance, scene.vertices[mesh.first_vertex + size_t{v}].position); };
    const vec3 a = at(t.x), across = cross(at(t.y) - a, at(t.z) - a);
    for (int axis = 0; axis < 3; axis++) {
      if (std::abs(across[axis]) < 0.99f * length(across)) continue;
      room.levels[static_cast<size_t>(axis)][room.step(a[axis])] += 0.5f * length(across);
    }
  }
}

// How many of the things touch a large level surface with their low (or high) side. Flat ones count if asked for.
int resting(const Room& room, int axis, bool low, bool flat) {
  const auto [a, b] = level_axes(axis);
  int count = 0;
  for (const Box& thing : room.things) {
    const vec3 size = thing.size();
    if (!flat && size[axis] < 0.5f * std::max(size[a], size[b])) continue;
    count += room.is_large(axis, room.step(low ? thing.bounds.low[axis] : thing.bounds.high[axis])) ? 1 : 0;
  }
  return count;
}

int walls_of(const Room& room, const Box& all) {
  int walls = 0;
  for (const int axis : {kAxisX, kAxisY}) {
    for (const bool low : {true, false}) {
      bool found = false;
      for (const auto& [height, area] : room.levels[static_cast<size_t>(axis)]) {
        const float at = (static_cast<float>(height) * room.slack - all.bounds.low[axis]) / room.size[axis];
        found |= (low ? at < 0.25f : at > 0.75f) && room.is_large(axis, height);
      }
      walls += found ? 1 : 0;
    }
  }
  return walls;
}

bool is_room_with_z_up(const Scene& scene, const Box& all) {
  constexpr size_t kMostVertices = 4'000'000, kFewest = 6;
  constexpr int kFewestStanding = 4, kFewestWalls = 3;
  Room room;
  room.size = all.size();
  const float longest = std::max({room.size.x, room.size.y, room.size.z});
  if (room.size.z < 0.2f * longest || !(longest > 0.0f)) return false;
  room.slack = 0.005f * longest;
  size_t vertices = 0;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (!is_hidden(scene, i)) vertices += mesh_of(scene, scene.instances[i]).vertex_count;
  }
  if (vertices > kMostVertices) return false;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (is_hidden(scene, i)) continue;
    for (const Part& part : parts_of(scene, scene.instances[i])) add_part(room, scene, scene.instances[i], part);
  }
  const int standing = resting(room, kAxisZ, true, false);
  if (room.things.size() < kFewest || standing < kFewestStanding) return false;
  if (2 * standing < static_cast<int>(room.things.size()) || walls_of(room, all) < kFewestWalls) return false;
  if (5 * resting(room, kAxisY, true, true) > standing || resting(room, kAxisZ, false, true) >= standing) return false;
  for (const bool low : {true, false}) {
    if (2 * resting(room, kAxisX, low, true) > standing || 2 * resting(room, kAxisY, low, true) > standing)
      return false;
  }
  return true;
}

}  // namespace

std::vector<std::optional<Bounds>> instance_boxes(const Scene& scene) {
  std::vector<std::optional<Bounds>> boxes(scene.instances.size());
  for (size_t i = 0; i < boxes.size(); i++) {
    if (is_hidden(scene, i)) continue;
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = mesh_of(scene, instance);
    Box box;
    for (uint k = 0; k < mesh.vertex_count; k++) {
      box.add(to_world(instance, scene.vertices[mesh.first_vertex + k].position));
    }
    if (!box.empty) boxes[i] = box.bounds;
  }
  return boxes;
}

std::string sign_of_z_up(const Scene& scene) {
  const std::vector<std::optional<Bounds>> boxes = instance_boxes(scene);
  Box all;
  for (const std::optional<Bounds>& box : boxes) {
    if (box) all.add(*box);
  }
  if (all.empty) return "";
  const NameSigns names = names_in(scene, boxes, all);
  const CameraSigns cameras = cameras_in(scene);
  if (names.y || cameras.y) return "";
  if (!names.z.empty()) return fmt::format("'{}' is level with z up", names.z);
  if (cameras.z) return "the file's camera has z above it";
  if (is_room_with_z_up(scene, all)) return "the file is a room in which things stand with z up";
  return "";
}

}  // namespace ods

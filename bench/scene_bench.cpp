// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Time to load a compressed scene of a million triangles, relative to the same scene without compression, and memory,
// relative to the loaded scene: alternating, five times, of which the median counts. Targets: at most 1.5 and 2. A
// single primitive takes 2.9 times the scene's memory, all of it libdraco's own: corner tables of the mesh and of each
// attribute. Primitives of a usual size are below the target.
#include <draco/compression/expert_encode.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/measure.h"
#include "ods/base/large_blocks.h"
#include "ods/scene/gltf/gltf.h"

namespace {

using nlohmann::json;
using namespace ods;

// A bumpy ball, or a part of it: rings of `wide` quads.
struct Shape {
  std::vector<float> positions, normals, uvs;
  std::vector<uint32_t> corners;
  size_t count() const { return positions.size() / 3; }
};

Shape make_ball(uint32_t wide, uint32_t high, uint32_t first, uint32_t last) {
  constexpr float kPi = 3.14159265f;
  Shape shape;
  for (uint32_t j = first; j <= last; j++) {
    for (uint32_t i = 0; i <= wide; i++) {
      const float u = static_cast<float>(i) / static_cast<float>(wide),
                  v = static_cast<float>(j) / static_cast<float>(high);
      const float a = 2.0f * kPi * u, b = kPi * v;
      const vec3 n(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
      const vec3 p = n * (1.0f + 0.02f * std::sin(40.0f * a) * std::sin(30.0f * b));
      shape.positions.insert(shape.positions.end(), {p.x, p.y, p.z});
      shape.normals.insert(shape.normals.end(), {n.x, n.y, n.z});
      shape.uvs.insert(shape.uvs.end(), {u, v});
    }
  }
  for (uint32_t j = 0; j < last - first; j++) {
    for (uint32_t i = 0; i < wide; i++) {
      const uint32_t a = j * (wide + 1) + i, b = a + 1, c = a + wide + 1, d = c + 1;
      shape.corners.insert(shape.corners.end(), {a, c, b, b, c, d});
    }
  }
  return shape;
}

int add_floats(draco::Mesh& mesh, draco::GeometryAttribute::Type type, const std::vector<float>& values,
               int components) {
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, static_cast<int8_t>(components), draco::DT_FLOAT32, false, 4 * components, 0);
  const auto count = static_cast<uint32_t>(values.size() / static_cast<size_t>(components));
  mesh.set_num_points(count);
  const int id = mesh.AddAttribute(attribute, true, count);
  for (uint32_t i = 0; i < count; i++) {
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i),
                                          &values[i * static_cast<uint32_t>(components)]);
  }
  return id;
}

// With the defaults of Blender's exporter: 14, 10 and 12 bits.
std::string draco_stream(const Shape& shape) {
  draco::Mesh mesh;
  const int position = add_floats(mesh, draco::GeometryAttribute::POSITION, shape.positions, 3);
  const int normal = add_floats(mesh, draco::GeometryAttribute::NORMAL, shape.normals, 3);
  const int uv = add_floats(mesh, draco::GeometryAttribute::TEX_COORD, shape.uvs, 2);
  for (size_t i = 0; i < shape.corners.size(); i += 3) {
    mesh.AddFace({draco::PointIndex(shape.corners[i]), draco::PointIndex(shape.corners[i + 1]),
                  draco::PointIndex(shape.corners[i + 2])});
  }
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetSpeedOptions(4, 4);
  encoder.SetAttributeQuantization(position, 14);
  encoder.SetAttributeQuantization(normal, 10);
  encoder.SetAttributeQuantization(uv, 12);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok()) std::abort();
  return {buffer.data(), buffer.size()};
}

// A GLB that is filled primitive by primitive.
struct Writer {
  json document = {{"asset", {{"version", "2.0"}}},
                   {"scenes", {{{"nodes", {0}}}}},
                   {"nodes", {{{"mesh", 0}}}},
                   {"meshes", {{{"primitives", json::array()}}}}};
  std::string binary;

  size_t add_view(const void* data, size_t size) {
    document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", size}});
    binary.append(static_cast<const char*>(data), size);
    binary.resize((binary.size() + 3) / 4 * 4);
    return document["bufferViews"].size() - 1;
  }

  template <class T>
  size_t add(const std::vector<T>& values, const char* type, size_t components, bool plain) {
    json accessor = {{"componentType", std::is_same_v<T, float> ? 5126 : 5125},
                     {"count", values.size() / components},
                     {"type", type}};
    if (plain) accessor["bufferView"] = add_view(values.data(), values.size() * sizeof(T));
    document["accessors"].push_back(accessor);
    return document["accessors"].size() - 1;
  }

  void add(const Shape& shape, bool plain) {
    json primitive;
    primitive["attributes"] = {{"POSITION", add(shape.positions, "VEC3", 3, plain)},
                               {"NORMAL", add(shape.normals, "VEC3", 3, plain)},
                               {"TEXCOORD_0", add(shape.uvs, "VEC2", 2, plain)}};
    primitive["indices"] = add(shape.corners, "SCALAR", 1, plain);
    if (!plain) {
      const std::string stream = draco_stream(shape);
      primitive["extensions"]["KHR_draco_mesh_compression"] = {
          {"bufferView", add_view(stream.data(), stream.size())},
          {"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}}};
    }
    document["meshes"][0]["primitives"].push_back(primitive);
  }

  void write(const std::string& path) {
    document["buffers"] = {{{"byteLength", binary.size()}}};
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::ofstream file(path, std::ios::binary);
    const auto word = [&](size_t value) {
      const auto bytes = static_cast<uint32_t>(value);
      file.write(reinterpret_cast<const char*>(&bytes), 4);
    };
    file << "glTF";
    word(2), word(28 + text.size() + binary.size());
    word(text.size()), word(0x4e4f534a);
    file << text;
    word(binary.size()), word(0x004e4942);
    file << binary;
  }
};

size_t size_of(const Scene& scene) {
  return scene.vertices.size() * sizeof(Vertex) + scene.triangles.size() * sizeof(uvec3);
}

void load_draco(benchmark::State& state, uint32_t primitives) {
  constexpr uint32_t kWide = 1000, kHigh = 512;  // a little more than a million triangles
  const Folder folder;
  {
    Writer plain, packed;
    for (uint32_t i = 0; i < primitives; i++) {
      const Shape shape = make_ball(kWide, kHigh, i * kHigh / primitives, (i + 1) * kHigh / primitives);
      plain.add(shape, true);
      packed.add(shape, false);
    }
    plain.write(folder.path("plain.glb"));
    packed.write(folder.path("packed.glb"));
    state.counters["packed_MB"] = static_cast<double>(packed.binary.size()) * 1e-6;
  }
  std::vector<std::pair<Seconds, Seconds>> rounds;
  double peak = 0.0, plain_peak = 0.0, size = 0.0;
  const auto load = [&](const std::string& name, double* maximum) {
    malloc_trim(0);
    forget_peak();
    const double before = peak_megabytes();
    const Seconds seconds = seconds_of([&] {
      const Scene scene = load_gltf(folder.path(name));
      size = static_cast<double>(size_of(scene)) / 1048576.0;
      state.counters["triangles"] = static_cast<double>(scene.triangles.size());
    });
    *maximum = std::max(*maximum, peak_megabytes() - before);
    return seconds;
  };
  for (auto _ : state) {
    const Seconds theirs = load("plain.glb", &plain_peak);
    rounds.emplace_back(load("packed.glb", &peak), theirs);
  }
  const auto middle = rounds.begin() + static_cast<ptrdiff_t>(rounds.size() / 2);
  std::nth_element(rounds.begin(), middle, rounds.end(), [](const auto& a, const auto& b) {
    return a.first.wall * b.second.wall < b.first.wall * a.second.wall;
  });
  say(state, middle->first, middle->second);
  state.counters["scene_MB"] = size;
  state.counters["peak_MB"] = peak;
  state.counters["peak_over_scene"] = peak / size;
  state.counters["plain_peak_over_scene"] = plain_peak / size;
}

}  // namespace

int main(int argc, char** argv) {
  return_large_blocks();  // like in the command
  for (const uint32_t primitives : {1u, 16u}) {
    benchmark::RegisterBenchmark(("draco/primitives:" + std::to_string(primitives)).c_str(),
                                 [=](benchmark::State& state) { load_draco(state, primitives); })
        ->Iterations(5)
        ->Unit(benchmark::kSecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

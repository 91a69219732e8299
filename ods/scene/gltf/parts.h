// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the parts of the glTF reader share; only ods/scene/gltf.cpp and its folder include this.
//   source    bytes of the file, its buffers and pictures -> GltfFile
//   accessor  numbers out of buffers
//   material  materials, samplers, textures
//   mesh      primitives -> meshes
//   nodes     the hierarchy -> instances, lights, view points
// Every function here throws Error(kInput) naming the file when the file does not hold what it promises.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ods/scene/scene.h"

namespace tinygltf {
class Model;
class Value;
}  // namespace tinygltf

namespace ods {

using Bytes = std::span<const unsigned char>;

// Nothing in a Scene lies further from its origin than this: squared areas still fit a float.
inline constexpr float kFarthest = 1e9f;  // metres

// Texture coordinates, and each number of their transforms, are cut here: further out a float has no digits left for
// the place within a texel.
inline constexpr float kLargestUv = 1e6f;

struct ImageSource {
  std::string uri;  // empty where the picture lies in the buffer view
  int view = -1;
  size_t first = 0;  // the first image with the same source: the one that is read
};

// A file being read. The model's own buffers and images stay empty: tinygltf reads the records, we the bytes, so that
// nothing is copied, loaded twice or believed about its size.
struct GltfFile {
  std::string path;
  std::shared_ptr<const tinygltf::Model> model;
  std::vector<Bytes> buffers;
  std::vector<ImageSource> images;
  std::vector<std::shared_ptr<const std::vector<unsigned char>>> storage;  // what buffers point into
  size_t size = 0;                                                         // bytes of the file and of its buffers
  size_t budget = 0;  // how many more corners and instances a file of this size may ask for
};

[[noreturn]] void fail(const GltfFile& file, const std::string& what);

// Element `index` of a list of the file; `what` is its name in the message when there is none.
template <class List>
auto& element(const GltfFile& file, List& list, int index, const char* what) {
  if (index < 0 || static_cast<size_t>(index) >= list.size()) {
    fail(file, std::string(what) + " " + std::to_string(index) + " does not exist; the file is damaged");
  }
  return list[static_cast<size_t>(index)];
}

// Text of the file as it may stand in a message: one line, not endless.
std::string printable(const std::string& text);

// A part of the file that is not rendered; said once.
void warn(Scene& scene, const std::string& what);

// Takes from the budget, so that a small file cannot ask for gigabytes by naming one accessor a million times.
void spend(GltfFile& file, size_t count);

// --- source.cpp
GltfFile open_gltf(const std::string& path);
GltfFile open_gltf_bytes(Bytes bytes, const std::string& path);
Bytes buffer_view_bytes(const GltfFile& file, int view);
std::vector<unsigned char> image_bytes(const GltfFile& file, const ImageSource& image);
// The size of the picture's own file; 0 where it lies in the glTF file, or nowhere.
size_t external_bytes(const GltfFile& file, const ImageSource& image);

// --- accessor.cpp
// One accessor, checked to lie inside its buffer: at(i) is element i as floats (normalized integers mapped as the
// specification says), components that it does not have are 0, w is 1.
struct AccessorView {
  size_t count = 0;
  int components = 0;

  vec4 at(size_t i) const;
  uint index_at(size_t i) const;

  const unsigned char* data = nullptr;
  size_t stride = 0;
  int component_type = 0;
  bool normalized = false;
  std::shared_ptr<const std::vector<unsigned char>> expanded;  // what data points to in a sparse accessor
};

// accessor -1: an AccessorView with count 0.
AccessorView open_accessor(GltfFile& file, int accessor);

// --- material.cpp
// Scene materials are the file's in their order, then one more: what a primitive without a material gets.
void read_materials(const GltfFile& file, Scene& scene);

// A member of an object, or the fallback where it is absent or no finite number.
double number(const tinygltf::Value& object, const char* key, double fallback);
int integer(const tinygltf::Value& object, const char* key, int fallback);
// The member as an object; an empty one where it is absent or something else.
const tinygltf::Value& object(const tinygltf::Value& object, const char* key);

// --- mesh.cpp
// The Scene meshes that a mesh of the file becomes: one for each primitive that has triangles.
std::vector<int> read_mesh(GltfFile& file, Scene& scene, int mesh);

// Vertices without a tangent get one that follows u of the normal map's coordinates.
void make_tangents(std::vector<Vertex>& vertices, const std::vector<uvec3>& triangles, const TextureSlot& normal_slot);

// --- nodes.cpp
// Reads the chosen scene (-1: the file's default): instances with their meshes, lights, cameras.
void read_nodes(GltfFile& file, Scene& scene, int chosen);

}  // namespace ods

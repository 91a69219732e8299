// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the parts of the glTF reader share; only ods/scene/gltf/gltf.cpp and its folder include this.
//   json      the text -> JsonValues; values reads their members
//   source    bytes of the file, its buffers and pictures -> GltfFile
//   accessor  numbers out of buffers
//   material  materials, samplers, textures
//   mesh      primitives -> meshes
//   bend      morph targets and skins of primitives -> deformations
//   nodes     the hierarchy -> instances, lights, view points
//   clips     animations -> clips, and what they move
// Every function here throws Error(kInput) naming the file when the file does not hold what it promises.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ods/scene/gltf/json.h"
#include "ods/scene/gltf/values.h"
#include "ods/scene/placement.h"

namespace ods {

using Bytes = std::span<const unsigned char>;

struct ImageSource {
  std::string uri;  // empty where the picture lies in the buffer view
  int view = -1;
  size_t first = 0;  // the first image with the same source: the one that is read
};

// One thing that an animation of the file moves.
struct ChannelSource {
  int times = -1;  // accessors
  int values = -1;
  std::string interpolation;
  int node = -1;
  std::string path;  // of the node: translation, ...; of KHR_animation_pointer a JSON pointer, which starts with '/'
};

struct ClipSource {
  std::string name;
  std::vector<ChannelSource> channels;
};

// The objects in one of the file's lists.
using Records = std::vector<const JsonValue*>;

// A file being read.
struct GltfFile {
  std::string path;
  std::string confine;  // as SceneOptions
  JsonDocument json;
  Records accessors, buffer_views, cameras, lights, materials, meshes, nodes, samplers, scenes, skins, textures;
  std::vector<Bytes> buffers;
  std::vector<ImageSource> images;
  std::vector<ClipSource> clips;
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

// Element `index` of a list of objects, likewise.
inline const JsonValue& record(const GltfFile& file, const Records& list, int index, const char* what) {
  return *element(file, list, index, what);
}

// Whether the reader makes something of an extension.
bool is_read(std::string_view extension);

// Text of the file as it may stand in a message: one line, not endless.
std::string printable(const std::string& text);

// A part of the file that is not rendered; said once.
void warn(Scene& scene, const std::string& what);

// Takes from the budget, so that a small file cannot ask for gigabytes by naming one accessor a million times.
void spend(GltfFile& file, size_t count);

// --- source.cpp
GltfFile open_gltf(const std::string& path, const std::string& confine);
GltfFile open_gltf_bytes(Bytes bytes, const std::string& path, const std::string& confine);
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

  vec4 at(size_t i) const;  // the first four
  float number_at(size_t i, int component) const;
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

// A material's factors and places of textures one by one, as its animation starts from them.
MovingMaterial read_moving_material(const GltfFile& file, const Scene& scene, int material);

// --- mesh.cpp
// What bends the vertices of a node's mesh: rows of Scene::animation.
struct Deformers {
  int skin = -1;
  int weights = -1;
};

// The Scene meshes that a mesh of the file becomes: one for each primitive that has triangles. Where they bend, each
// has a row in Animation::deformations.
std::vector<int> read_mesh(GltfFile& file, Scene& scene, int mesh, const Deformers& bending);

// Floats of a primitive's attribute; count 0 where it has none. Fails unless there are `count` of them, each of so many
// components or up to 4.
AccessorView read_attribute(GltfFile& file, const JsonValue& attributes, const char* name, int components,
                            size_t count);

// Vertices without a tangent get one that follows u of the normal map's coordinates.
void make_tangents(std::vector<Vertex>& vertices, const std::vector<uvec3>& triangles, const TextureSlot& normal_slot);

// --- bend.cpp
struct PrimitiveSource {
  const JsonValue& attributes;
  const JsonValue& targets;
  size_t vertex_count;             // of the file
  const std::vector<uint>& order;  // which of the file's vertices each of the mesh's is
};

// Whether something bends the primitive.
bool bends(const PrimitiveSource& primitive, const Deformers& bending);

// Appends a row to Animation::deformations for a mesh of the Scene that stands as it is stored.
void read_deformation(GltfFile& file, Scene& scene, const PrimitiveSource& primitive, const Deformers& bending,
                      int mesh, bool flat);

// Appends a row to Animation::skins. rows: of the file's nodes in Animation::nodes.
int read_skin(GltfFile& file, Scene& scene, int skin, const std::vector<int>& rows);

// --- nodes.cpp
// Where the file's things are in the Scene: for what moves them. -1: nowhere.
struct Places {
  struct PlacedLight {
    int light;  // of the Scene
    int source;
    int node;
  };
  std::vector<int> nodes;    // of each node its row in Animation::nodes
  std::vector<int> weights;  // of each node its mesh's row in Animation::weights
  std::vector<PlacedLight> lights;
};

// Reads the chosen scene (-1: the file's default): instances with their meshes, lights, cameras. moves: of each node
// whether an animation or a skin names it.
Places read_nodes(GltfFile& file, Scene& scene, int chosen, const std::vector<char>& moves);

Lamp read_lamp(const GltfFile& file, int light);

// --- clips.cpp
std::vector<char> named_nodes(const GltfFile& file);
void read_clips(GltfFile& file, Scene& scene, const Places& places);

}  // namespace ods

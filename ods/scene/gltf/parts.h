// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The internal interface of the glTF reader; only ods/scene/gltf/gltf.cpp and its folder include this.
//   json      the text -> JsonValues; values reads their members
//   source    the file's bytes, its buffers and pictures -> GltfFile
//   uri       the files that it refers to, in its folder or in its .zip archive
//   meshopt   compressed buffer views -> bytes
//   accessor  numbers from buffers
//   draco     compressed primitives -> numbers
//   material  materials; textures makes what they read
//   mesh      primitives -> meshes
//   bend      morph targets and skins of primitives -> deformations
//   nodes     the hierarchy -> instances, lights, view points (nodes.h)
//   clips     animations -> clips and their targets (nodes.h)
//   losses    data that the program that wrote the file has left out (nodes.h)
// Every function here throws Error(kInput), naming the file, if the file is inconsistent.
#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "ods/files/zip_archive.h"
#include "ods/scene/gltf/accessor.h"
#include "ods/scene/gltf/json.h"
#include "ods/scene/gltf/source.h"
#include "ods/scene/gltf/values.h"
#include "ods/scene/placement.h"

namespace ods {

struct ImageSource {
  std::string uri;   // empty if the picture is in the buffer view
  std::string name;  // the file that it refers to: resolve_uri()
  int view = -1;
  size_t first = 0;  // the first image with the same source, the only one read
};

// One animation channel of the file.
struct ChannelSource {
  int times = -1;  // index of an accessor
  int values = -1;
  std::string interpolation;
  int node = -1;
  std::string path;  // a node's translation, ...; for KHR_animation_pointer a JSON pointer, which starts with '/'
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
  std::string confine;  // as in SceneOptions
  JsonDocument json;
  Records accessors, buffer_views, cameras, image_lights, lights, materials, meshes, nodes, samplers, scenes, skins,
      textures;
  std::shared_ptr<ZipArchive> archive;         // archive that contains the scene; null for a file on the disk
  std::string folder;                          // folder of the scene in the archive
  std::map<std::string, std::string> renamed;  // files whose names differ from their names in the scene
  int searches = 0;                            // for such files
  std::vector<Bytes> buffers;                  // empty if they have no data
  std::vector<ImageSource> images;
  std::vector<ClipSource> clips;
  std::vector<Storage> storage;                 // owns the memory of `buffers`
  std::vector<Storage> decoded_views;           // decoded bytes of each compressed buffer view
  std::map<const JsonValue*, DracoMesh> draco;  // indexed by the attributes of their primitives
  size_t size = 0;                              // bytes of the file and its buffers
  size_t draco_budget = 0;                      // bytes that decoding may still use
  size_t budget = 0;                            // remaining corners and instances, in proportion to the file's size
  std::vector<char> moving_layers;              // per material: whether an animation changes a factor of its layers
  int variant = -1;                             // index of the chosen variant of KHR_materials_variants, or -1
  std::set<const JsonValue*> points, lines;     // primitives of the file that are not read
};

[[noreturn]] void fail(const GltfFile& file, const std::string& what);

// Element `index` of a list; `what` names the list in the error message.
template <class List>
auto& element(const GltfFile& file, List& list, int index, const char* what) {
  if (index < 0 || static_cast<size_t>(index) >= list.size()) {
    fail(file, std::string(what) + " " + std::to_string(index) + " does not exist; the file is damaged");
  }
  return list[static_cast<size_t>(index)];
}

// Element `index` of a list of objects; `what` names the list in the error message.
inline const JsonValue& record(const GltfFile& file, const Records& list, int index, const char* what) {
  return *element(file, list, index, what);
}

// Text from the file, made safe for a message: one line, of limited length.
std::string printable(const std::string& text);

// Adds a warning about an unsupported feature, without duplicates.
void warn(Scene& scene, const std::string& what);

// Deducts from the budget, so that a small file cannot request gigabytes by referring to one accessor a million times.
void spend(GltfFile& file, size_t count);

// --- accessor.cpp
// accessor -1 gives an AccessorView with count 0.
AccessorView open_accessor(GltfFile& file, int accessor);

// --- draco.cpp
// Decode primitives with KHR_draco_mesh_compression into file.draco, in parallel: of all meshes, or of one mesh those
// that are missing. read_mesh() takes them out again.
void decode_meshes(GltfFile& file, Scene& scene);
void decode_mesh(GltfFile& file, int mesh);

// --- material.cpp
// The scene's materials are the file's in order, then one more for primitives without a material.
// Sets file.moving_layers.
void read_materials(GltfFile& file, Scene& scene);

// A material's factors and texture transforms, from which its animation starts.
MovingMaterial read_moving_material(const GltfFile& file, const Scene& scene, int material);

// --- clips.cpp
// For each material of the file, whether an animation changes a factor of its MaterialLayers.
std::vector<char> find_moving_layers(const GltfFile& file);

// --- mesh.cpp
// The deformation of a node's mesh: indices into Scene::animation.
struct Deformers {
  int skin = -1;
  int weights = -1;
};

// Adds a mesh of the file and returns the resulting Scene meshes: one for each primitive that has triangles. If they
// deform, each gets an element in Animation::deformations.
std::vector<int> read_mesh(GltfFile& file, Scene& scene, int mesh, const Deformers& bending);

// The floats of a primitive's attribute, compressed or not; count 0 if it is absent. Fails unless there are `count`
// elements with `components` up to 4 components.
AccessorView read_attribute(GltfFile& file, const JsonValue& attributes, const char* name, int components,
                            size_t count);

// --- bend.cpp
struct PrimitiveSource {
  const JsonValue& attributes;
  const JsonValue& targets;
  size_t vertex_count;             // in the file
  const std::vector<uint>& order;  // for each vertex of the mesh its index in the file
};

// Returns whether the primitive deforms.
bool bends(const PrimitiveSource& primitive, const Deformers& bending);

// Appends to Animation::deformations for a Scene mesh in its stored pose.
void read_deformation(GltfFile& file, Scene& scene, const PrimitiveSource& primitive, const Deformers& bending,
                      int mesh, bool flat);

// Appends to Animation::skins. rows: for each of the file's nodes its index in Animation::nodes.
int read_skin(GltfFile& file, Scene& scene, int skin, const std::vector<int>& rows);

}  // namespace ods

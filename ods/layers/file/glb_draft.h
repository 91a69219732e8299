// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A GLB of layered scenes while it is written: buffer views, accessors and textures. Positions of meshes that are
// compressed are rounded (ods/layers/file/write_layers.h).
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "ods/base/json_reader.h"
#include "ods/base/quote.h"
#include "ods/image/format/file_format.h"
#include "ods/kernel/math.h"
#include "ods/scene/gltf/meshopt.h"

namespace ods {

inline constexpr const char* kMeshopt = "EXT_meshopt_compression";
inline constexpr const char* kWebpTexture = "EXT_texture_webp";
inline constexpr const char* kUnlit = "KHR_materials_unlit";

inline constexpr int kGlbUshort = 5123, kGlbUint = 5125, kGlbFloat = 5126;  // component types

struct Glb {
  bool plain = false;
  Json& json;  // of the whole file
  std::string binary;
  size_t unpacked = 0;  // bytes of the buffer views that are compressed, as if they were not
};

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// Appends bytes at a multiple of 4 and returns their place.
size_t append_aligned(Glb& glb, const std::string& bytes);

// Appends to a list of the JSON and returns the number of the member.
size_t add_to(Json& list, Json value);

// Adds bytes as they are, and returns the number of the buffer view.
size_t add_bytes(Glb& glb, const std::string& bytes);

// Each adds an accessor and returns its number. step: to whose multiples a position is rounded in a file that is not
// plain.
using StepOf = std::function<float(size_t vertex)>;
size_t add_positions(Glb& glb, const std::vector<vec3>& positions, const StepOf& step);
size_t add_uvs(Glb& glb, const std::vector<vec2>& uvs);
size_t add_indices(Glb& glb, const MeshOrder& order);
size_t add_floats(Glb& glb, const std::vector<float>& values, const char* type, size_t components);

// Adds an image and a texture of it, and returns the number of the texture.
size_t add_texture(Glb& glb, const std::string& name, FileFormat format, const std::string& bytes);

// The unlit material of a texture.
Json unlit_material(const std::string& name, size_t texture);

}  // namespace ods

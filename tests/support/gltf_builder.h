// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Small glTF files for tests, made in memory.
#pragma once
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "ods/scene/gltf/gltf.h"

namespace ods {

using GltfJson = nlohmann::json;
using Binary = std::vector<unsigned char>;

// Component types of glTF.
enum { kByte = 5120, kUbyte = 5121, kShort = 5122, kUshort = 5123, kUint = 5125, kFloat = 5126 };

struct GltfBuilder {
  GltfJson json;
  Binary binary;

  // Appends values to the binary with a buffer view of their own, and an accessor on it; returns the accessor. The
  // buffer view has the same number.
  template <class T>
  int add(const std::vector<T>& values, int component_type, const std::string& type) {
    Binary bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return add_bytes(bytes, values.size(), component_type, type);
  }
  int add_bytes(const Binary& bytes, size_t values, int component_type, const std::string& type);

  // A buffer view without an accessor.
  int add_view(const Binary& bytes);

  GltfJson& primitive() { return json["meshes"][0]["primitives"][0]; }
  GltfJson& node(size_t i) { return json["nodes"][i]; }

  Binary glb() const;
  Scene load(const SceneOptions& options = {}) const;  // fails the test if the Scene violates a guarantee
};

// One mesh on node 0 of scene 0: the triangle (0,0,0) (1,0,0) (0,1,0), accessor 0, and nothing else.
GltfBuilder make_triangle();

// A whole GLB of these two chunks.
Binary make_glb(const std::string& text, const Binary& binary);

// A 2x2 PNG: (255,128,0,255) everywhere.
Binary small_png();

// The bytes with `flips` random bits flipped.
Binary flip_bits(Binary bytes, int flips, std::mt19937& random);

// The error of load_gltf_bytes() for these bytes. Empty if it accepts them.
std::string error_of(const Binary& bytes);

}  // namespace ods

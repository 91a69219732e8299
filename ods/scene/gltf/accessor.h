// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers of a glTF file, either in a buffer or decompressed.
#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

using Bytes = std::span<const unsigned char>;
using Storage = std::shared_ptr<const std::vector<unsigned char>>;

// One accessor, checked to lie inside its buffer. at(i) is element i as floats (normalized integers mapped as the
// specification says); missing components are 0, w is 1.
struct AccessorView {
  size_t count = 0;
  int components = 0;

  vec4 at(size_t i) const;  // the first four components
  float number_at(size_t i, int component) const;
  uint index_at(size_t i) const;

  const unsigned char* data = nullptr;
  size_t stride = 0;
  int component_type = 0;
  bool normalized = false;
  Storage expanded;  // owns the memory of `data` if it is not in a buffer: sparse or compressed
};

// The decoded mesh of a compressed primitive.
struct DracoMesh {
  std::vector<uint> corners;  // three for each triangle, for every primitive mode
  size_t vertex_count = 0;
  std::map<std::string, AccessorView> attributes;  // by their names in glTF
};

}  // namespace ods

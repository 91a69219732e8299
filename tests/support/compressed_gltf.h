// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Compresses glTF files for tests, with the encoders of the libraries that decode them.
#pragma once
#include <map>
#include <string>

#include "tests/support/gltf_builder.h"

namespace ods {

// A bumpy grid of size x size quads: positions, normals, texture coordinates, colours (normalized bytes), indices.
// Accessors 0 to 4 in this order.
GltfBuilder make_grid(int size);

struct DracoChoice {
  bool edgebreaker = false;  // reorders vertices and triangles; else their order is kept
  int bits = 0;              // per quantized float; 0 for exact floats
  int speed = 5;             // 0 for all of Draco's predictors, 10 for none
};

// The Draco stream of a primitive. ids: of its attributes, numbered in order.
Binary draco_stream(const GltfBuilder& file, const GltfJson& primitive, const DracoChoice& choice, GltfJson* ids);

// Compresses a primitive. keep: its accessors also keep their plain data (the extension is optional).
void compress_draco(GltfBuilder& file, GltfJson& primitive, const DracoChoice& choice = {}, bool keep = false);

// Replaces the buffer view of an accessor by a compressed one. filter: of attributes, whose bytes are encoded
// unchanged, because they are already filtered.
void compress_meshopt(GltfBuilder& file, int view, const std::string& mode, size_t stride,
                      const std::string& filter = "NONE", const std::string& name = "EXT_meshopt_compression");

// A .zip archive of these files.
Binary make_zip(const std::map<std::string, Binary>& files);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Compresses meshes for EXT_meshopt_compression: the streams of its modes ATTRIBUTES and TRIANGLES.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

// A mesh in the order that graphics cards draw fastest and that compresses best.
struct MeshOrder {
  std::vector<uint> vertices;  // the old index of each new vertex; vertices without a triangle are left out
  std::vector<uint> corners;   // new indices, three for each triangle
};

// Precondition: there is a triangle; every corner < vertex_count.
MeshOrder drawing_order(std::span<const uvec3> triangles, size_t vertex_count);

// Precondition: stride is a multiple of 4, at most 256; the vertices are whole.
std::string compress_vertices(std::span<const std::byte> vertices, size_t stride);

// The decoder may start a triangle at another of its corners. Precondition: every corner < vertex_count.
std::string compress_triangles(std::span<const uint> corners, size_t vertex_count);

// A number as the filter EXPONENTIAL stores it: mantissa * 2^exponent. Precondition: |mantissa| < 2^23,
// -100 <= exponent <= 100.
uint32_t exponential_bits(int mantissa, int exponent);

}  // namespace ods

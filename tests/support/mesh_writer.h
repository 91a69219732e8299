// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A writer of Google's mesh projection, based on the specification, not on our reader.
#pragma once
#include <libdeflate.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ods/base/checksum.h"
#include "ods/kernel/math.h"
#include "tests/support/made_videos.h"

namespace ods {

class BitWriter {
 public:
  void put(uint64_t value, int bits) {
    for (int i = bits - 1; i >= 0; i--) {
      if (count_ % 8 == 0) bytes_ += '\0';
      if ((value >> i & 1) != 0) bytes_.back() = static_cast<char>(bytes_.back() | (0x80 >> count_ % 8));
      count_++;
    }
  }
  void align() { count_ = (count_ + 7) / 8 * 8; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  size_t count_ = 0;
};

inline uint64_t zigzag(int64_t n) {
  return n >= 0 ? static_cast<uint64_t>(2 * n) : static_cast<uint64_t>(-2 * n - 1);
}

inline int bits_for(size_t count) {
  return static_cast<int>(std::ceil(std::log2(2.0 * static_cast<double>(count))));
}

struct List {
  int texture = 0;
  int type = 0;
  std::vector<uint32_t> indices;
};

// u and v as in OpenGL, from the lower left corner.
struct GlVertex {
  float x, y, z, u, v;
};

inline std::string mesh_body(const std::vector<GlVertex>& vertices, const std::vector<List>& lists) {
  std::vector<float> coordinates;
  std::map<uint32_t, size_t> known;  // by their bits
  const auto index_of = [&](float value) {
    const auto [found, is_new] = known.emplace(std::bit_cast<uint32_t>(value), coordinates.size());
    if (is_new) coordinates.push_back(value);
    return static_cast<int64_t>(found->second);
  };
  std::vector<std::array<int64_t, 5>> parts;
  for (const GlVertex& vertex : vertices) {
    parts.push_back(
        {index_of(vertex.x), index_of(vertex.y), index_of(vertex.z), index_of(vertex.u), index_of(vertex.v)});
  }
  BitWriter out;
  out.put(coordinates.size(), 32);
  for (const float value : coordinates) out.put(std::bit_cast<uint32_t>(value), 32);
  out.put(vertices.size(), 32);
  std::array<int64_t, 5> last{};
  for (const auto& part : parts) {
    for (size_t i = 0; i < 5; i++) out.put(zigzag(part[i] - last[i]), bits_for(coordinates.size()));
    last = part;
  }
  out.align();
  out.put(lists.size(), 32);
  for (const List& list : lists) {
    out.put(static_cast<uint64_t>(list.texture), 8);
    out.put(static_cast<uint64_t>(list.type), 8);
    out.put(list.indices.size(), 32);
    int64_t before = 0;
    for (const uint32_t index : list.indices) {
      out.put(zigzag(int64_t{index} - before), bits_for(vertices.size()));
      before = index;
    }
    out.align();
  }
  return out.bytes();
}

inline std::string deflated(const std::string& bytes) {
  libdeflate_compressor* const state = libdeflate_alloc_compressor(6);
  std::string packed(libdeflate_deflate_compress_bound(state, bytes.size()), '\0');
  packed.resize(libdeflate_deflate_compress(state, bytes.data(), bytes.size(), packed.data(), packed.size()));
  libdeflate_free_compressor(state);
  return packed;
}

inline std::string box_body(const std::vector<std::string>& meshes, bool packs) {
  std::string boxes;
  for (const std::string& mesh : meshes) boxes += made::box("mesh", mesh);
  const std::string rest = packs ? "dfl8" + deflated(boxes) : "raw " + boxes;
  return made::number(0, 4) + made::number(crc32(rest), 4) + rest;
}

// A grid over a fisheye of 180 degrees that fills the eye's picture, as in "VR180 Video Format". `u0`, `u1`: its range
// in the frame.
inline std::string fisheye_mesh(int grid, float u0 = 0.0f, float u1 = 1.0f, float v0 = 0.0f, float v1 = 1.0f) {
  std::vector<GlVertex> vertices;
  for (int row = 0; row < grid; row++) {
    const float y = 2.0f * static_cast<float>(row) / static_cast<float>(grid - 1) - 1.0f;
    const float reach = std::sqrt(std::max(0.0f, 1.0f - y * y));
    for (int column = 0; column < grid; column++) {
      const float x = reach * (2.0f * static_cast<float>(column) / static_cast<float>(grid - 1) - 1.0f);
      const float r = std::hypot(x, y), angle = 0.5f * kPi * r, out = r > 0.0f ? std::sin(angle) / r : 0.0f;
      vertices.push_back(
          {x * out, y * out, -std::cos(angle), u0 + (u1 - u0) * (0.5f + 0.5f * x), v0 + (v1 - v0) * (0.5f + 0.5f * y)});
    }
  }
  List list;
  for (int row = 0; row + 1 < grid; row++) {
    for (int column = 0; column + 1 < grid; column++) {
      const auto at = [&](int r, int c) { return static_cast<uint32_t>((row + r) * grid + column + c); };
      for (const uint32_t index : {at(0, 0), at(0, 1), at(1, 0), at(1, 0), at(0, 1), at(1, 1)})
        list.indices.push_back(index);
    }
  }
  return mesh_body(vertices, {list});
}

}  // namespace ods

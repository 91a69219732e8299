// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/mesh_box.h"

#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "ods/base/bytes.h"

namespace ods {

constexpr size_t kMaxVertices = 200000;
constexpr size_t kMaxIndices = 1200000;
constexpr size_t kMaxBytes = size_t{64} << 20;  // unpacked

// The unpacked size is known only after unpacking.
static std::string inflated(std::string_view packed) {
  libdeflate_decompressor* const state = libdeflate_alloc_decompressor();
  std::string bytes;
  size_t size = 0;
  libdeflate_result result = LIBDEFLATE_INSUFFICIENT_SPACE;
  for (size_t room = 1 << 18; room <= kMaxBytes && result == LIBDEFLATE_INSUFFICIENT_SPACE; room *= 4) {
    bytes.resize(room);
    result = libdeflate_deflate_decompress(state, packed.data(), packed.size(), bytes.data(), room, &size);
  }
  libdeflate_free_decompressor(state);
  if (result != LIBDEFLATE_SUCCESS) throw MalformedFile("its mesh cannot be unpacked");
  bytes.resize(size);
  return bytes;
}

namespace {

// Reads numbers with any number of bits, most significant bit first.
class Bits {
 public:
  explicit Bits(std::string_view bytes) : bytes_(bytes) {}

  uint32_t next(int count) {
    if (static_cast<size_t>(count) > 8 * bytes_.size() - at_) throw MalformedFile("its mesh is cut short");
    uint64_t value = 0;
    for (int i = 0; i < count; i++, at_++) {
      value = value << 1 | (static_cast<unsigned char>(bytes_[at_ / 8]) >> (7 - at_ % 8) & 1u);
    }
    return static_cast<uint32_t>(value);
  }
  void align() { at_ = (at_ + 7) / 8 * 8; }
  size_t left() const { return 8 * bytes_.size() - at_; }

 private:
  std::string_view bytes_;
  size_t at_ = 0;  // bits
};

// Decodes an index as its difference from the previous one: 0, -1, 1, -2 .. are stored as 0, 1, 2, 3 ..
class Indices {
 public:
  // Indices below `count`, which is at least 1.
  explicit Indices(size_t count) : count_(count), bits_(static_cast<int>(std::bit_width(2 * count - 1))) {}

  size_t next(Bits& bits) {
    const uint32_t code = bits.next(bits_);
    last_ += code % 2 == 0 ? int64_t{code / 2} : -int64_t{code / 2} - 1;
    if (last_ < 0 || last_ >= static_cast<int64_t>(count_)) throw MalformedFile("its mesh has an index of nothing");
    return static_cast<size_t>(last_);
  }
  int bits() const { return bits_; }

 private:
  size_t count_;
  int bits_;
  int64_t last_ = 0;
};

enum IndexType : uint32_t { kTriangles, kStrip, kFan };

}  // namespace

static std::vector<float> read_coordinates(Bits& bits) {
  const size_t count = bits.next(32);
  if (count == 0 || count > bits.left() / 32) throw MalformedFile("its mesh has no numbers or fewer than it claims");
  std::vector<float> coordinates(count);
  for (float& each : coordinates) {
    each = std::bit_cast<float>(bits.next(32));
    if (!std::isfinite(each)) throw MalformedFile("its mesh has numbers that are NaN or infinite");
  }
  return coordinates;
}

static void read_vertices(Bits& bits, const std::vector<float>& coordinates, TextureMesh& mesh) {
  const size_t count = bits.next(32);
  if (count == 0 || count > kMaxVertices) throw MalformedFile("its mesh has no vertices or more than 200000");
  std::vector<Indices> parts(5, Indices(coordinates.size()));  // x, y, z, u and v
  if (count > bits.left() / static_cast<size_t>(5 * parts[0].bits())) throw MalformedFile("its mesh is cut short");
  for (size_t i = 0; i < count; i++) {
    float numbers[5];
    for (size_t k = 0; k < 5; k++) numbers[k] = coordinates[parts[k].next(bits)];
    mesh.vertices.push_back({vec3(numbers[0], numbers[1], numbers[2]), vec2(numbers[3], 1.0f - numbers[4])});
  }
  bits.align();
}

static void add_triangles(const std::vector<uint32_t>& indices, uint32_t type, TextureMesh& mesh) {
  const auto add = [&](size_t a, size_t b, size_t c) {
    mesh.triangles.push_back({indices[a], indices[b], indices[c]});
  };
  if (type > kFan) throw MalformedFile("its mesh has an unknown primitive type");
  for (size_t i = 2; i < indices.size(); i++) {
    if (type == kTriangles && i % 3 == 2) add(i - 2, i - 1, i);
    if (type == kStrip) add(i - 2, i - 1, i);
    if (type == kFan) add(0, i - 1, i);
  }
}

static void read_lists(Bits& bits, TextureMesh& mesh) {
  const size_t lists = bits.next(32);
  size_t all = 0;
  for (size_t list = 0; list < lists; list++) {
    const uint32_t texture = bits.next(8), type = bits.next(8);
    const size_t count = bits.next(32);
    Indices index(mesh.vertices.size());
    all += count;
    if (all > kMaxIndices || count > bits.left() / static_cast<size_t>(index.bits())) {
      throw MalformedFile("its mesh has more triangles than vertices can make, or is cut short");
    }
    std::vector<uint32_t> indices;
    for (size_t i = 0; i < count; i++) indices.push_back(static_cast<uint32_t>(index.next(bits)));
    bits.align();
    if (texture == 0) add_triangles(indices, type, mesh);
  }
}

static TextureMesh read_mesh(std::string_view body) {
  Bits bits(body);
  TextureMesh mesh;
  const std::vector<float> coordinates = read_coordinates(bits);
  read_vertices(bits, coordinates, mesh);
  read_lists(bits, mesh);
  if (const std::string fault = mesh_fault(mesh); !fault.empty()) throw MalformedFile(fault);
  return mesh;
}

ProjectionMeshes parse_mesh_box(std::string_view body) {
  constexpr uint64_t kRaw = 0x72617720, kDeflate = 0x64666c38;  // "raw ", "dfl8"
  const uint64_t checksum = get_number(body, 4, 4), encoding = get_number(body, 8, 4);
  ProjectionMeshes meshes;
  const std::string_view summed = body.substr(8), packed = body.substr(12);
  meshes.fits_checksum = libdeflate_crc32(0, summed.data(), summed.size()) == checksum;
  if (encoding != kRaw && encoding != kDeflate) throw MalformedFile("its mesh has an unknown encoding");
  std::string tail;
  for (const Box& box : parse_boxes(encoding == kRaw ? std::string(packed) : inflated(packed), tail)) {
    if (box.type == box_type("mesh") && meshes.eyes.size() < 2) meshes.eyes.push_back(read_mesh(box.body));
  }
  if (meshes.eyes.empty()) throw MalformedFile("its projection is a mesh, but the mesh is missing");
  return meshes;
}

// --- eyes ------------------------------------------------------------------------------------------------------------

// Returns whether all image positions of a mesh are in this half: their coordinate, times 2, is within `from` and from
// + 1.
static bool is_in_half(const TextureMesh& mesh, int coordinate, float from) {
  const float kNear = 0.02f;  // circles may extend slightly beyond
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const TextureMesh::Vertex& vertex) {
    const float at = 2.0f * vertex.uv[coordinate] - from;
    return at >= -kNear && at <= 1.0f + kNear;
  });
}

static TextureMesh of_half(TextureMesh mesh, int coordinate, float from) {
  for (TextureMesh::Vertex& vertex : mesh.vertices) vertex.uv[coordinate] = 2.0f * vertex.uv[coordinate] - from;
  return mesh;
}

static MeshedEyes custom_eyes(const ProjectionMeshes& meshes) {
  if (meshes.eyes.size() != 2) throw MalformedFile("its stereo is that of a mesh for each eye, and it has one mesh");
  const TextureMesh &left = meshes.eyes[0], &right = meshes.eyes[1];
  for (const int coordinate : {0, 1}) {
    for (const bool right_first : {false, true}) {
      const float from = right_first ? 1.0f : 0.0f;
      if (!is_in_half(left, coordinate, from) || !is_in_half(right, coordinate, 1.0f - from)) continue;
      const EyePacking how = coordinate == 0 ? EyePacking::kBeside : EyePacking::kStacked;
      return {*layout_with({how, right_first}),
              {of_half(left, coordinate, from), of_half(right, coordinate, 1.0f - from)}};
    }
  }
  throw MalformedFile("its meshes show each eye from more than one half of the frame");
}

MeshedEyes eyes_of_meshes(const ProjectionMeshes& meshes, VideoStereo stereo) {
  if (stereo == VideoStereo::kCustom) return custom_eyes(meshes);
  if (stereo == VideoStereo::kOneView) return {Layout::kSeparate, {meshes.eyes.front()}};
  if (!arrangement_of(stereo).is_halves()) throw MalformedFile("its eyes do not share the frame in halves");
  return {*layout_with(arrangement_of(stereo)), {meshes.eyes.front(), meshes.eyes.back()}};
}

}  // namespace ods

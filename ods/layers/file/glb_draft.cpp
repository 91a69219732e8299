// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Sources: the glTF 2.0 specification; EXT_meshopt_compression and EXT_texture_webp in its registry of extensions.
#include "ods/layers/file/glb_draft.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

namespace ods {

namespace {

enum { kArrayBuffer = 34962, kElementArrayBuffer = 34963 };  // targets

// The numbers of an accessor.
struct Stream {
  int component_type;
  const char* type;
  size_t count;
  size_t stride;              // bytes of an element
  std::string bytes;          // as the accessor has them
  std::string packed;         // compressed; empty in a plain file
  const char* filter;         // of the compression, or nullptr
  bool is_triangles = false;  // three indices each
};

// Returns the number of the buffer view.
size_t add_view(Glb& glb, const Stream& stream) {
  Json view = {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", stream.bytes.size()}};
  if (!stream.is_triangles) view["byteStride"] = stream.stride;
  view["target"] = stream.is_triangles ? kElementArrayBuffer : kArrayBuffer;
  if (glb.plain) {
    view["byteOffset"] = append_aligned(glb, stream.bytes);
    return add_to(glb.json["bufferViews"], view);
  }
  view["buffer"] = 1;
  view["byteOffset"] = glb.unpacked;
  glb.unpacked += (stream.bytes.size() + 3) / 4 * 4;
  Json source = {{"buffer", 0},
                 {"byteOffset", append_aligned(glb, stream.packed)},
                 {"byteLength", stream.packed.size()},
                 {"byteStride", stream.stride},
                 {"count", stream.count},
                 {"mode", stream.is_triangles ? "TRIANGLES" : "ATTRIBUTES"}};
  if (stream.filter) source["filter"] = stream.filter;
  view["extensions"][kMeshopt] = source;
  return add_to(glb.json["bufferViews"], view);
}

// Returns the accessor's JSON, without limits.
Json accessor_of(Glb& glb, const Stream& stream) {
  return {{"bufferView", add_view(glb, stream)},
          {"componentType", stream.component_type},
          {"count", stream.count},
          {"type", stream.type}};
}

std::string packed_vertices(const std::string& bytes, size_t stride) {
  return compress_vertices(std::as_bytes(std::span(bytes)), stride);
}

}  // namespace

size_t append_aligned(Glb& glb, const std::string& bytes) {
  glb.binary.resize((glb.binary.size() + 3) / 4 * 4);
  const size_t at = glb.binary.size();
  glb.binary += bytes;
  return at;
}

size_t add_to(Json& list, Json value) {
  list.push_back(std::move(value));
  return list.size() - 1;
}

size_t add_bytes(Glb& glb, const std::string& bytes) {
  return add_to(glb.json["bufferViews"],
                {{"buffer", 0}, {"byteOffset", append_aligned(glb, bytes)}, {"byteLength", bytes.size()}});
}

size_t add_positions(Glb& glb, const std::vector<vec3>& exact, const StepOf& step) {
  constexpr float kMost = std::numeric_limits<float>::max();
  vec3 low(kMost), high(-kMost);
  std::vector<vec3> positions;
  std::vector<uint32_t> filtered;
  for (size_t vertex = 0; vertex < exact.size(); vertex++) {
    vec3 position = exact[vertex];
    if (!glb.plain) {
      const int exponent = static_cast<int>(std::floor(std::log2(step(vertex))));
      for (int k = 0; k < 3; k++) {
        const int mantissa = static_cast<int>(std::lround(std::ldexp(position[k], -exponent)));
        position[k] = static_cast<float>(std::ldexp(mantissa, exponent));
        filtered.push_back(exponential_bits(mantissa, exponent));
      }
    }
    low = min(low, position), high = max(high, position);
    positions.push_back(position);
  }
  const std::string packed = glb.plain ? "" : packed_vertices(bytes_of(filtered), sizeof(vec3));
  Json accessor =
      accessor_of(glb, {kGlbFloat, "VEC3", positions.size(), sizeof(vec3), bytes_of(positions), packed, "EXPONENTIAL"});
  accessor["min"] = {low.x, low.y, low.z};
  accessor["max"] = {high.x, high.y, high.z};
  return add_to(glb.json["accessors"], accessor);
}

size_t add_uvs(Glb& glb, const std::vector<vec2>& exact) {
  std::vector<uint16_t> uvs;
  for (const vec2& uv : exact) {
    for (int k = 0; k < 2; k++) {
      uvs.push_back(static_cast<uint16_t>(std::lround(65535.0f * std::clamp(uv[k], 0.0f, 1.0f))));
    }
  }
  constexpr size_t kStride = 2 * sizeof(uint16_t);
  const std::string bytes = bytes_of(uvs), packed = glb.plain ? "" : packed_vertices(bytes, kStride);
  Json accessor = accessor_of(glb, {kGlbUshort, "VEC2", exact.size(), kStride, bytes, packed, nullptr});
  accessor["normalized"] = true;
  return add_to(glb.json["accessors"], accessor);
}

size_t add_indices(Glb& glb, const MeshOrder& order) {
  const std::string packed = glb.plain ? "" : compress_triangles(order.corners, order.vertices.size());
  const bool is_short = order.vertices.size() <= 65535;  // 65535 itself would restart a strip
  const std::string bytes =
      is_short ? bytes_of(std::vector<uint16_t>(order.corners.begin(), order.corners.end())) : bytes_of(order.corners);
  const size_t stride = is_short ? sizeof(uint16_t) : sizeof(uint);
  return add_to(glb.json["accessors"], accessor_of(glb, {is_short ? kGlbUshort : kGlbUint, "SCALAR",
                                                         order.corners.size(), stride, bytes, packed, nullptr, true}));
}

size_t add_floats(Glb& glb, const std::vector<float>& values, const char* type, size_t components) {
  Json accessor = {{"bufferView", add_bytes(glb, bytes_of(values))},
                   {"componentType", kGlbFloat},
                   {"count", values.size() / components},
                   {"type", type}};
  if (components == 1) {
    const auto [low, high] = std::ranges::minmax(values);
    accessor["min"] = {low};
    accessor["max"] = {high};
  }
  return add_to(glb.json["accessors"], accessor);
}

size_t add_texture(Glb& glb, const std::string& name, FileFormat format, const std::string& bytes) {
  const char* type = format == FileFormat::kWebp  ? "image/webp"
                     : format == FileFormat::kPng ? "image/png"
                                                  : "image/jpeg";
  const size_t image =
      add_to(glb.json["images"], {{"name", name}, {"bufferView", add_bytes(glb, bytes)}, {"mimeType", type}});
  Json texture = {{"sampler", 0}};
  if (format == FileFormat::kWebp) {
    texture["extensions"][kWebpTexture] = {{"source", image}};
  } else {
    texture["source"] = image;
  }
  return add_to(glb.json["textures"], texture);
}

Json unlit_material(const std::string& name, size_t texture) {
  Json material = {{"name", name},
                   {"pbrMetallicRoughness",
                    {{"baseColorTexture", {{"index", texture}}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}};
  material["extensions"][kUnlit] = Json::object();
  return material;
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Sources: the glTF 2.0 specification; EXT_meshopt_compression and EXT_texture_webp in its registry of extensions.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "ods/base/angles.h"
#include "ods/base/quote.h"
#include "ods/layers/file/layer_parts.h"
#include "ods/layers/file/layers_info.h"
#include "ods/scene/gltf/glb_bytes.h"
#include "ods/scene/gltf/meshopt.h"

namespace ods {

namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr const char* kWebpTexture = "EXT_texture_webp";
constexpr const char* kUnlit = "KHR_materials_unlit";

enum { kUshort = 5123, kUint = 5125, kFloat = 5126 };        // component types of glTF
enum { kArrayBuffer = 34962, kElementArrayBuffer = 34963 };  // targets

struct Glb {
  bool plain = false;
  Json json;
  std::string binary;
  size_t unpacked = 0;  // bytes of the buffer views that are compressed, as if they were not
};

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

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// Appends bytes at a multiple of 4 and returns their place.
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

// --- meshes

std::string packed_vertices(const std::string& bytes, size_t stride) {
  return compress_vertices(std::as_bytes(std::span(bytes)), stride);
}

size_t add_positions(Glb& glb, const LayeredScene& scene, const LayerMesh& mesh, const std::vector<uint>& vertices) {
  constexpr float kMost = std::numeric_limits<float>::max();
  vec3 low(kMost), high(-kMost);
  std::vector<vec3> positions;
  std::vector<uint32_t> filtered;
  for (const uint vertex : vertices) {
    vec3 position = stored_position(scene, mesh, vertex);
    if (!glb.plain) {
      const int exponent = static_cast<int>(std::floor(std::log2(rounding_step(scene, mesh, position))));
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
      accessor_of(glb, {kFloat, "VEC3", positions.size(), sizeof(vec3), bytes_of(positions), packed, "EXPONENTIAL"});
  accessor["min"] = {low.x, low.y, low.z};
  accessor["max"] = {high.x, high.y, high.z};
  return add_to(glb.json["accessors"], accessor);
}

size_t add_uvs(Glb& glb, const LayerMesh& mesh, const std::vector<uint>& vertices) {
  std::vector<uint16_t> uvs;
  for (const uint vertex : vertices) {
    for (int k = 0; k < 2; k++) {
      uvs.push_back(static_cast<uint16_t>(std::lround(65535.0f * std::clamp(mesh.uvs[vertex][k], 0.0f, 1.0f))));
    }
  }
  constexpr size_t kStride = 2 * sizeof(uint16_t);
  const std::string bytes = bytes_of(uvs), packed = glb.plain ? "" : packed_vertices(bytes, kStride);
  Json accessor = accessor_of(glb, {kUshort, "VEC2", vertices.size(), kStride, bytes, packed, nullptr});
  accessor["normalized"] = true;
  return add_to(glb.json["accessors"], accessor);
}

size_t add_indices(Glb& glb, const MeshOrder& order) {
  const std::string packed = glb.plain ? "" : compress_triangles(order.corners, order.vertices.size());
  const bool is_short = order.vertices.size() <= 65535;  // 65535 itself would restart a strip
  const std::string bytes =
      is_short ? bytes_of(std::vector<uint16_t>(order.corners.begin(), order.corners.end())) : bytes_of(order.corners);
  const size_t stride = is_short ? sizeof(uint16_t) : sizeof(uint);
  return add_to(glb.json["accessors"], accessor_of(glb, {is_short ? kUshort : kUint, "SCALAR", order.corners.size(),
                                                         stride, bytes, packed, nullptr, true}));
}

// --- materials

void add_material(Glb& glb, const LayerPart& part) {
  const char* type = part.format == FileFormat::kWebp  ? "image/webp"
                     : part.format == FileFormat::kPng ? "image/png"
                                                       : "image/jpeg";
  const size_t view =
      add_to(glb.json["bufferViews"],
             {{"buffer", 0}, {"byteOffset", append_aligned(glb, part.texture)}, {"byteLength", part.texture.size()}});
  const size_t image = add_to(glb.json["images"], {{"name", part.name}, {"bufferView", view}, {"mimeType", type}});
  Json texture = {{"sampler", 0}};
  if (part.format == FileFormat::kWebp) {
    texture["extensions"][kWebpTexture] = {{"source", image}};
  } else {
    texture["source"] = image;
  }
  Json material = {{"name", part.name},
                   {"pbrMetallicRoughness",
                    {{"baseColorTexture", {{"index", add_to(glb.json["textures"], texture)}}},
                     {"metallicFactor", 0},
                     {"roughnessFactor", 1}}}};
  if (part.mesh->kind == LayerKind::kMasked) material["alphaMode"] = "MASK", material["alphaCutoff"] = 0.5;
  if (part.mesh->kind == LayerKind::kBlended) material["alphaMode"] = "BLEND";
  material["extensions"][kUnlit] = Json::object();
  glb.json["materials"].push_back(material);
}

// The mesh, its material of the same number, and its node.
void add_part(Glb& glb, const LayeredScene& scene, const LayerPart& part) {
  const LayerMesh& mesh = *part.mesh;
  const MeshOrder order = order_of(mesh);
  Json primitive;
  primitive["attributes"]["POSITION"] = add_positions(glb, scene, mesh, order.vertices);
  primitive["attributes"]["TEXCOORD_0"] = add_uvs(glb, mesh, order.vertices);
  primitive["indices"] = add_indices(glb, order);
  primitive["material"] = glb.json["materials"].size();
  add_material(glb, part);
  Json node = {{"name", part.name}, {"mesh", glb.json["meshes"].size()}};
  glb.json["meshes"].push_back({{"name", part.name}, {"primitives", {primitive}}});
  if (mesh.kind == LayerKind::kSky) {
    const float scale = sky_scale(scene);
    node["scale"] = {scale, scale, scale};
    node["extras"]["omnistereo"]["sky"] = true;
  }
  glb.json["nodes"].push_back(node);
}

// Returns the number of the buffer view with the light of the probes; none if there are no probes.
std::optional<size_t> add_probes(Glb& glb, const LightProbes& probes) {
  if (probes.probes.empty()) return {};
  static_assert(sizeof(LightProbe) == 28 * sizeof(float));
  const std::string bytes = bytes_of(probes.probes);
  return add_to(glb.json["bufferViews"],
                {{"buffer", 0}, {"byteOffset", append_aligned(glb, bytes)}, {"byteLength", bytes.size()}});
}

void add_camera(Glb& glb, const LayeredScene& scene) {
  constexpr double kFieldOfView = 70.0 * kDegree, kNear = 0.02;
  glb.json["cameras"] = {
      {{"name", "middle of the box"},
       {"type", "perspective"},
       {"perspective", {{"yfov", kFieldOfView}, {"znear", kNear}, {"zfar", 2.0f * farthest(scene)}}}}};
  const double half = -0.5 * scene.yaw * kDegree;  // glTF turns to the left
  glb.json["nodes"].push_back(
      {{"name", "middle of the box"}, {"camera", 0}, {"rotation", {0.0, std::sin(half), 0.0, std::cos(half)}}});
}

void add_extensions(Glb& glb, const std::vector<LayerPart>& parts) {
  Json used = {kUnlit}, required = Json::array();
  if (!glb.plain) required.push_back(kMeshopt);
  if (std::ranges::any_of(parts, [](const LayerPart& part) { return part.format == FileFormat::kWebp; })) {
    required.push_back(kWebpTexture);
  }
  used.insert(used.end(), required.begin(), required.end());
  glb.json["extensionsUsed"] = used;
  if (!required.empty()) glb.json["extensionsRequired"] = required;
}

}  // namespace

std::string layers_glb(const LayeredScene& scene, const std::vector<LayerPart>& parts, bool plain,
                       const std::string& path) {
  Glb glb{plain, {}, {}, 0};
  glb.json["asset"] = {{"version", "2.0"}, {"generator", "ods " ODS_VERSION}};
  add_extensions(glb, parts);
  glb.json["scene"] = 0;
  glb.json["scenes"] = {{{"name", "layers"}, {"nodes", {0}}}};
  const vec3 center = scene.box.center;
  glb.json["nodes"] = {{{"name", "layers"}, {"translation", {center.x, center.y, center.z}}}};
  for (const LayerPart& part : parts) add_part(glb, scene, part);
  glb.json["asset"]["extras"]["omnistereo"] = layers_metadata(scene, add_probes(glb, scene.light.probes));
  add_camera(glb, scene);
  for (size_t i = 1; i < glb.json["nodes"].size(); i++) glb.json["nodes"][0]["children"].push_back(i);
  if (!parts.empty()) {
    glb.json["samplers"] = {{{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33071}}};
  }
  if (!glb.binary.empty()) glb.json["buffers"] = {{{"byteLength", glb.binary.size()}}};
  if (glb.unpacked > 0) {
    Json fallback = {{"byteLength", glb.unpacked}};
    fallback["extensions"][kMeshopt] = {{"fallback", true}};
    glb.json["buffers"].push_back(fallback);
  }
  return glb_bytes(json_document(glb.json), glb.binary, path, "a lower `quality` or width needs less");
}

}  // namespace ods

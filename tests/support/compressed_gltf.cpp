// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/compressed_gltf.h"

#include <draco/compression/expert_encode.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <zip.h>

#include <cmath>

namespace ods {

GltfBuilder make_grid(int size) {
  GltfBuilder file = make_triangle();
  file.binary.clear();
  file.json["accessors"] = file.json["bufferViews"] = GltfJson::array();
  std::vector<float> positions, normals, uvs;
  std::vector<uint8_t> colors;
  std::vector<uint32_t> corners;
  for (int j = 0; j <= size; j++) {
    for (int i = 0; i <= size; i++) {
      const auto x = float(i), z = float(j);
      positions.insert(positions.end(), {x, std::sin(0.3f * x) * std::cos(0.2f * z), z});
      const float nx = 0.1f * std::cos(x), nz = 0.1f * std::sin(z), length = std::sqrt(1.0f + nx * nx + nz * nz);
      normals.insert(normals.end(), {nx / length, 1.0f / length, nz / length});
      uvs.insert(uvs.end(), {x / float(size), z / float(size)});
      colors.insert(colors.end(), {uint8_t(i * 7), uint8_t(j * 5), 128, 255});
    }
  }
  for (int j = 0; j < size; j++) {
    for (int i = 0; i < size; i++) {
      const auto a = uint32_t(j * (size + 1) + i), b = a + 1, c = a + uint32_t(size) + 1, d = c + 1;
      corners.insert(corners.end(), {a, c, b, b, c, d});
    }
  }
  GltfJson& primitive = file.primitive();
  primitive["attributes"] = {{"POSITION", file.add(positions, kFloat, "VEC3")},
                             {"NORMAL", file.add(normals, kFloat, "VEC3")},
                             {"TEXCOORD_0", file.add(uvs, kFloat, "VEC2")},
                             {"COLOR_0", file.add(colors, kUbyte, "VEC4")}};
  file.json["accessors"][3]["normalized"] = true;
  primitive["indices"] = file.add(corners, kUint, "SCALAR");
  return file;
}

// --- Draco

static Binary bytes_of(const GltfBuilder& file, int accessor) {
  const GltfJson& view = file.json["bufferViews"][file.json["accessors"][size_t(accessor)]["bufferView"].get<size_t>()];
  const auto first = file.binary.begin() + view["byteOffset"].get<ptrdiff_t>();
  return {first, first + view["byteLength"].get<ptrdiff_t>()};
}

static draco::DataType draco_type(int component_type) {
  switch (component_type) {
    case kByte:
      return draco::DT_INT8;
    case kUbyte:
      return draco::DT_UINT8;
    case kShort:
      return draco::DT_INT16;
    case kUshort:
      return draco::DT_UINT16;
    case kUint:
      return draco::DT_UINT32;
    default:
      return draco::DT_FLOAT32;
  }
}

static draco::GeometryAttribute::Type draco_kind(const std::string& name) {
  if (name == "POSITION") return draco::GeometryAttribute::POSITION;
  if (name == "NORMAL") return draco::GeometryAttribute::NORMAL;
  if (name.starts_with("TEXCOORD")) return draco::GeometryAttribute::TEX_COORD;
  return name.starts_with("COLOR") ? draco::GeometryAttribute::COLOR : draco::GeometryAttribute::GENERIC;
}

static int add_attribute(draco::Mesh& mesh, const GltfBuilder& file, const std::string& name, int index) {
  const GltfJson& accessor = file.json["accessors"][size_t(index)];
  const int components = accessor["type"] == "SCALAR" ? 1 : accessor["type"].get<std::string>().back() - '0';
  const draco::DataType type = draco_type(accessor["componentType"]);
  const int stride = components * draco::DataTypeLength(type);
  draco::GeometryAttribute attribute;
  attribute.Init(draco_kind(name), nullptr, static_cast<int8_t>(components), type, accessor.contains("normalized"),
                 stride, 0);
  const uint32_t count = accessor["count"];
  mesh.set_num_points(count);
  const int id = mesh.AddAttribute(attribute, true, count);
  const Binary bytes = bytes_of(file, index);
  for (uint32_t i = 0; i < count; i++) {
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &bytes[i * uint32_t(stride)]);
  }
  return id;
}

Binary draco_stream(const GltfBuilder& file, const GltfJson& primitive, const DracoChoice& choice, GltfJson* ids) {
  draco::Mesh mesh;
  for (const auto& [name, accessor] : primitive["attributes"].items()) {
    const int id = add_attribute(mesh, file, name, accessor);
    (*ids)[name] = mesh.attribute(id)->unique_id();
  }
  const Binary corners = bytes_of(file, primitive["indices"]);
  std::vector<uint32_t> values(corners.size() / 4);
  std::memcpy(values.data(), corners.data(), corners.size());
  for (size_t i = 0; i + 2 < values.size(); i += 3) {
    mesh.AddFace({draco::PointIndex(values[i]), draco::PointIndex(values[i + 1]), draco::PointIndex(values[i + 2])});
  }
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(choice.edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING : draco::MESH_SEQUENTIAL_ENCODING);
  encoder.SetSpeedOptions(choice.speed, choice.speed);
  for (int i = 0; i < mesh.num_attributes() && choice.bits > 0; i++) {
    if (mesh.attribute(i)->data_type() == draco::DT_FLOAT32) encoder.SetAttributeQuantization(i, choice.bits);
  }
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeToBuffer(&buffer);
  EXPECT_TRUE(status.ok()) << status.error_msg();
  return {buffer.data(), buffer.data() + buffer.size()};
}

void compress_draco(GltfBuilder& file, GltfJson& primitive, const DracoChoice& choice, bool keep) {
  GltfJson ids;
  const Binary stream = draco_stream(file, primitive, choice, &ids);
  const int view = file.add_view(stream);
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view}, {"attributes", ids}};
  file.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  if (keep) return;
  file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  for (const auto& [name, accessor] : primitive["attributes"].items()) {
    file.json["accessors"][accessor.get<size_t>()].erase("bufferView");
  }
  file.json["accessors"][primitive["indices"].get<size_t>()].erase("bufferView");
}

// --- meshopt

void compress_meshopt(GltfBuilder& file, int index, const std::string& mode, size_t stride, const std::string& filter,
                      const std::string& name) {
  const GltfJson old = file.json["bufferViews"][size_t(index)];
  const auto first = file.binary.begin() + old["byteOffset"].get<ptrdiff_t>();
  Binary plain(first, first + old["byteLength"].get<ptrdiff_t>());
  plain.resize((plain.size() + stride - 1) / stride * stride);
  const size_t count = plain.size() / stride;
  Binary packed(1024 + 2 * plain.size() + 16 * count);  // sufficient for every codec
  meshopt_encodeVertexVersion(0);                       // those of the extension
  meshopt_encodeIndexVersion(1);
  if (mode == "ATTRIBUTES") {
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), plain.data(), count, stride));
  } else {
    std::vector<uint32_t> corners(count);
    for (size_t i = 0; i < count; i++) std::memcpy(&corners[i], &plain[i * stride], stride);
    packed.resize(mode == "TRIANGLES"
                      ? meshopt_encodeIndexBuffer(packed.data(), packed.size(), corners.data(), count)
                      : meshopt_encodeIndexSequence(packed.data(), packed.size(), corners.data(), count));
  }
  EXPECT_GT(packed.size(), 0u);
  std::fill(first, first + old["byteLength"].get<ptrdiff_t>(), 0xcd);  // exposes code that reads the plain data
  const GltfJson source = file.json["bufferViews"][size_t(file.add_view(packed))];
  GltfJson& view = file.json["bufferViews"][size_t(index)];
  view["buffer"] = 1;  // without data
  view["byteOffset"] = 0;
  view["byteLength"] = plain.size();
  view["extensions"][name] = {{"buffer", 0},
                              {"byteOffset", source["byteOffset"]},
                              {"byteLength", packed.size()},
                              {"byteStride", stride},
                              {"count", count},
                              {"mode", mode}};
  if (filter != "NONE") view["extensions"][name]["filter"] = filter;
  file.json["extensionsRequired"] = file.json["extensionsUsed"] = {name};
  GltfJson fallback = {{"byteLength", 1 << 20}};
  fallback["extensions"][name]["fallback"] = true;
  file.json["buffers"] = {{{"byteLength", file.binary.size()}}, fallback};
}

// --- zip

Binary make_zip(const std::map<std::string, Binary>& files) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* whole = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_source_keep(whole);
  zip_t* archive = zip_open_from_source(whole, ZIP_CREATE | ZIP_TRUNCATE, &error);
  for (const auto& [name, bytes] : files) {
    zip_source_t* source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    EXPECT_GE(zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8), 0) << name;
  }
  EXPECT_EQ(zip_close(archive), 0);
  zip_stat_t stat;
  zip_source_stat(whole, &stat);
  Binary result(stat.size);
  zip_source_open(whole);
  EXPECT_EQ(zip_source_read(whole, result.data(), result.size()), zip_int64_t(result.size()));
  zip_source_close(whole);
  zip_source_free(whole);
  return result;
}

}  // namespace ods

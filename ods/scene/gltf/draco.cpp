// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_draco_mesh_compression
//
// Draco allocates as much as its streams demand. So its decoders are subclassed here: before they allocate, the counts
// in the stream are read and the memory is deducted from the budget for a file of this size.
#include <draco/compression/entropy/symbol_decoding.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "ods/base/memory.h"
#include "ods/base/text.h"
#include "ods/scene/gltf/parts.h"

namespace ods {

namespace {

// Bytes that decoding may still allocate, over all primitives.
class DracoBudget {
 public:
  DracoBudget(size_t bytes, const std::string& path) : left_(bytes), what_(path + ": decoding its Draco data") {}

  // Returns false if that exceeds the file's budget; throws Error(kMemory) if it exceeds the machine's memory.
  bool take(size_t bytes) {
    size_t left = left_;
    do {
      if (bytes > left) return false;
    } while (!left_.compare_exchange_weak(left, left - bytes));
    check_memory(bytes, what_, "use a machine with more");
    return true;
  }
  size_t left() const { return left_; }

 private:
  std::atomic<size_t> left_;
  std::string what_;
};

// Approximate allocation of the decoder, in bytes.
constexpr size_t kBytesPerFace = 64;           // corners, their opposites, the traversal's lists
constexpr size_t kBytesPerSeparateCorner = 8;  // for attributes with seams of their own
constexpr size_t kBytesPerPoint = 4;           // for an attribute's map from points to values

// A decoder of Draco that stops before it allocates too much.
template <class Decoder>
class LimitedDecoder : public Decoder {
 public:
  explicit LimitedDecoder(DracoBudget& budget) : budget_(budget) {}

  // Returns whether it has stopped.
  bool refused() const { return refused_; }

 protected:
  bool DecodeConnectivity() override {
    stream_ = this->buffer();
    draco::DecoderBuffer start = *stream_;  // a copy: Draco reads the same bytes again
    uint32_t vertices = 0, faces = 0;
    uint8_t separate = 0;
    if constexpr (std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>) {
      if (!draco::DecodeVarint(&vertices, &start) || !draco::DecodeVarint(&faces, &start)) return false;
      if (!start.Decode(&separate)) return false;
    } else {
      if (!draco::DecodeVarint(&faces, &start) || !draco::DecodeVarint(&vertices, &start)) return false;
    }
    if (size_t{vertices} > 3 * size_t{faces}) return false;
    if (!take(faces * (kBytesPerFace + 3 * kBytesPerSeparateCorner * separate))) return false;
    corners_ = 3 * size_t{faces};
    return Decoder::DecodeConnectivity();
  }

  // The attributes are declared, but not decoded yet.
  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    for (int i = 0; i < cloud.num_attributes(); i++) {
      const draco::PointAttribute& attribute = *cloud.attribute(i);
      const auto size = static_cast<size_t>(draco::DataTypeLength(attribute.data_type()));
      // Integers, and the values that they encode.
      if (!take(cloud.num_points() * (kBytesPerPoint + attribute.num_components() * (4 + size)))) return false;
    }
    return Decoder::DecodeAllAttributes();
  }

 public:
  // Draco calls this when it creates the predictor of an attribute, right after reading the predictor's number.
  const draco::MeshAttributeIndicesEncodingData* GetAttributeEncodingData(int id) const override {
    const draco::MeshAttributeIndicesEncodingData* data = Decoder::GetAttributeEncodingData(id);
    if (!data || is_sound(id, static_cast<uint32_t>(data->num_values))) return data;
    refused_ = true;
    return nullptr;
  }

 private:
  bool take(size_t bytes) {
    refused_ = refused_ || !budget_.take(bytes);
    return !refused_;
  }

  // The predictor of texture coordinates allocates a bit for each of up to two billion orientations. Their number is in
  // the stream after the values; a mesh has at most as many as corners.
  bool is_sound(int id, uint32_t count) const {
    const int method = stream_->data_head()[-2];
    if (method == draco::MESH_PREDICTION_TEX_COORDS_DEPRECATED) return false;  // not written by current encoders
    if (method != draco::MESH_PREDICTION_TEX_COORDS_PORTABLE) return true;
    if (this->point_cloud()->attribute(id)->num_components() != 2 || count > corners_) return false;
    draco::DecoderBuffer rest = *stream_;
    uint8_t compressed = 0, size = 0;
    if (!rest.Decode(&compressed)) return false;
    if (compressed != 0) {
      std::vector<uint32_t> values(2 * size_t{count});
      if (!draco::DecodeSymbols(2 * count, 2, &rest, values.data())) return false;
    } else {
      if (!rest.Decode(&size) || rest.remaining_size() < int64_t{2} * count * size) return false;
      rest.Advance(int64_t{2} * count * size);
    }
    int32_t orientations = 0;
    return rest.Decode(&orientations) && orientations >= 0 && static_cast<size_t>(orientations) <= corners_;
  }

  DracoBudget& budget_;
  const draco::DecoderBuffer* stream_ = nullptr;
  size_t corners_ = 0;
  mutable bool refused_ = false;
};

struct Job {
  size_t mesh;
  size_t primitive;
  const JsonValue& source;
  Bytes bytes;
  DracoMesh result;
  std::string fault;
};

}  // namespace

template <class Decoder>
static std::string decode_with(DracoBudget& budget, draco::DecoderBuffer& buffer, draco::Mesh& mesh) {
  LimitedDecoder<Decoder> decoder(budget);
  const draco::DecoderOptions options;
  const draco::Status status = decoder.Decode(options, &buffer, &mesh);
  if (decoder.refused()) return "it is damaged, or asks for far more than a file of its size can hold";
  return status.ok() ? "" : one_line(status.error_msg_string());
}

// Returns the reason for a failure; empty on success.
static std::string decode(Bytes bytes, DracoBudget& budget, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::DecoderBuffer start = buffer;
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&start, &header).ok()) return "it is not Draco data";
  if (header.encoder_type != draco::TRIANGULAR_MESH) return "it holds points, not triangles";
  if (header.version_major != 2 || header.version_minor != 2) {
    return fmt::format("it has version {}.{} of Draco, glTF has 2.2", header.version_major, header.version_minor);
  }
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    return decode_with<draco::MeshEdgebreakerDecoder>(budget, buffer, mesh);
  }
  if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
    return decode_with<draco::MeshSequentialDecoder>(budget, buffer, mesh);
  }
  return "it is encoded in an unknown way";
}

// --- attributes

static int component_type_of(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return kByte;
    case draco::DT_UINT8:
      return kUnsignedByte;
    case draco::DT_INT16:
      return kShort;
    case draco::DT_UINT16:
      return kUnsignedShort;
    case draco::DT_UINT32:
      return kUnsignedInt;
    case draco::DT_FLOAT32:
      return kFloat;
    default:
      return 0;
  }
}

// Copies the values of all points. Returns false if a value does not exist, or does not fit in the type.
template <class T>
static bool copy_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, bool as_it_is,
                        unsigned char* to) {
  const auto components = static_cast<int8_t>(attribute.num_components());
  const size_t size = sizeof(T) * static_cast<size_t>(components);
  for (draco::PointIndex i(0); i < mesh.num_points(); ++i, to += size) {
    const draco::AttributeValueIndex value = attribute.mapped_index(i);
    if (value.value() >= attribute.size()) return false;
    if (as_it_is) {
      std::memcpy(to, attribute.GetAddress(value), size);
      continue;
    }
    T converted[4];
    if (!attribute.ConvertValue<T>(value, components, converted)) return false;
    std::memcpy(to, converted, size);
  }
  return true;
}

using Copy = bool (*)(const draco::Mesh&, const draco::PointAttribute&, bool, unsigned char*);

static Copy copy_as(int component_type) {
  switch (component_type) {
    case kByte:
      return copy_values<int8_t>;
    case kUnsignedByte:
      return copy_values<uint8_t>;
    case kShort:
      return copy_values<int16_t>;
    case kUnsignedShort:
      return copy_values<uint16_t>;
    case kUnsignedInt:
      return copy_values<uint32_t>;
    default:
      return copy_values<float>;
  }
}

// Unpacks an attribute to the component type of its accessor. Returns the reason for a failure; empty on success.
static std::string unpack(const draco::Mesh& mesh, const draco::PointAttribute* attribute, AccessorView& view) {
  if (!attribute || attribute->num_components() > 4) return "is missing";
  if (attribute->data_type() == draco::DT_BOOL) return "has a type that glTF does not have";
  const size_t points = mesh.num_points();
  const size_t stored = static_cast<size_t>(attribute->byte_stride()) * attribute->size();
  const bool mapped = attribute->is_mapping_identity() || attribute->indices_map_size() >= points;
  if (!mapped || attribute->byte_offset() != 0 || attribute->buffer()->data_size() < stored) return "is damaged";
  view.count = points;
  view.components = attribute->num_components();
  view.stride = component_size(view.component_type) * static_cast<size_t>(view.components);
  auto bytes = std::make_shared<std::vector<unsigned char>>(points * view.stride);
  const bool as_it_is = component_type_of(attribute->data_type()) == view.component_type;
  if (!copy_as(view.component_type)(mesh, *attribute, as_it_is, bytes->data())) return "has values outside its range";
  view.data = bytes->data();
  view.expanded = std::move(bytes);
  return "";
}

static void take_attributes(const GltfFile& file, draco::Mesh& mesh, Job& job) {
  for (const JsonValue& id : extension(job.source, "KHR_draco_mesh_compression")["attributes"]) {
    const std::string& name = *id.key;
    const int accessor = index_in(file, job.source["attributes"], name.c_str());
    if (accessor == -1 || name.starts_with('_')) continue;  // not read by any renderer code
    const JsonValue& type = record(file, file.accessors, accessor, "accessor");
    AccessorView view;
    view.component_type = integer(file, type, "componentType", 0);
    view.normalized = type["normalized"].is_true();
    const double unique = id.is_number() && id.number >= 0.0 && id.number < 0x1p32 ? id.number : 0x1p32 - 1;
    const int place = mesh.GetAttributeIdByUniqueId(static_cast<uint32_t>(unique));
    const draco::PointAttribute* attribute = place == -1 ? nullptr : mesh.attribute(place);
    if (component_size(view.component_type) == 0) attribute = nullptr;
    const std::string fault = unpack(mesh, attribute, view);
    if (!fault.empty()) job.fault = fmt::format("its {} {}", name, fault);
    if (!fault.empty()) return;
    job.result.attributes[name] = std::move(view);
  }
}

static void take_corners(const draco::Mesh& mesh, DracoMesh& result) {
  result.vertex_count = mesh.num_points();
  result.corners.reserve(3 * size_t{mesh.num_faces()});
  for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i) {
    for (const draco::PointIndex& corner : mesh.face(i)) result.corners.push_back(corner.value());
  }
}

// --- primitives

static void run(const GltfFile& file, DracoBudget& budget, Job& job) {
  draco::Mesh mesh;
  try {
    job.fault = decode(job.bytes, budget, mesh);
    if (!job.fault.empty()) return;
  } catch (const std::length_error& error) {  // thrown by a vector
    job.fault = one_line(error.what());
    return;
  }
  take_corners(mesh, job.result);
  take_attributes(file, mesh, job);
}

static void append_jobs(const GltfFile& file, size_t mesh, std::vector<Job>& jobs) {
  size_t number = 0;
  for (const JsonValue& primitive : (*file.meshes[mesh])["primitives"]) {
    const JsonValue& packed = extension(primitive, "KHR_draco_mesh_compression");
    if (!packed.is_null() && !file.draco.contains(&primitive["attributes"])) {
      jobs.push_back({mesh, number, primitive, buffer_view_bytes(file, index_in(file, packed, "bufferView")), {}, ""});
    }
    number++;
  }
}

static void decode_all(GltfFile& file, std::vector<Job>& jobs) {
  DracoBudget budget(file.draco_budget, file.path);
  tbb::parallel_for(size_t{0}, jobs.size(), [&](size_t i) { run(file, budget, jobs[i]); });
  file.draco_budget = budget.left();
  for (Job& job : jobs) {
    if (!job.fault.empty()) {
      fail(file, fmt::format("the Draco data of mesh {}, primitive {} cannot be decoded: {}; export the file again, "
                             "or without compression",
                             job.mesh, job.primitive, job.fault));
    }
    file.budget += job.result.corners.size() + 4 * job.result.vertex_count;
    file.draco[&job.source["attributes"]] = std::move(job.result);
  }
}

// Lists that double while they grow would need more memory than the decoded data.
static void reserve_room(const GltfFile& file, Scene& scene) {
  size_t vertices = 0, corners = 0;
  for (const auto& [attributes, mesh] : file.draco) {
    vertices += mesh.attributes.contains("NORMAL") ? mesh.vertex_count : mesh.corners.size();
    corners += mesh.corners.size();
  }
  scene.vertices.reserve(vertices);
  scene.triangles.reserve(corners / 3);
}

void decode_meshes(GltfFile& file, Scene& scene) {
  // Draco spends less than a bit on a predictable triangle.
  constexpr size_t kSmall = size_t{1} << 28, kMaxPerByte = 1024;
  file.draco_budget = kSmall + kMaxPerByte * file.size;
  std::vector<Job> jobs;
  for (size_t mesh = 0; mesh < file.meshes.size(); mesh++) append_jobs(file, mesh, jobs);
  decode_all(file, jobs);
  reserve_room(file, scene);
}

void decode_mesh(GltfFile& file, int mesh) {
  std::vector<Job> jobs;
  append_jobs(file, static_cast<size_t>(mesh), jobs);
  decode_all(file, jobs);
}

}  // namespace ods

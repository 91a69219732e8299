// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Vendor/EXT_meshopt_compression. The Khronos extension
// of that name contains the same streams, and newer ones (version 1) if the installed library decodes them.
#include "ods/scene/gltf/meshopt.h"

#include <fmt/core.h>
#include <meshoptimizer.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "ods/base/memory.h"
#include "ods/scene/gltf/parts.h"

namespace ods {

// --- reading ---------------------------------------------------------------------------------------------------------

namespace {

struct Stream {
  size_t view;
  Bytes bytes;
  size_t count;
  size_t stride;
  std::string mode;
  std::string filter;
  bool fails = false;
};

}  // namespace

// Checks the conditions that the library asserts.
static bool is_valid(const Stream& stream) {
  const size_t stride = stream.stride;
  if (stream.mode == "TRIANGLES" || stream.mode == "INDICES") {
    const bool whole = stream.mode == "INDICES" || stream.count % 3 == 0;
    return whole && (stride == 2 || stride == 4) && stream.filter == "NONE";
  }
  if (stream.mode != "ATTRIBUTES" || stride == 0 || stride > 256 || stride % 4 != 0) return false;
  if (stream.filter == "OCTAHEDRAL") return stride == 4 || stride == 8;
  if (stream.filter == "QUATERNION") return stride == 8;
  return stream.filter == "NONE" || stream.filter == "EXPONENTIAL";
}

static Stream open_stream(const GltfFile& file, size_t view, const JsonValue& source) {
  const auto text = [&](const char* key) { return source[key].is_text() ? *source[key].text : "NONE"; };
  Stream stream{view,
                bytes_in_buffer(file, source, fmt::format("compressed buffer view {}", view)),
                size_in(file, source, "count"),
                size_in(file, source, "byteStride"),
                text("mode"),
                text("filter")};
  if (stream.filter == "COLOR") {
    fail(file,
         "its buffer views are compressed with the filter COLOR, which ods does not read; compress them with "
         "EXT_meshopt_compression instead, or not at all");
  }
  if (!is_valid(stream)) {
    fail(file,
         fmt::format("compressed buffer view {} has an invalid mode, filter or stride; the file is damaged", view));
  }
  return stream;
}

static bool decode(const Stream& stream, unsigned char* to) {
  const auto& [view, bytes, count, stride, mode, filter, fails] = stream;
  if (mode == "TRIANGLES") return meshopt_decodeIndexBuffer(to, count, stride, bytes.data(), bytes.size()) == 0;
  if (mode == "INDICES") return meshopt_decodeIndexSequence(to, count, stride, bytes.data(), bytes.size()) == 0;
  if (meshopt_decodeVertexBuffer(to, count, stride, bytes.data(), bytes.size()) != 0) return false;
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(to, count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(to, count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(to, count, stride);
  return true;
}

static std::string fault_of(const Stream& stream) {
  constexpr unsigned char kNewVertices = 0xa1;
  if (stream.mode == "ATTRIBUTES" && !stream.bytes.empty() && stream.bytes[0] == kNewVertices) {
    return fmt::format(
        "buffer view {} is compressed with version 1 of meshopt, which this build does not read; "
        "compress it with EXT_meshopt_compression, or not at all",
        stream.view);
  }
  return fmt::format("the compressed data of buffer view {} is damaged; export the file again", stream.view);
}

// Opens and checks the streams. The library allocates nothing, so only the decoded data need limits.
static std::vector<Stream> open_streams(const GltfFile& file, size_t* total) {
  // Constant vertices take a bit for each 32 bytes; the limit also holds for all streams together, because several
  // buffer views may share one.
  constexpr size_t kSmall = size_t{1} << 26, kMaxPerByte = 64;
  const size_t maximum = kSmall + kMaxPerByte * file.size;
  std::vector<Stream> streams;
  for (size_t i = 0; i < file.buffer_views.size(); i++) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
      const JsonValue& source = extension(*file.buffer_views[i], name);
      if (source.is_null()) continue;
      const Stream& stream = streams.emplace_back(open_stream(file, i, source));
      if (stream.count > (maximum - *total) / stream.stride) {
        fail(file, "its compressed buffer views hold far more than a file of its size can; it looks damaged");
      }
      *total += stream.count * stream.stride;
      break;
    }
  }
  return streams;
}

void decode_views(GltfFile& file) {
  size_t total = 0;
  std::vector<Stream> streams = open_streams(file, &total);
  file.decoded_views.resize(file.buffer_views.size());
  check_memory(total, file.path + ": its compressed buffer views", "use a machine with more");
  tbb::parallel_for(size_t{0}, streams.size(), [&](size_t i) {
    Stream& stream = streams[i];
    auto bytes = std::make_shared<std::vector<unsigned char>>(stream.count * stream.stride);
    stream.fails = !decode(stream, bytes->data());
    file.decoded_views[stream.view] = std::move(bytes);
  });
  for (const Stream& stream : streams) {
    if (stream.fails) fail(file, fault_of(stream));
  }
  file.budget += total;
}

// --- writing ---------------------------------------------------------------------------------------------------------

MeshOrder drawing_order(std::span<const uvec3> triangles, size_t vertex_count) {
  MeshOrder order;
  order.corners.resize(3 * triangles.size());
  meshopt_optimizeVertexCache(order.corners.data(), &triangles[0].x, order.corners.size(), vertex_count);
  std::vector<uint> places(vertex_count);  // of the old vertices; ~0u without one
  order.vertices.resize(
      meshopt_optimizeVertexFetchRemap(places.data(), order.corners.data(), order.corners.size(), vertex_count));
  for (uint& corner : order.corners) corner = places[corner];
  for (uint old = 0; old < vertex_count; old++) {
    if (places[old] != ~0u) order.vertices[places[old]] = old;
  }
  return order;
}

// The extension has the vertices of version 0 and the indices of version 1; newer libraries default to others.
static void choose_versions() {
  [[maybe_unused]] static const bool are_chosen = [] {
    meshopt_encodeVertexVersion(0);
    meshopt_encodeIndexVersion(1);
    return true;
  }();
}

std::string compress_vertices(std::span<const std::byte> vertices, size_t stride) {
  choose_versions();
  const size_t count = vertices.size() / stride;
  std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
  bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), vertices.data(),
                                          count, stride));
  return bytes;
}

std::string compress_triangles(std::span<const uint> corners, size_t vertex_count) {
  choose_versions();
  std::string bytes(meshopt_encodeIndexBufferBound(corners.size(), vertex_count), '\0');
  bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), corners.data(),
                                         corners.size()));
  return bytes;
}

uint32_t exponential_bits(int mantissa, int exponent) {
  return static_cast<uint32_t>(exponent) << 24 | (static_cast<uint32_t>(mantissa) & 0xffffff);
}

}  // namespace ods

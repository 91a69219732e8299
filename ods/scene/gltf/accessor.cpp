// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "ods/scene/gltf/parts.h"

namespace ods {

bool is_unsigned(int type) {
  return type == kUnsignedByte || type == kUnsignedShort || type == kUnsignedInt;
}

size_t component_size(int type) {
  switch (type) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

static int component_count(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4") return 4;
  return type == "MAT4" ? 16 : 0;
}

// Loads a value from an address that may be unaligned.
template <class T>
static T load(const unsigned char* data) {
  T value;
  std::memcpy(&value, data, sizeof value);
  return value;
}

template <class T>
static float load_integer(const unsigned char* data, bool normalized) {
  const float value = static_cast<float>(load<T>(data));
  return normalized ? std::max(-1.0f, value / static_cast<float>(std::numeric_limits<T>::max())) : value;
}

static float load_component(const unsigned char* data, int type, bool normalized) {
  switch (type) {
    case kByte:
      return load_integer<int8_t>(data, normalized);
    case kUnsignedByte:
      return load_integer<uint8_t>(data, normalized);
    case kShort:
      return load_integer<int16_t>(data, normalized);
    case kUnsignedShort:
      return load_integer<uint16_t>(data, normalized);
    case kUnsignedInt:
      return load_integer<uint32_t>(data, normalized);
    default:
      return load<float>(data);
  }
}

static uint load_index(const unsigned char* data, int type) {
  switch (type) {
    case kUnsignedByte:
      return load<uint8_t>(data);
    case kUnsignedShort:
      return load<uint16_t>(data);
    default:
      return load<uint32_t>(data);
  }
}

float AccessorView::number_at(size_t i, int component) const {
  const size_t size = component_size(component_type);
  return load_component(data + i * stride + static_cast<size_t>(component) * size, component_type, normalized);
}

vec4 AccessorView::at(size_t i) const {
  vec4 value(0.0f, 0.0f, 0.0f, 1.0f);
  for (int c = 0; c < std::min(components, 4); c++) value[c] = number_at(i, c);
  return value;
}

uint AccessorView::index_at(size_t i) const {
  return load_index(data + i * stride, component_type);
}

// The start of a range of elements in a buffer view; throws if it is out of bounds.
static const unsigned char* checked_elements(const GltfFile& file, int accessor, int view, size_t offset, size_t count,
                                             size_t size, size_t stride) {
  const Bytes bytes = buffer_view_bytes(file, view);
  if (offset > bytes.size() || size > bytes.size() - offset || (count - 1) > (bytes.size() - offset - size) / stride) {
    fail(file, fmt::format("accessor {} runs past the end of its buffer view; the file is damaged", accessor));
  }
  return bytes.data() + offset;
}

// Replaces some of an accessor's elements.
static void replace_sparse(GltfFile& file, int accessor, const JsonValue& sparse, size_t elements, size_t size,
                           std::vector<unsigned char>& bytes) {
  const JsonValue &indices = sparse["indices"], &values = sparse["values"];
  const size_t count = size_in(file, sparse, "count");
  if (count == 0) return;
  const int type = integer(file, indices, "componentType", 0);
  if (!is_unsigned(type))
    fail(file, fmt::format("sparse accessor {} has indices that are not unsigned integers", accessor));
  const size_t index_size = component_size(type);
  const unsigned char* from = checked_elements(file, accessor, index_in(file, values, "bufferView"),
                                               size_in(file, values, "byteOffset"), count, size, size);
  const unsigned char* where = checked_elements(file, accessor, index_in(file, indices, "bufferView"),
                                                size_in(file, indices, "byteOffset"), count, index_size, index_size);
  for (size_t i = 0; i < count; i++) {
    const uint target = load_index(where + i * index_size, type);
    if (target >= elements) fail(file, fmt::format("sparse accessor {} has an index out of range", accessor));
    std::memcpy(bytes.data() + target * size, from + i * size, size);
  }
}

// Expands an accessor without a buffer view (all zeros) or with sparse elements.
static Storage expand(GltfFile& file, int index, const AccessorView& plain, size_t size, const JsonValue& sparse) {
  // A file may declare a billion zeros, so they count against the budget.
  spend(file, plain.count);
  auto expanded = std::make_shared<std::vector<unsigned char>>(plain.count * size);
  if (plain.data != nullptr) {
    for (size_t i = 0; i < plain.count; i++) {
      std::memcpy(expanded->data() + i * size, plain.data + i * plain.stride, size);
    }
  }
  if (sparse.is_object()) replace_sparse(file, index, sparse, plain.count, size, *expanded);
  return expanded;
}

AccessorView open_accessor(GltfFile& file, int index) {
  AccessorView attribute;
  if (index == -1) return attribute;
  const JsonValue& accessor = record(file, file.accessors, index, "accessor");
  attribute.components = component_count(*accessor["type"].text);
  attribute.component_type = integer(file, accessor, "componentType", 0);
  attribute.normalized = accessor["normalized"].is_true();
  attribute.count = size_in(file, accessor, "count");
  const size_t size = component_size(attribute.component_type) * static_cast<size_t>(attribute.components);
  if (size == 0) fail(file, fmt::format("accessor {} has a type that is not allowed here", index));
  if (attribute.count == 0) fail(file, fmt::format("accessor {} has no elements", index));
  const int view = index_in(file, accessor, "bufferView");
  if (view != -1) {
    const size_t stride = size_in(file, record(file, file.buffer_views, view, "buffer view"), "byteStride");
    attribute.stride = stride == 0 ? size : stride;
    attribute.data = checked_elements(file, index, view, size_in(file, accessor, "byteOffset"), attribute.count, size,
                                      attribute.stride);
  }
  const JsonValue& sparse = accessor["sparse"];
  if (sparse.is_object() || attribute.data == nullptr) {
    attribute.expanded = expand(file, index, attribute, size, sparse);
    attribute.data = attribute.expanded->data();
    attribute.stride = size;
  }
  return attribute;
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "ods/scene/gltf/parts.h"

namespace ods {

static size_t component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

static int component_count(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      return 0;
  }
}

// Buffers have no alignment that a compiler may rely on.
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
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return load_integer<int8_t>(data, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load_integer<uint8_t>(data, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return load_integer<int16_t>(data, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load_integer<uint16_t>(data, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load_integer<uint32_t>(data, normalized);
    default:
      return load<float>(data);
  }
}

static uint load_index(const unsigned char* data, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<uint8_t>(data);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
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

// A run of elements inside a buffer view, or fail().
static const unsigned char* checked_elements(const GltfFile& file, int accessor, int view, size_t offset, size_t count,
                                             size_t size, size_t stride) {
  const Bytes bytes = buffer_view_bytes(file, view);
  if (offset > bytes.size() || size > bytes.size() - offset || (count - 1) > (bytes.size() - offset - size) / stride) {
    fail(file, fmt::format("accessor {} runs past the end of its buffer view; the file is damaged", accessor));
  }
  return bytes.data() + offset;
}

// The elements of a sparse accessor without gaps: those of its buffer view (or zeros), with some replaced.
static std::shared_ptr<const std::vector<unsigned char>> expand_sparse(GltfFile& file, int index,
                                                                       const AccessorView& plain, size_t size) {
  const tinygltf::Accessor& accessor = file.model->accessors[static_cast<size_t>(index)];
  // A file may say that there are a billion zeros; it has to pay for them.
  spend(file, accessor.count);
  auto expanded = std::make_shared<std::vector<unsigned char>>(accessor.count * size);
  const auto put = [&](size_t i, const unsigned char* element) {
    std::memcpy(expanded->data() + i * size, element, size);
  };
  if (plain.data != nullptr) {
    for (size_t i = 0; i < accessor.count; i++) put(i, plain.data + i * plain.stride);
  }
  const auto& sparse = accessor.sparse;
  const size_t count = static_cast<size_t>(std::max(0, static_cast<int>(sparse.count)));
  if (count == 0) return expanded;
  const int index_type = sparse.indices.componentType;
  if (index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    fail(file, fmt::format("sparse accessor {} has indices that are not unsigned integers", index));
  }
  const size_t index_size = component_size(index_type);
  const unsigned char* values = checked_elements(file, index, sparse.values.bufferView,
                                                 static_cast<size_t>(sparse.values.byteOffset), count, size, size);
  const unsigned char* where =
      checked_elements(file, index, sparse.indices.bufferView, static_cast<size_t>(sparse.indices.byteOffset), count,
                       index_size, index_size);
  for (size_t i = 0; i < count; i++) {
    const uint target = load_index(where + i * index_size, index_type);
    if (target >= accessor.count) fail(file, fmt::format("sparse accessor {} has an index out of range", index));
    put(target, values + i * size);
  }
  return expanded;
}

AccessorView open_accessor(GltfFile& file, int index) {
  AccessorView attribute;
  if (index == -1) return attribute;
  const tinygltf::Accessor& accessor = element(file, file.model->accessors, index, "accessor");
  attribute.components = component_count(accessor.type);
  attribute.component_type = accessor.componentType;
  attribute.normalized = accessor.normalized;
  attribute.count = accessor.count;
  const size_t size = component_size(accessor.componentType) * static_cast<size_t>(attribute.components);
  if (size == 0) fail(file, fmt::format("accessor {} has a type that is not allowed here", index));
  if (accessor.count == 0) fail(file, fmt::format("accessor {} has no elements", index));
  if (accessor.bufferView >= 0) {
    const bool exists = static_cast<size_t>(accessor.bufferView) < file.model->bufferViews.size();
    const size_t stride = exists ? file.model->bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride : 0;
    attribute.stride = stride == 0 ? size : stride;
    attribute.data =
        checked_elements(file, index, accessor.bufferView, accessor.byteOffset, accessor.count, size, attribute.stride);
  }
  if (accessor.sparse.isSparse || attribute.data == nullptr) {
    attribute.expanded = expand_sparse(file, index, attribute, size);
    attribute.data = attribute.expanded->data();
    attribute.stride = size;
  }
  return attribute;
}

}  // namespace ods

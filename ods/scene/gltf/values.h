// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Members of the JSON objects in a glTF file. What fails throws Error(kInput) naming the file.
#pragma once
#include <cstddef>
#include <vector>

#include "ods/scene/gltf/json.h"

namespace ods {

struct GltfFile;

// What numbers of accessors are stored as.
enum ComponentType {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126
};
bool is_unsigned(int component_type);  // one that indices may have

// A whole number, which may be written as a real; the fallback where it is absent. Fails where it is something else.
// What is beyond the range of an int is its nearest.
int integer(const GltfFile& file, const JsonValue& object, const char* key, int fallback);
// The index of something in a list: -1 where it is absent or negative.
int index_in(const GltfFile& file, const JsonValue& object, const char* key);
// A number of bytes or elements; 0 where it is absent. Fails where it is no whole number, or negative.
size_t size_in(const GltfFile& file, const JsonValue& object, const char* key);
// A real number, or the fallback where it is absent or something else.
double number(const JsonValue& object, const char* key, double fallback);
// As many real numbers as the fallback has, or the fallback.
std::vector<double> numbers(const JsonValue& object, const char* key, const std::vector<double>& fallback);
// All the indices in a list; none where it is absent. Fails where it is something else.
std::vector<int> indices(const GltfFile& file, const JsonValue& object, const char* key);
// An extension of the object; kNoJson where it has none of that name.
const JsonValue& extension(const JsonValue& object, const char* name);

}  // namespace ods

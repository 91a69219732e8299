// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads members of JSON objects in a glTF file. Failure throws Error(kInput), naming the file.
#pragma once
#include <cstddef>
#include <vector>

#include "ods/scene/gltf/json.h"

namespace ods {

struct GltfFile;

// The component types of accessors.
enum ComponentType {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126
};
bool is_unsigned(int component_type);       // returns whether indices may have this type
size_t component_size(int component_type);  // in bytes; 0 if there is no such type

// An integer, which may be written as a real; the fallback if absent. Fails if it is anything else. Clamped to the
// range of int.
int integer(const GltfFile& file, const JsonValue& object, const char* key, int fallback);
// An index into a list; -1 if absent or negative.
int index_in(const GltfFile& file, const JsonValue& object, const char* key);
// A number of bytes or elements; 0 if absent. Fails if it is negative or not an integer.
size_t size_in(const GltfFile& file, const JsonValue& object, const char* key);
// A real number, or the fallback if absent or of another type.
double number(const JsonValue& object, const char* key, double fallback);
// Real numbers, as many as the fallback has; or the fallback.
std::vector<double> numbers(const JsonValue& object, const char* key, const std::vector<double>& fallback);
// All indices in a list; empty if absent. Fails if it is anything else.
std::vector<int> indices(const GltfFile& file, const JsonValue& object, const char* key);
// An extension of the object; kNoJson if absent.
const JsonValue& extension(const JsonValue& object, const char* name);

}  // namespace ods

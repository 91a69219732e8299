// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The bytes of a glTF file and of the files that it refers to. Failure throws Error(kInput), naming the file.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "ods/scene/gltf/accessor.h"
#include "ods/scene/gltf/json.h"

namespace ods {

struct GltfFile;
struct ImageSource;

// --- source.cpp
GltfFile open_gltf(const std::string& path, const std::string& confine);
GltfFile open_gltf_bytes(Bytes bytes, const std::string& path, const std::string& confine);
// The bytes that an object with buffer, byteOffset and byteLength refers to; `what` names it in the error message.
Bytes bytes_in_buffer(const GltfFile& file, const JsonValue& part, const std::string& what);
// The bytes of a buffer view, decompressed.
Bytes buffer_view_bytes(const GltfFile& file, int view);
std::vector<unsigned char> image_bytes(const GltfFile& file, const ImageSource& image);

// --- uri.cpp
bool is_data_uri(const std::string& uri);

// The file that a URI refers to, relative to the scene's folder; a data URI is its own name. If no file has the name
// according to RFC 3986, tries the variants of other programs (backslashes, unescaped or twice escaped characters,
// another letter case) and adds the match to file.renamed. The file need not exist.
std::string resolve_uri(GltfFile& file, const std::string& uri);

// The first `most` bytes of a URI's file, which may be larger than needed. name: from resolve_uri().
Storage read_uri(const GltfFile& file, const std::string& uri, const std::string& name, size_t maximum);

// The size of the picture's own file; 0 if it is embedded in the glTF file or missing.
size_t external_bytes(const GltfFile& file, const ImageSource& image);

// Warns that the names of files differ from their names in the scene.
void warn_renamed(const GltfFile& file, Scene& scene);

// --- meshopt.cpp
// Decodes all buffer views with EXT_meshopt_compression or KHR_meshopt_compression, in parallel.
void decode_views(GltfFile& file);

}  // namespace ods

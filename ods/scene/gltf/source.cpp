// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "ods/base/base64.h"
#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/files/confined_file.h"
#include "ods/files/read_file.h"
#include "ods/image/image_file.h"
#include "ods/scene/gltf/extensions.h"
#include "ods/scene/gltf/parts.h"

namespace ods {

using Storage = std::shared_ptr<const std::vector<unsigned char>>;

static Storage share(std::vector<unsigned char> bytes) {
  return std::make_shared<const std::vector<unsigned char>>(std::move(bytes));
}

// --- the container: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html#glb-file-format-specification

namespace {

struct Chunks {
  Bytes json;
  Bytes binary;
};

}  // namespace

static uint32_t read_uint32(Bytes bytes, size_t offset) {
  return static_cast<uint32_t>(bytes[offset]) | static_cast<uint32_t>(bytes[offset + 1]) << 8 |
         static_cast<uint32_t>(bytes[offset + 2]) << 16 | static_cast<uint32_t>(bytes[offset + 3]) << 24;
}

static bool is_container(Bytes bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

static Chunks split_container(const GltfFile& file, Bytes bytes) {
  if (bytes.empty()) fail(file, "is empty");
  if (!is_container(bytes)) return {bytes, {}};
  if (bytes.size() < 20) fail(file, "ends inside its header; the file is damaged");
  if (read_uint32(bytes, 4) != 2) fail(file, "is not glTF version 2; convert it to glTF 2.0");
  const size_t length = read_uint32(bytes, 8);
  if (length > bytes.size()) {
    fail(file, fmt::format("has {} bytes, but its header says {}; it was not completely written or copied",
                           bytes.size(), length));
  }
  constexpr uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
  Chunks chunks;
  size_t at = 12;
  while (at < length && length - at >= 8) {
    const size_t size = read_uint32(bytes, at);
    const uint32_t type = read_uint32(bytes, at + 4);
    at += 8;
    if (size > length - at) fail(file, "has a chunk that runs past its end; the file is damaged");
    if (type == kJson && chunks.json.empty()) chunks.json = bytes.subspan(at, size);
    if (type == kBinary && chunks.binary.empty()) chunks.binary = bytes.subspan(at, size);
    at += size;
  }
  if (chunks.json.empty()) fail(file, "has no JSON chunk; the file is damaged");
  return chunks;
}

// --- URIs

// RFC 3986: %20 is a space.
static std::string decode_percent(const std::string& uri) {
  std::string text;
  for (size_t i = 0; i < uri.size(); i++) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
    text += escaped ? static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
    if (escaped) i += 2;
  }
  return text;
}

// The same key for all spellings of a path, so that nothing is read twice.
static std::string uri_key(const std::string& uri) {
  return uri.starts_with("data:") ? uri : std::filesystem::path(decode_percent(uri)).lexically_normal().string();
}

static Storage read_data_uri(const GltfFile& file, const std::string& uri) {
  const size_t comma = uri.find(";base64,");
  if (comma == std::string::npos) fail(file, "has a data URI that is not base64");
  const std::string bytes = decode_base64(std::string_view(uri).substr(comma + 8));
  return share({bytes.begin(), bytes.end()});
}

// RFC 3986: whether it starts with a scheme, as "file:" and "https:".
static bool has_scheme(const std::string& uri) {
  const size_t colon = uri.find_first_of(":/?#%");
  return colon != std::string::npos && uri[colon] == ':';
}

// The path that a URI refers to.
static std::string uri_path(const GltfFile& file, const std::string& uri) {
  const std::string name = decode_percent(uri);
  if (name.empty() || name.find('\0') != std::string::npos) fail(file, "refers to a file without a name");
  if (has_scheme(uri) || name.starts_with('/')) {
    fail(file, fmt::format("refers to {}; ods reads only files that are named relative to the scene, and fetches "
                           "nothing from the network: put the file beside it",
                           printable(uri)));
  }
  return (std::filesystem::path(file.path).parent_path() / name).string();
}

// The first `most` bytes of a URI's file, which may be larger than needed.
static Storage read_uri(const GltfFile& file, const std::string& uri, size_t most) {
  if (uri.starts_with("data:")) return read_data_uri(file, uri);
  const std::string path = uri_path(file, uri);
  try {
    return ConfinedFile(path, file.confine).read([&](const std::string& opened) {
      return share(read_start(opened, most));
    });
  } catch (const Error& error) {
    if (!file.confine.empty()) {  // reveals nothing about files outside the folder
      if (error.kind() != ErrorKind::kInput) throw;
      fail(file, fmt::format("refers to {}, which does not exist, lies outside the folder that scenes are confined "
                             "to, or cannot be read",
                             printable(uri)));
    }
    std::string_view why = error.what();
    const std::string known = fmt::format("cannot read '{}': ", path);  // stripped below
    if (why.starts_with(known)) why.remove_prefix(known.size());
    throw Error(error.kind(), fmt::format("{}: refers to {}: {}", file.path, printable(uri), why));
  }
}

// --- buffers and pictures

static const JsonValue& list_in(const GltfFile& file, const JsonValue& parent, const char* key) {
  const JsonValue& list = parent[key];
  if (!list.is_null() && !list.is_list()) fail(file, fmt::format("{} is not a list", key));
  return list;
}

// The objects in a list of the file; empty if it has no such list.
static Records records(const GltfFile& file, const JsonValue& parent, const char* key) {
  Records found;
  for (const JsonValue& value : list_in(file, parent, key)) {
    if (!value.is_object()) fail(file, fmt::format("element {} of {} is not an object", found.size(), key));
    found.push_back(&value);
  }
  return found;
}

static void take_buffers(GltfFile& file, Bytes binary) {
  const Records sources = records(file, file.json.root(), "buffers");
  std::map<std::string, size_t> lengths;  // how much of each file is needed
  for (const JsonValue* source : sources) {
    size_t& longest = lengths[uri_key(*(*source)["uri"].text)];
    longest = std::max(longest, size_in(file, *source, "byteLength"));
  }
  std::map<std::string, Storage> loaded;
  for (size_t i = 0; i < sources.size(); i++) {
    const size_t length = size_in(file, *sources[i], "byteLength");
    const JsonValue& uri = (*sources[i])["uri"];
    Bytes bytes = binary;
    if (uri.is_text()) {
      const std::string key = uri_key(*uri.text);
      Storage& storage = loaded[key];
      if (!storage) {
        storage = read_uri(file, *uri.text, lengths[key]);
        file.storage.push_back(storage);
        file.size += storage->size();
      }
      bytes = *storage;
    } else if (i > 0) {
      fail(file, fmt::format("buffer {} has no data", i));
    }
    if (length > bytes.size()) {
      fail(file,
           fmt::format("buffer {} has {} bytes, but should have {}; the file is damaged", i, bytes.size(), length));
    }
    file.buffers.push_back(bytes.first(length));
  }
}

static void take_images(GltfFile& file) {
  std::map<std::pair<std::string, int>, size_t> first;
  for (const JsonValue* image : records(file, file.json.root(), "images")) {
    ImageSource source{*(*image)["uri"].text, index_in(file, *image, "bufferView"), file.images.size()};
    source.first = first.emplace(std::pair(uri_key(source.uri), source.view), source.first).first->second;
    file.images.push_back(source);
  }
}

static void take_clips(GltfFile& file) {
  for (const JsonValue& animation : list_in(file, file.json.root(), "animations")) {
    ClipSource clip{*animation["name"].text, {}};
    if (clip.name.empty()) clip.name = fmt::format("animation {}", file.clips.size());
    const Records samplers = records(file, animation, "samplers");
    for (const JsonValue& source : list_in(file, animation, "channels")) {
      const JsonValue& target = source["target"];
      const JsonValue& sampler = record(file, samplers, index_in(file, source, "sampler"), "animation sampler");
      ChannelSource channel{index_in(file, sampler, "input"), index_in(file, sampler, "output"),
                            *sampler["interpolation"].text, index_in(file, target, "node"), *target["path"].text};
      if (channel.path == "pointer") channel.path = *extension(target, "KHR_animation_pointer")["pointer"].text;
      clip.channels.push_back(channel);
    }
    file.clips.push_back(std::move(clip));
  }
}

Bytes buffer_view_bytes(const GltfFile& file, int index) {
  const JsonValue& view = record(file, file.buffer_views, index, "buffer view");
  const Bytes buffer = element(file, file.buffers, index_in(file, view, "buffer"), "buffer");
  const size_t offset = size_in(file, view, "byteOffset"), length = size_in(file, view, "byteLength");
  if (offset > buffer.size() || length > buffer.size() - offset) {
    fail(file, fmt::format("buffer view {} runs past the end of its buffer; the file is damaged", index));
  }
  return buffer.subspan(offset, length);
}

size_t external_bytes(const GltfFile& file, const ImageSource& image) {
  if (image.uri.empty() || image.uri.starts_with("data:")) return 0;
  const std::string path = uri_path(file, image.uri);
  try {
    return ConfinedFile(path, file.confine).read(file_size);
  } catch (const Error&) {
    return 0;  // reading it reports the fault
  }
}

std::vector<unsigned char> image_bytes(const GltfFile& file, const ImageSource& image) {
  if (external_bytes(file, image) > kMaxFileBytes) {
    fail(file, fmt::format("refers to {}: more than {}, the limit for a picture", printable(image.uri),
                           bytes_text(kMaxFileBytes)));
  }
  if (!image.uri.empty()) return *read_uri(file, image.uri, kMaxFileBytes);
  const Bytes bytes = buffer_view_bytes(file, image.view);
  return {bytes.begin(), bytes.end()};
}

// --- the file

static void check_version(const GltfFile& file) {
  const JsonValue& version = file.json.root()["asset"]["version"];
  if (!version.is_text()) fail(file, "is not a glTF file: it does not state its version");
  if (!version.text->starts_with("2.")) {
    fail(file, fmt::format("is glTF version {}, ods reads 2.0", printable(*version.text)));
  }
}

static void parse(GltfFile& file, Bytes bytes) {
  file.size = bytes.size();
  const Chunks chunks = split_container(file, bytes);
  file.json = parse_gltf_json(chunks.json, file.path, is_read);
  check_version(file);
  const JsonValue& root = file.json.root();
  file.accessors = records(file, root, "accessors");
  file.buffer_views = records(file, root, "bufferViews");
  file.cameras = records(file, root, "cameras");
  file.image_lights = records(file, extension(root, "EXT_lights_image_based"), "lights");
  file.lights = records(file, extension(root, "KHR_lights_punctual"), "lights");
  file.materials = records(file, root, "materials");
  file.meshes = records(file, root, "meshes");
  file.nodes = records(file, root, "nodes");
  file.samplers = records(file, root, "samplers");
  file.scenes = records(file, root, "scenes");
  file.skins = records(file, root, "skins");
  file.textures = records(file, root, "textures");
  take_clips(file);
  take_buffers(file, chunks.binary);
  take_images(file);
  file.budget = (size_t(1) << 20) + 16 * file.size;
}

// A binary container states its length; anything else must look like JSON before it is read.
static std::vector<unsigned char> read_scene_file(const GltfFile& file) {
  constexpr size_t kLongestText = size_t(1) << 30;
  return ConfinedFile(file.path, file.confine).read([&](const std::string& opened) {
    const std::vector<unsigned char> start = read_start(opened, 64);
    if (is_container(start)) return read_start(opened, start.size() < 12 ? start.size() : read_uint32(start, 8));
    const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
    const size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (first != std::string_view::npos && text[first] != '{') fail(file, "is not a glTF file");
    return read_file(opened, kLongestText);
  });
}

std::vector<std::string> gltf_files(const std::string& path, const std::string& confine) {
  GltfFile file;
  file.path = path, file.confine = confine;
  const std::vector<unsigned char> bytes = read_scene_file(file);
  const JsonDocument json = parse_gltf_json(split_container(file, bytes).json, path, is_read);
  std::set<std::string> names;
  for (const char* list : {"buffers", "images"}) {
    for (const JsonValue& each : json.root()[list]) {
      const std::string& uri = *each["uri"].text;
      if (!uri.empty() && !uri.starts_with("data:")) names.insert(uri_key(uri));
    }
  }
  return {names.begin(), names.end()};
}

GltfFile open_gltf(const std::string& path, const std::string& confine) {
  GltfFile file;
  file.path = path, file.confine = confine;
  file.storage.push_back(share(read_scene_file(file)));
  parse(file, *file.storage.front());
  return file;
}

GltfFile open_gltf_bytes(Bytes bytes, const std::string& path, const std::string& confine) {
  GltfFile file;
  file.path = path, file.confine = confine;
  parse(file, bytes);
  return file;
}

}  // namespace ods

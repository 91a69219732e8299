// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>

#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/base/suggest.h"
#include "ods/base/text.h"
#include "ods/files/confined_file.h"
#include "ods/files/read_file.h"
#include "ods/image/image_file.h"
#include "ods/scene/gltf/extensions.h"
#include "ods/scene/gltf/parts.h"

namespace ods {

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

// A buffer without data, because all its buffer views are compressed and have their data elsewhere.
static bool is_fallback(const JsonValue& buffer) {
  return extension(buffer, "EXT_meshopt_compression")["fallback"].is_true() ||
         extension(buffer, "KHR_meshopt_compression")["fallback"].is_true();
}

static void take_buffers(GltfFile& file, Bytes binary) {
  const Records sources = records(file, file.json.root(), "buffers");
  std::vector<std::string> names(sources.size());
  std::map<std::string, size_t> lengths;  // required length of each file
  for (size_t i = 0; i < sources.size(); i++) {
    const JsonValue& uri = (*sources[i])["uri"];
    if (!uri.is_text() || is_fallback(*sources[i])) continue;
    names[i] = resolve_uri(file, *uri.text);
    size_t& longest = lengths[names[i]];
    longest = std::max(longest, size_in(file, *sources[i], "byteLength"));
  }
  std::map<std::string, Storage> loaded;
  for (size_t i = 0; i < sources.size(); i++) {
    const size_t length = size_in(file, *sources[i], "byteLength");
    const JsonValue& uri = (*sources[i])["uri"];
    if (is_fallback(*sources[i]) || (!uri.is_text() && (i > 0 || binary.empty()))) {
      file.buffers.emplace_back();
      continue;
    }
    Bytes bytes = binary;
    if (uri.is_text()) {
      Storage& storage = loaded[names[i]];
      if (!storage) {
        storage = read_uri(file, *uri.text, names[i], lengths[names[i]]);
        file.storage.push_back(storage);
        file.size += storage->size();
      }
      bytes = *storage;
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
    const std::string& uri = *(*image)["uri"].text;
    ImageSource source{uri, "", index_in(file, *image, "bufferView"), file.images.size()};
    if (!source.uri.empty()) source.name = resolve_uri(file, source.uri);
    source.first = first.emplace(std::pair(source.name, source.view), source.first).first->second;
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

Bytes bytes_in_buffer(const GltfFile& file, const JsonValue& part, const std::string& what) {
  const int index = index_in(file, part, "buffer");
  const Bytes buffer = element(file, file.buffers, index, "buffer");
  const size_t offset = size_in(file, part, "byteOffset"), length = size_in(file, part, "byteLength");
  if (buffer.empty() && length > 0) fail(file, fmt::format("{} lies in buffer {}, which has no data", what, index));
  if (offset > buffer.size() || length > buffer.size() - offset) {
    fail(file, fmt::format("{} runs past the end of its buffer; the file is damaged", what));
  }
  return buffer.subspan(offset, length);
}

Bytes buffer_view_bytes(const GltfFile& file, int index) {
  const JsonValue& view = record(file, file.buffer_views, index, "buffer view");
  const Storage& decoded = file.decoded_views[static_cast<size_t>(index)];
  if (!decoded) return bytes_in_buffer(file, view, fmt::format("buffer view {}", index));
  const size_t length = size_in(file, view, "byteLength");
  if (length > decoded->size()) {
    fail(file, fmt::format("buffer view {} runs past the end of its compressed data; the file is damaged", index));
  }
  return Bytes(*decoded).first(length);
}

std::vector<unsigned char> image_bytes(const GltfFile& file, const ImageSource& image) {
  if (external_bytes(file, image) > kMaxFileBytes) {
    fail(file, fmt::format("refers to {}: more than {}, the limit for a picture", printable(image.uri),
                           bytes_text(kMaxFileBytes)));
  }
  if (!image.uri.empty()) return *read_uri(file, image.uri, image.name, kMaxFileBytes);
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
  decode_views(file);
}

// A binary container contains its length; anything else must be an archive or look like JSON before it is read.
static std::vector<unsigned char> read_scene_file(const GltfFile& file) {
  constexpr size_t kLongestText = size_t(1) << 30;
  return ConfinedFile(file.path, file.confine).read([&](const std::string& opened) {
    const std::vector<unsigned char> start = read_start(opened, 64);
    if (is_zip(start)) return read_start(opened, SIZE_MAX);
    if (is_container(start)) return read_start(opened, start.size() < 12 ? start.size() : read_uint32(start, 8));
    const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
    const size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (first != std::string_view::npos && text[first] != '{') {
      fail(file, "is not a glTF file" + taken_by(text));
    }
    return read_file(opened, kLongestText);
  });
}

// The one scene in an archive.
static std::string scene_in(const GltfFile& file) {
  std::vector<std::string> scenes;
  for (const std::string& name : file.archive->names()) {
    const std::filesystem::path path(name);
    const std::string extension = small_letters(path.extension().string());
    const bool litter = name.starts_with("__MACOSX/") || path.filename().string().starts_with('.');
    if (!litter && (extension == ".glb" || extension == ".gltf")) scenes.push_back(name);
  }
  if (scenes.size() == 1) return scenes.front();
  if (scenes.empty()) fail(file, "is an archive without a .glb or .gltf file");
  constexpr size_t kMax = 8;
  std::string list;
  for (size_t i = 0; i < std::min(scenes.size(), kMax); i++) list += (i == 0 ? "" : ", ") + printable(scenes[i]);
  fail(file, fmt::format("is an archive of {} scenes: {}{}; unpack it and name one of them", scenes.size(), list,
                         scenes.size() > kMax ? ", ..." : ""));
}

// bytes: the file or archive; they must outlive `file`.
static void open_bytes(GltfFile& file, Bytes bytes) {
  if (!is_zip(bytes)) return parse(file, bytes);
  file.archive = std::make_shared<ZipArchive>(bytes, file.path);
  const std::string scene = scene_in(file);
  file.folder = std::filesystem::path(scene).parent_path().generic_string();
  file.storage.push_back(share(file.archive->read(scene)));
  parse(file, *file.storage.back());
}

std::vector<std::string> gltf_files(const std::string& path, const std::string& confine) {
  GltfFile file;
  file.path = path, file.confine = confine;
  const std::vector<unsigned char> bytes = read_scene_file(file);
  if (is_zip(bytes)) return {};  // the archive contains all files
  const JsonDocument json = parse_gltf_json(split_container(file, bytes).json, path, is_read);
  std::set<std::string> names;
  for (const char* list : {"buffers", "images"}) {
    for (const JsonValue& each : json.root()[list]) {
      const std::string& uri = *each["uri"].text;
      if (!uri.empty() && !is_data_uri(uri) && !is_fallback(each)) names.insert(resolve_uri(file, uri));
    }
  }
  return {names.begin(), names.end()};
}

GltfFile open_gltf(const std::string& path, const std::string& confine) {
  GltfFile file;
  file.path = path, file.confine = confine;
  file.storage.push_back(share(read_scene_file(file)));
  open_bytes(file, *file.storage.front());
  return file;
}

GltfFile open_gltf_bytes(Bytes bytes, const std::string& path, const std::string& confine) {
  GltfFile file;
  file.path = path, file.confine = confine;
  open_bytes(file, bytes);
  return file;
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "ods/base/base64.h"
#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/base/read_file.h"
#include "ods/image/image_file.h"
#include "ods/scene/gltf/parts.h"

namespace ods {

using Json = nlohmann::json;
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
    fail(file, fmt::format("has {} bytes, but its header says {}; it was not written or copied to its end",
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

// Readers of JSON recurse where it nests; glTF needs ten levels, extras a few more.
static void check_depth(const GltfFile& file, Bytes text) {
  constexpr int kDeepest = 100;
  int depth = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); i++) {
    const unsigned char c = text[i];
    if (in_string) {
      if (c == '\\') i++;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepest) fail(file, "nests its JSON too deeply; it is not a glTF file");
    } else if (c == ']' || c == '}') {
      depth--;
    }
  }
}

static Json parse_json(const GltfFile& file, Bytes text) {
  check_depth(file, text);
  try {
    Json json = Json::parse(text.begin(), text.end());
    if (!json.is_object()) fail(file, "is not a glTF file");
    return json;
  } catch (const Json::parse_error& error) {
    fail(file, fmt::format("is not a glTF file, or a damaged one: its JSON is broken at byte {}", error.byte));
  } catch (const Json::exception&) {
    fail(file, "is not a glTF file, or a damaged one: its JSON holds a number that is too large");
  }
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

// The same for every way to write the same file, so that nothing is read twice.
static std::string uri_key(const std::string& uri) {
  return uri.starts_with("data:") ? uri : std::filesystem::path(decode_percent(uri)).lexically_normal().string();
}

static Storage read_data_uri(const GltfFile& file, const std::string& uri) {
  const size_t comma = uri.find(";base64,");
  if (comma == std::string::npos) fail(file, "has a data URI that is not in base64");
  const std::string bytes = decode_base64(std::string_view(uri).substr(comma + 8));
  return share({bytes.begin(), bytes.end()});
}

// The file that a URI names.
static std::string uri_path(const GltfFile& file, const std::string& uri) {
  if (uri.find("://") != std::string::npos) {
    fail(file,
         fmt::format("refers to {}; ods does not fetch from the network, put the file beside it", printable(uri)));
  }
  const std::string name = decode_percent(uri);
  if (name.empty() || name.find('\0') != std::string::npos) fail(file, "refers to a file without a name");
  return (std::filesystem::path(file.path).parent_path() / name).string();
}

// The first `most` bytes of what a URI names: a file may be larger than what is asked of it.
static Storage read_uri(const GltfFile& file, const std::string& uri, size_t most) {
  if (uri.starts_with("data:")) return read_data_uri(file, uri);
  const std::string path = uri_path(file, uri);
  try {
    return share(read_start(path, most));
  } catch (const Error& error) {
    const size_t known = fmt::format("cannot read '{}': ", path).size();  // which the URI says in few words
    fail(file, fmt::format("refers to {}: {}", printable(uri), std::string_view(error.what()).substr(known)));
  }
}

// --- buffers and pictures

static size_t buffer_length(const GltfFile& file, const Json& buffer, size_t index) {
  const bool sound = buffer.is_object() && buffer.contains("byteLength") && buffer["byteLength"].is_number_unsigned();
  if (!sound) fail(file, fmt::format("buffer {} has no length", index));
  return buffer["byteLength"].get<size_t>();
}

static bool has_uri(const Json& object) {
  return object.contains("uri") && object["uri"].is_string();
}

static void take_buffers(GltfFile& file, const Json& json, Bytes binary) {
  std::map<std::string, size_t> lengths;  // how much of each file is needed
  for (size_t i = 0; i < json.size(); i++) {
    const size_t length = buffer_length(file, json[i], i);
    if (!has_uri(json[i])) continue;
    size_t& longest = lengths[uri_key(json[i]["uri"].get<std::string>())];
    longest = std::max(longest, length);
  }
  std::map<std::string, Storage> loaded;
  for (size_t i = 0; i < json.size(); i++) {
    Bytes bytes = binary;
    if (has_uri(json[i])) {
      const std::string uri = json[i]["uri"].get<std::string>(), key = uri_key(uri);
      Storage& storage = loaded[key];
      if (!storage) {
        storage = read_uri(file, uri, lengths[key]);
        file.storage.push_back(storage);
        file.size += storage->size();
      }
      bytes = *storage;
    } else if (i > 0) {
      fail(file, fmt::format("buffer {} has no data", i));
    }
    const size_t length = buffer_length(file, json[i], i);
    if (length > bytes.size()) {
      fail(file,
           fmt::format("buffer {} has {} bytes, but should have {}; the file is damaged", i, bytes.size(), length));
    }
    file.buffers.push_back(bytes.first(length));
  }
}

static void take_images(GltfFile& file, const Json& json) {
  std::map<std::pair<std::string, int>, size_t> first;
  for (const Json& image : json) {
    const size_t index = file.images.size();
    if (!image.is_object()) fail(file, fmt::format("image {} is not an object", index));
    ImageSource source;
    if (has_uri(image)) source.uri = image["uri"].get<std::string>();
    if (image.contains("bufferView") && image["bufferView"].is_number_integer())
      source.view = image["bufferView"].get<int>();
    source.first = first.emplace(std::pair(uri_key(source.uri), source.view), index).first->second;
    file.images.push_back(source);
  }
}

// --- animations, which tinygltf drops where they name no node

static int index_in(const Json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  const bool sound = object.is_object() && found != object.end() && found->is_number_integer();
  return sound ? static_cast<int>(std::clamp<int64_t>(found->get<int64_t>(), -1, INT32_MAX)) : -1;
}

static std::string text_in(const Json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

static const Json& member(const Json& object, const char* key) {
  static const Json kNone = Json::array();
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() ? *found : kNone;
}

static void take_clips(GltfFile& file, const Json& json) {
  for (const Json& animation : json) {
    ClipSource clip{text_in(animation, "name"), {}};
    if (clip.name.empty()) clip.name = fmt::format("animation {}", file.clips.size());
    const Json& samplers = member(animation, "samplers");
    if (!samplers.is_array()) fail(file, "has an animation whose samplers are not a list");
    for (const Json& source : member(animation, "channels")) {
      const Json& target = member(source, "target");
      const Json& sampler = element(file, samplers, index_in(source, "sampler"), "animation sampler");
      ChannelSource channel{index_in(sampler, "input"), index_in(sampler, "output"), text_in(sampler, "interpolation"),
                            index_in(target, "node"), text_in(target, "path")};
      if (channel.path == "pointer") {
        channel.path = text_in(member(member(target, "extensions"), "KHR_animation_pointer"), "pointer");
      }
      clip.channels.push_back(channel);
    }
    file.clips.push_back(std::move(clip));
  }
}

// Takes a member out of the document.
static Json take(const GltfFile& file, Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end()) return Json::array();
  Json value = std::move(*found);
  json.erase(found);
  if (!value.is_array()) fail(file, fmt::format("{} is not a list", key));
  return value;
}

Bytes buffer_view_bytes(const GltfFile& file, int index) {
  const tinygltf::BufferView& view = element(file, file.model->bufferViews, index, "buffer view");
  const Bytes buffer = element(file, file.buffers, view.buffer, "buffer");
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
    fail(file, fmt::format("buffer view {} runs past the end of its buffer; the file is damaged", index));
  }
  return buffer.subspan(view.byteOffset, view.byteLength);
}

size_t external_bytes(const GltfFile& file, const ImageSource& image) {
  if (image.uri.empty() || image.uri.starts_with("data:")) return 0;
  const std::string path = uri_path(file, image.uri);
  try {
    return file_size(path);
  } catch (const Error&) {
    return 0;  // whoever reads it says why
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

static std::shared_ptr<const tinygltf::Model> parse_model(const GltfFile& file, const Json& json) {
  const std::string text = json.dump();
  if (text.size() > std::numeric_limits<unsigned int>::max()) fail(file, "has more than 4 GB of JSON");
  auto model = std::make_shared<tinygltf::Model>();
  tinygltf::TinyGLTF reader;
  std::string errors, warnings;
  bool sound = false;
  try {
    sound = reader.LoadASCIIFromString(model.get(), &errors, &warnings, text.c_str(),
                                       static_cast<unsigned int>(text.size()), "");
  } catch (const std::exception& error) {
    errors = error.what();
  }
  if (!sound) fail(file, fmt::format("is not a valid glTF file: {}", printable(errors.substr(0, errors.find('\n')))));
  if (!model->asset.version.starts_with("2.")) {
    fail(file, fmt::format("is glTF version {}, ods reads 2.0", printable(model->asset.version)));
  }
  return model;
}

static void parse(GltfFile& file, Bytes bytes) {
  file.size = bytes.size();
  const Chunks chunks = split_container(file, bytes);
  Json json = parse_json(file, chunks.json);
  const Json buffers = take(file, json, "buffers");
  const Json images = take(file, json, "images");
  take_clips(file, take(file, json, "animations"));
  file.model = parse_model(file, json);
  take_buffers(file, buffers, chunks.binary);
  take_images(file, images);
  file.budget = (size_t(1) << 20) + 16 * file.size;
}

// A container says its length; what is no container is text, and should look like it before it is read.
static std::vector<unsigned char> read_scene_file(const GltfFile& file) {
  constexpr size_t kLongestText = size_t(1) << 30;
  const std::vector<unsigned char> start = read_start(file.path, 64);
  if (is_container(start)) return read_start(file.path, start.size() < 12 ? start.size() : read_uint32(start, 8));
  const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
  const size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first != std::string_view::npos && text[first] != '{') fail(file, "is not a glTF file");
  return read_file(file.path, kLongestText);
}

GltfFile open_gltf(const std::string& path) {
  GltfFile file;
  file.path = path;
  file.storage.push_back(share(read_scene_file(file)));
  parse(file, *file.storage.front());
  return file;
}

GltfFile open_gltf_bytes(Bytes bytes, const std::string& path) {
  GltfFile file;
  file.path = path;
  parse(file, bytes);
  return file;
}

}  // namespace ods

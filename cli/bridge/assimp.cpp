// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bridge/assimp.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <vector>

#include "cli/bridge/blender.h"
#include "cli/bridge/scene_cache.h"
#include "cli/console/programs.h"
#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "ods/base/text.h"
#include "ods/files/atomic_file.h"
#include "ods/files/read_file.h"
#include "ods/image/format/file_format.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr size_t kMaxBytes = size_t{4} << 30u;  // a .glb counts them in 32 bits
constexpr uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;

// A .glb: a head of 12 bytes, then chunks of a length, a kind and that many bytes.
struct Glb {
  json content;
  std::string binary;  // the first buffer
};

uint32_t number_at(const std::string& bytes, size_t at) {
  uint32_t number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof(number));
  return number;
}

std::string number(size_t value) {
  const auto bits = static_cast<uint32_t>(value);
  return {reinterpret_cast<const char*>(&bits), sizeof(bits)};
}

// Assimp writes names as it finds them, in Latin-1 too.
Glb read_glb(const std::string& path) {
  const std::string bytes = ods::read_text(path, kMaxBytes);
  Glb glb;
  for (size_t at = 12; at + 8 <= bytes.size(); at += 8 + size_t{number_at(bytes, at)}) {
    const std::string chunk = bytes.substr(at + 8, number_at(bytes, at));
    if (number_at(bytes, at + 4) == kJson) glb.content = json::parse(ods::valid_utf8(chunk), nullptr, false);
    if (number_at(bytes, at + 4) == kBinary) glb.binary = chunk;
  }
  return glb;
}

void pad(std::string& chunk, char filler) {
  chunk.resize((chunk.size() + 3) / 4 * 4, filler);
}

void write_glb(const std::string& path, Glb glb) {
  std::string text = glb.content.dump();
  pad(text, ' ');
  pad(glb.binary, '\0');
  const size_t size = 12 + 8 + text.size() + 8 + glb.binary.size();
  ods::write_file(path, "glTF" + number(2) + number(size) + number(text.size()) + number(kJson) + text +
                            number(glb.binary.size()) + number(kBinary) + glb.binary);
}

// Returns the file that a scene refers to: its path from the scene's folder, with slashes of either kind, else the file
// of that name beside the scene, in any letter case; empty if there is none. An absolute path is never followed, as in
// glTF: the scene may be untrusted.
std::string find_picture(const fs::path& folder, std::string path) {
  std::ranges::replace(path, '\\', '/');
  std::error_code error;
  if (!path.starts_with('/') && fs::is_regular_file(folder / path, error))
    return (folder / path).lexically_normal().native();
  const std::string wanted = ods::small_letters(fs::path(path).filename().native());
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (ods::small_letters(entry.path().filename().native()) != wanted || !entry.is_regular_file(error)) continue;
    return entry.path().native();
  }
  return "";
}

bool is_picture(const std::string& bytes) {
  return ods::format_of_bytes(std::as_bytes(std::span(bytes))).has_value();
}

// Returns the bytes inside the file itself; empty if its numbers are wrong.
std::string bytes_of_view(const Glb& glb, const json& image) {
  const json view = glb.content.value(
      json::json_pointer(fmt::format("/bufferViews/{}", ods::json_document(image["bufferView"]))), json::object());
  const size_t offset = view.value("byteOffset", size_t{0}), length = view.value("byteLength", size_t{0});
  return offset <= glb.binary.size() ? glb.binary.substr(offset, length) : "";
}

void add_picture(Glb& glb, json& image, const std::string& bytes) {
  pad(glb.binary, '\0');
  json& views = glb.content["bufferViews"];
  image = {{"bufferView", views.size()}};
  views.push_back({{"buffer", 0}, {"byteOffset", glb.binary.size()}, {"byteLength", bytes.size()}});
  glb.binary += bytes;
  glb.content["buffers"][0]["byteLength"] = glb.binary.size();
}

// Removes the textures that show one of these images. Otherwise a surface with such an emissive picture would glow all
// over.
void remove_textures(json& node, const json& textures, const std::set<size_t>& images) {
  if (!node.is_structured()) return;
  std::vector<std::string> keys;
  for (auto& [key, part] : node.items()) {
    const bool is_texture = key.ends_with("Texture") && part.is_object() && part.contains("index");
    const json image = is_texture ? textures.at(part["index"].get<size_t>()).value("source", json()) : json();
    if (image.is_number_unsigned() && images.contains(image)) keys.push_back(key);
    remove_textures(part, textures, images);
  }
  for (const std::string& key : keys) {
    node.erase(key);
    if (key == "emissiveTexture") node.erase("emissiveFactor");
  }
}

// Assimp prints its errors on stdout: "ERROR: Failed to load file: WHY".
std::string assimp_error(const std::optional<ProgramResult>& result) {
  if (!result) return "";
  std::string words = result->last_line;
  std::istringstream lines(result->out);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("ERROR") || words.empty()) words = ods::one_line(line);
  }
  return words.empty() ? "" : fmt::format("; its output: {}", words);
}

// Puts the pictures into the file: Assimp leaves their paths as in the scene, relative to its folder.
json take_pictures(Glb& glb, const std::string& scene) {
  const fs::path folder = fs::absolute(scene).parent_path();
  json answer = {{"omnistereo_bridge", 1}, {"warnings", json::array()}, {"reads", json::array()}};
  std::vector<std::string> names;
  std::set<size_t> missing;
  json& images = glb.content["images"];
  for (size_t i = 0; i < images.size(); i++) {
    json& image = images[i];
    const std::string path = image.value("uri", "");
    if (path.starts_with("data:")) continue;
    const std::string file = path.empty() ? "" : find_picture(folder, path);
    std::string bytes;
    if (!file.empty()) bytes = ods::read_text(file, kMaxBytes), answer["reads"].push_back(state_of(file));
    if (path.empty() && image.contains("bufferView")) bytes = bytes_of_view(glb, image);
    if (is_picture(bytes)) {
      if (!file.empty()) add_picture(glb, image, bytes);
      continue;
    }
    missing.insert(i);
    names.push_back(fmt::format("'{}'", path.empty() ? image.value("name", fmt::format("image {}", i)) : path));
    image = {{"uri", "data:,"}};
  }
  if (images.empty()) glb.content.erase("images");
  if (missing.empty()) return answer;
  remove_textures(glb.content["materials"], glb.content["textures"], missing);
  answer["warnings"].push_back(fmt::format("there is no picture {}, or none that is read ({})", fmt::join(names, ", "),
                                           ods::readable_extensions()));
  return answer;
}

}  // namespace

bool has_assimp() {
  return has_program("assimp");
}

void run_assimp(const std::string& scene, const std::string& folder, float seconds) {
  const std::string made = folder + "/scene.glb";
  const Program assimp = {
      .words = {"assimp", "export", fs::absolute(scene).native(), made, "-fglb2"}, .limit = seconds, .folder = folder};
  const auto result = run_program(assimp);
  const std::string fault = fmt::format("'{}': Assimp cannot read it", scene);
  if (result && !result->in_time) fail_in_time("Assimp", scene, seconds);
  if (!result || result->code != 0 || !fs::exists(made)) {
    throw ods::Error(ods::ErrorKind::kInput, fault + assimp_error(result));
  }
  try {
    Glb glb = read_glb(made);
    const json answer = take_pictures(glb, scene);
    write_glb(made, std::move(glb));
    ods::write_file(folder + "/bridge.json", ods::json_document(answer));
  } catch (const json::exception& error) {
    throw ods::Error(ods::ErrorKind::kInput, fmt::format("{}: {}", fault, error.what()));
  }
}

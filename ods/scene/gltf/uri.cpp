// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "ods/base/base64.h"
#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/files/confined_file.h"
#include "ods/files/read_file.h"
#include "ods/scene/gltf/parts.h"

namespace fs = std::filesystem;

namespace ods {

// --- the parts of a URI

bool is_data_uri(const std::string& uri) {
  return uri.starts_with("data:");
}

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

// Returns whether a URI starts with a scheme, such as "file:" and "https:" (RFC 3986).
static bool has_scheme(const std::string& uri) {
  const size_t colon = uri.find_first_of(":/?#%");
  return colon != std::string::npos && uri[colon] == ':';
}

static std::string normal(const std::string& name) {
  return fs::path(name).lexically_normal().generic_string();
}

static bool is_relative(const std::string& name) {
  return !name.empty() && name.find('\0') == std::string::npos && !name.starts_with('/');
}

// --- the file of a URI

static std::string path_of(const GltfFile& file, const std::string& name) {
  return (fs::path(file.path).parent_path() / name).string();
}

static std::string name_in_archive(const GltfFile& file, const std::string& name) {
  return normal((fs::path(file.folder) / name).generic_string());
}

static bool exists(const GltfFile& file, const std::string& name) {
  if (file.archive) return file.archive->holds(name_in_archive(file, name));
  try {
    ConfinedFile(path_of(file, name), file.confine).read(file_size);
    return true;
  } catch (const Error&) {
    return false;
  }
}

// The first entry of the folder with this name in any letter case; the name itself if there is none, or if reading the
// folder is not allowed.
static fs::path entry_in(const GltfFile& file, const fs::path& folder, const fs::path& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return name;
  const fs::path real = fs::weakly_canonical(fs::absolute(folder), error) / "", limit = fs::path(file.confine) / "";
  if (!file.confine.empty() && !real.native().starts_with(limit.native())) return name;
  fs::path found;
  const std::string small = small_letters(name.native());
  for (fs::directory_iterator at(folder, error), end; at != end; at.increment(error)) {
    const fs::path other = at->path().filename();
    if (small_letters(other.native()) == small && (found.empty() || other < found)) found = other;
  }
  return found.empty() ? name : found;
}

// The name in the letter case of the existing file; empty if there is none.
static std::string find_ignoring_case(const GltfFile& file, const std::string& name) {
  if (file.archive) {
    const std::string found = file.archive->find_ignoring_case(name_in_archive(file, name));
    return found.empty() ? "" : fs::path(found).lexically_relative(file.folder).generic_string();
  }
  const fs::path folder = fs::path(file.path).parent_path();
  fs::path found;
  for (const fs::path& part : fs::path(normal(name))) {
    found /= part == ".." ? part : entry_in(file, folder.empty() ? "." / found : folder / found, part);
  }
  return exists(file, found.generic_string()) ? found.generic_string() : "";
}

// Possible meanings of a URI, the most likely first: with percent codes decoded once, not at all, or twice; each also
// with the slashes of Windows.
static std::vector<std::string> readings(const std::string& uri) {
  const std::string decoded = decode_percent(uri);
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (is_relative(name) && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (std::string name : {decoded, uri, decode_percent(decoded)}) {
    add(name);
    std::replace(name.begin(), name.end(), '\\', '/');
    add(name);
  }
  return names;
}

std::string resolve_uri(GltfFile& file, const std::string& uri) {
  if (is_data_uri(uri)) return uri;
  const std::string plain = decode_percent(uri);
  if (!is_relative(plain) || has_scheme(uri) || exists(file, plain)) return normal(plain);
  constexpr int kMaxSearches = 1000;  // each may list a folder, and a file may contain a million URIs
  if (++file.searches > kMaxSearches) return normal(plain);
  const std::vector<std::string> names = readings(uri);
  std::string found;
  for (const std::string& name : names) {
    if (found.empty() && exists(file, name)) found = normal(name);
  }
  for (const std::string& name : names) {
    if (found.empty()) found = find_ignoring_case(file, name);
  }
  if (found.empty()) return normal(plain);
  file.renamed.emplace(uri, found);
  return found;
}

// --- the bytes of a URI

static Storage read_data_uri(const GltfFile& file, const std::string& uri) {
  const size_t comma = uri.find(";base64,");
  if (comma == std::string::npos) fail(file, "has a data URI that is not base64");
  const std::string bytes = decode_base64(std::string_view(uri).substr(comma + 8));
  return std::make_shared<std::vector<unsigned char>>(bytes.begin(), bytes.end());
}

static void check_uri(const GltfFile& file, const std::string& uri) {
  const std::string name = decode_percent(uri);
  if (name.empty() || name.find('\0') != std::string::npos) fail(file, "refers to a file without a name");
  if (has_scheme(uri) || name.starts_with('/')) {
    fail(file, fmt::format("refers to {}; ods reads only files that are named relative to the scene, and fetches "
                           "nothing from the network: put the file beside it",
                           printable(uri)));
  }
}

static std::vector<unsigned char> read_neighbour(const GltfFile& file, const std::string& name, size_t maximum) {
  if (file.archive) return file.archive->read(name_in_archive(file, name));
  return ConfinedFile(path_of(file, name), file.confine).read([&](const std::string& opened) {
    return read_start(opened, maximum);
  });
}

Storage read_uri(const GltfFile& file, const std::string& uri, const std::string& name, size_t maximum) {
  if (is_data_uri(uri)) return read_data_uri(file, uri);
  check_uri(file, uri);
  try {
    return std::make_shared<std::vector<unsigned char>>(read_neighbour(file, name, maximum));
  } catch (const Error& error) {
    if (!file.confine.empty() && !file.archive) {  // must reveal nothing about files outside the folder
      if (error.kind() != ErrorKind::kInput) throw;
      fail(file, fmt::format("refers to {}, which does not exist, is outside the folder that scenes are confined "
                             "to, or cannot be read",
                             printable(uri)));
    }
    std::string_view why = error.what();
    const std::string known = fmt::format("cannot read '{}': ", file.archive ? file.path : path_of(file, name));
    if (why.starts_with(known)) why.remove_prefix(known.size());
    throw Error(error.kind(), fmt::format("{}: refers to {}: {}", file.path, printable(uri), why));
  }
}

size_t external_bytes(const GltfFile& file, const ImageSource& image) {
  if (image.uri.empty() || is_data_uri(image.uri)) return 0;
  check_uri(file, image.uri);
  if (file.archive) return file.archive->size_of(name_in_archive(file, image.name));
  try {
    return ConfinedFile(path_of(file, image.name), file.confine).read(file_size);
  } catch (const Error&) {
    return 0;  // reading it reports the fault
  }
}

void warn_renamed(const GltfFile& file, Scene& scene) {
  if (file.renamed.empty()) return;
  const auto& [uri, name] = *file.renamed.begin();
  const size_t others = file.renamed.size() - 1;
  warn(scene, fmt::format("it refers to '{}', which does not exist: read '{}' instead{}", printable(uri),
                          printable(name), others == 0 ? "" : fmt::format(", and {} more", others)));
}

}  // namespace ods

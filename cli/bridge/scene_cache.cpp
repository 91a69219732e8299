// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bridge/scene_cache.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/console/user_folder.h"
#include "ods/base/checksum.h"
#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "ods/files/atomic_file.h"
#include "ods/files/file_input.h"
#include "ods/files/md5.h"
#include "ods/files/private_folder.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr auto kInUse = std::chrono::hours(1);

constexpr const char* kMade[] = {"scene.glb", "world.exr"};
constexpr const char* kContents = "contents";  // the key of contents_of() in bridge.json

json read_json(const fs::path& path) {
  std::ifstream file(path);
  return json::parse(file, nullptr, false);
}

// Size and checksum of the files of a conversion, by name: a machine that lost its power may have cut it short.
json contents_of(const std::string& folder) {
  json contents = json::object();
  for (const char* name : kMade) {
    std::error_code error;
    const std::string path = folder + "/" + name;
    if (!fs::is_regular_file(path, error)) continue;
    const ods::FileInput file(path);
    uint32_t sum = 0;
    constexpr uint64_t kPiece = uint64_t{4} << 20u;
    for (uint64_t at = 0; at < file.size(); at += kPiece) {
      sum = ods::crc32(file.read(at, std::min(kPiece, file.size() - at)), sum);
    }
    contents[name] = {file.size(), sum};
  }
  return contents;
}

struct Kept {
  fs::path folder;
  fs::file_time_type used;
  uint64_t bytes = 0;
};

std::vector<Kept> kept_scenes(const fs::path& cache) {
  std::vector<Kept> scenes;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(cache, error)) {
    const fs::path mark = entry.path() / "bridge.json";
    const bool is_unfinished = entry.path().filename().native().starts_with('.');
    if (is_unfinished || !fs::exists(mark, error)) continue;
    Kept& scene = scenes.emplace_back(Kept{entry.path(), fs::last_write_time(mark, error), 0});
    for (const fs::directory_entry& file : fs::directory_iterator(entry.path(), error)) {
      scene.bytes += file.file_size(error);
    }
  }
  std::ranges::sort(scenes, {}, &Kept::used);
  return scenes;
}

void remove_oldest(const fs::path& cache, const fs::path& newest) {
  std::vector<Kept> scenes = kept_scenes(cache);
  uint64_t bytes = 0;
  for (const Kept& scene : scenes) bytes += scene.bytes;
  size_t count = scenes.size();
  for (const Kept& scene : scenes) {
    if (count <= kMaxKeptScenes && bytes <= kMaxKeptBytes) return;
    if (scene.folder == newest || fs::file_time_type::clock::now() - scene.used < kInUse) continue;
    std::error_code ignored;
    fs::remove(scene.folder / "bridge.json", ignored);
    fs::remove_all(scene.folder, ignored);
    bytes -= scene.bytes;
    count--;
  }
}

}  // namespace

json state_of(const std::string& path) {
  struct stat found = {};
  if (stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return {};
  return {path, int64_t{found.st_size}, int64_t{found.st_mtim.tv_sec} * 1'000'000'000 + found.st_mtim.tv_nsec};
}

// A folder in the user's cache folder for ods.
static std::string own_cache_folder(const std::string& name) {
  const std::string folder = user_folder("XDG_CACHE_HOME", ".cache");
  try {
    if (folder.empty()) throw ods::Error(ods::ErrorKind::kOutput, "there is no home folder for converted scenes");
    for (const std::string& each : {folder, folder + "/" + name}) ods::make_own_folder(each);
  } catch (const ods::Error& error) {
    throw ods::Error(error.kind(), fmt::format("{}; XDG_CACHE_HOME names another folder", error.what()));
  }
  return folder + "/" + name;
}

std::string cache_folder() {
  return own_cache_folder("scenes");
}

std::string python_cache_folder() {
  return own_cache_folder("python");
}

std::string kept_scene(const std::string& file, const std::string& how) {
  std::error_code error;
  const fs::path path = fs::canonical(file, error);
  const json state = error ? json() : state_of(path.native());
  if (state.is_null()) throw ods::Error(ods::ErrorKind::kInput, fmt::format("{}: no such file", file));
  return (fs::path(cache_folder()) / ods::md5(fmt::format("{}\n{} {}\n{}", path.native(), ods::json_document(state[1]),
                                                          ods::json_document(state[2]), how)))
      .native();
}

bool is_kept(const std::string& folder) {
  const fs::path mark = fs::path(folder) / "bridge.json";
  const json found = read_json(mark);
  if (!found.is_object() || found.value(kContents, json()) != contents_of(folder)) return false;
  for (const json& each : found.value("reads", json::array())) {
    if (!each.is_array() || each.empty() || !each[0].is_string() || state_of(each[0]) != each) return false;
  }
  std::error_code ignored;
  fs::last_write_time(mark, fs::file_time_type::clock::now(), ignored);
  return true;
}

void keep_scene(const std::string& made, const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  const fs::path to(folder);
  fs::remove(to / "bridge.json", error);
  for (const char* name : kMade) {
    const fs::path from = fs::path(made) / name;
    if (fs::exists(from, error)) {
      fs::rename(from, to / name, error);
    } else {
      fs::remove(to / name, error);
    }
    if (error) {
      throw ods::Error(ods::ErrorKind::kOutput, fmt::format("cannot write in '{}': {}", folder, error.message()));
    }
  }
  json found = read_json(fs::path(made) / "bridge.json");
  if (found.is_object()) found[kContents] = contents_of(folder);
  ods::write_file((to / "bridge.json").native(), ods::json_document(found));
  remove_oldest(to.parent_path(), to);
}

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bridge/scene_cache.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "ods/base/error.h"
#include "ods/files/md5.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr auto kInUse = std::chrono::hours(1);

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
    if (!fs::exists(mark, error)) continue;
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
    if (count <= kMostKeptScenes && bytes <= kMostKeptBytes) return;
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

std::string cache_folder() {
  const char* const own = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  fs::path folder = fs::temp_directory_path() / fmt::format("ods-{}", getuid());
  if (own && *own == '/') {
    folder = fs::path(own) / "ods";
  } else if (home && *home == '/') {
    folder = fs::path(home) / ".cache" / "ods";
  }
  folder /= "scenes";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || chmod(folder.c_str(), S_IRWXU) != 0) {
    throw ods::Error(
        ods::ErrorKind::kOutput,
        fmt::format("cannot keep converted scenes in '{}'; XDG_CACHE_HOME names another folder", folder.native()));
  }
  return folder.native();
}

std::string kept_scene(const std::string& file, const std::string& how) {
  std::error_code error;
  const fs::path path = fs::canonical(file, error);
  const json state = error ? json() : state_of(path.native());
  if (state.is_null()) throw ods::Error(ods::ErrorKind::kInput, fmt::format("{}: no such file", file));
  return (fs::path(cache_folder()) /
          ods::md5(fmt::format("{}\n{} {}\n{}", path.native(), state[1].dump(), state[2].dump(), how)))
      .native();
}

bool is_kept(const std::string& folder) {
  const fs::path mark = fs::path(folder) / "bridge.json";
  std::ifstream file(mark);
  const json found = json::parse(file, nullptr, false);
  if (!found.is_object() || !fs::exists(fs::path(folder) / "scene.glb")) return false;
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
  for (const char* name : {"scene.glb", "world.exr", "bridge.json"}) {
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
  remove_oldest(to.parent_path(), to);
}

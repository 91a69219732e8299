// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes that other programs have converted, kept in the user's cache folder: $XDG_CACHE_HOME/ods/scenes, by default
// ~/.cache/ods/scenes. Each is a folder with scene.glb, perhaps world.exr, and bridge.json, which has the checksums of
// both.
#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

inline constexpr size_t kMaxKeptScenes = 40;
inline constexpr uint64_t kMaxKeptBytes = uint64_t{8} << 30u;

// Returns the state of a file as in the list `reads` of bridge.json: path, size, nanoseconds of its time. Null if the
// file does not exist.
nlohmann::json state_of(const std::string& path);

// The cache's folder, made if need be, for this user alone. Throws Error(kOutput): also if another user could have put
// files there.
std::string cache_folder();

// The folder for the compiled Python of Blender's exporter, with the same protection. Throws Error(kOutput).
std::string python_cache_folder();

// Returns the folder of a kept scene. Its name follows from the file (its path, size and time) and from `how`, all
// other inputs of the conversion. Throws Error(kInput) if there is no such file.
std::string kept_scene(const std::string& file, const std::string& how);

// Returns whether a kept scene exists and is unchanged, and so are the files that it was made from. If so, marks it as
// used now.
bool is_kept(const std::string& folder);

// Moves the result of a conversion into the cache, bridge.json last. Then removes the least recently used scenes until
// the cache is within its bounds, except for this one and those used within an hour.
void keep_scene(const std::string& made, const std::string& folder);

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

inline constexpr size_t kMostKeptScenes = 40;
inline constexpr uint64_t kMostKeptBytes = uint64_t{8} << 30u;

// A file as it stands, as bridge.json has those that a conversion `reads`: path, size, nanoseconds of its time. Null if
// there is none.
nlohmann::json state_of(const std::string& path);

// The cache's folder, made if need be, for this user alone. Throws Error(kOutput): also if another user could have put
// files there.
std::string cache_folder();

// What is kept of a scene: the folder's name follows from the file (its path, size and time) and from `how`, all else
// that decides what comes out. Throws Error(kInput): there is no such file.
std::string kept_scene(const std::string& file, const std::string& how);

// Whether a kept scene is there, as it was made, and made of files that are still as they were then. If so it counts as
// used now.
bool is_kept(const std::string& folder);

// Moves what a conversion has made to where it is kept; bridge.json goes last. Then the scenes that were used longest
// ago are removed until the cache is within its bounds; not this one, and none that was used within an hour.
void keep_scene(const std::string& made, const std::string& folder);

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/copy_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/console/console.h"
#include "ods/base/error.h"

namespace fs = std::filesystem;

namespace {

// Returns the destination of every file. Files beside the scene keep their places beside it.
FileCopies plan_moves(const SplitCommand& split, const fs::path& inputs) {
  FileCopies moves, back;
  const auto add = [&](const std::string& from, const fs::path& place) {
    const std::string to = (inputs / place).lexically_normal().native();
    const auto [other, is_new] = back.emplace(to, from);
    if (!is_new && other->second != from) {
      throw UsageError(fmt::format("--copy-scene: '{}' and '{}' would be one file", other->second, from));
    }
    moves[from] = to;
  };
  const fs::path scene_folder = fs::path(split.groups.front().command.at(1)).parent_path();
  for (const std::string& file : split.scene_files) {
    const fs::path place = fs::path(file).lexically_relative(scene_folder);
    if (place.native().starts_with("..")) {
      throw UsageError(fmt::format("--copy-scene: '{}' is outside the scene's folder; pack the scene as .glb", file));
    }
    add(file, place);
  }
  for (const ods::PlanPath& path : split.paths) {
    if (!path.is_output && !path.is_folder) add(path.path, fs::path(path.path).filename());
  }
  if (!split.scene_files.empty()) moves[scene_folder.native()] = inputs.native();
  return moves;
}

void copy(const std::string& from, const std::string& to) {
  std::error_code error;
  if (fs::is_directory(from, error)) return;
  fs::create_directories(fs::path(to).parent_path(), error);
  if (!error) fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (!error) return;
  throw ods::Error(ods::ErrorKind::kOutput, fmt::format("cannot copy '{}' to '{}': {}", from, to, error.message()));
}

}  // namespace

FileCopies move_inputs(SplitCommand& split, const std::string& folder) {
  if (std::ranges::find(split.groups.front().command, "--confine") != split.groups.front().command.end()) {
    throw UsageError("--copy-scene and --confine exclude each other: the copies are in another folder");
  }
  const FileCopies moves = plan_moves(split, fs::path(folder) / "inputs");
  const auto move = [&](std::string& path) {
    const auto found = moves.find(path);
    if (found != moves.end()) path = found->second;
  };
  for (ods::PlanPath& path : split.paths) {
    if (!path.is_output) move(path.path);
  }
  for (ods::TaskGroup& group : split.groups) {
    for (std::string& word : group.command) move(word);
  }
  return moves;
}

void copy_files(const FileCopies& copies) {
  for (const auto& [from, to] : copies) copy(from, to);
}

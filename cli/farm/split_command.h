// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A command line of ods video, render or stitch, split for a farm. The command's own parser reads it; its files become
// absolute, and are checked.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ods/farm/plan.h"

// The group that a plan may have before the first of a SplitCommand.
inline constexpr const char* kRawGroup = "raw";

struct SplitCommand {
  std::string output;                    // the file, or the pattern of the frames, absolute
  std::vector<ods::TaskGroup> groups;    // the first is split; its tasks are not counted yet
  std::vector<ods::PlanPath> paths;      // that the commands name
  std::vector<std::string> scene_files;  // beside the scene: buffers and pictures
  size_t memory = 0;                     // bytes that a task takes
  size_t disk = 0;                       // that all parts take, or all raw frames, at most
  std::optional<int> threads;            // that the command asks for
  bool restart = false;                  // existing files are discarded
  std::string noun;                      // the product of the tasks: "frame", "part", "view"
  size_t count = 0;                      // the number of products
  std::vector<int> numbers;              // their numbers
  std::optional<ods::TaskGroup> raw;     // before the first group, if that is cheaper: renders its frames raw
  int halo = 0;                          // extra frames that a task renders on each side of its range, for the denoiser
  std::function<void()> prepare = [] {};  // writes the files that must exist before the first task starts
};

// words: "video", "scene.glb", "-o", ... Throws UsageError for a command that cannot be split, and as the command's
// parse() does.
SplitCommand split_command(const std::vector<std::string>& words);

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The arguments of a command that is split: with absolute names of files, and without the options that the farm sets.
#pragma once
#include <string>
#include <vector>

#include "cli/console/options.h"
#include "ods/farm/plan.h"

// Returns the files and folders that the arguments name, and makes them absolute.
std::vector<ods::PlanPath> find_paths(std::vector<GivenWord>& given);

// Throws Error(kInput) for input files that cannot be opened.
void check_inputs(const std::vector<ods::PlanPath>& paths);

// Returns the arguments without these options.
std::vector<GivenWord> without(const std::vector<GivenWord>& given, const std::vector<std::string>& names);
// Returns the arguments with only these options.
std::vector<GivenWord> only(const std::vector<GivenWord>& given, const std::vector<std::string>& names);

// Throws UsageError if one of these is given.
void refuse(const std::vector<GivenWord>& given, const std::vector<std::string>& names, const std::string& why);

// "video", "/home/me/scene.glb", "-o", "/home/me/a.mp4", "--position=-1,0,2".
std::vector<std::string> command_words(const std::string& command, const std::vector<GivenWord>& given,
                                       const std::vector<std::string>& more = {});

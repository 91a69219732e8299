// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <string>

#include "cli/farm/split_command.h"

using FileCopies = std::map<std::string, std::string>;  // from, to

// Names the scene, with the files beside it, and the other input files as if they were in FOLDER/inputs, for machines
// that do not see the originals. Returns the files to be copied there. Throws UsageError if two of them have the same
// name.
FileCopies move_inputs(SplitCommand& split, const std::string& folder);

// Throws ods::Error(kOutput).
void copy_files(const FileCopies& copies);

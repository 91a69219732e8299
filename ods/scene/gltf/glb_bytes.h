// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace ods {

// Returns the bytes of a GLB of version 2: its JSON, and its binary chunk unless that is empty. Throws Error(kOutput),
// with the name of the file and the remedy, if there are 4 GB or more.
std::string glb_bytes(const std::string& json, const std::string& binary, const std::string& path,
                      const std::string& remedy);

}  // namespace ods

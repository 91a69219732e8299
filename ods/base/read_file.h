// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A file's bytes.
#pragma once
#include <string>
#include <vector>

namespace ods {

// The whole file. Throws Error(kInput): there is none, it is a folder or a device, or it may not be read.
std::vector<unsigned char> read_file(const std::string& path);

}  // namespace ods

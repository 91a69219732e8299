// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Folders on the build machine. They are functions, because with a path in every file's flags, each clone of the
// repository would compile all tests again.
#pragma once
#include <string>

namespace ods {

std::string source_folder();  // root of the repository
std::string shared_scenes();  // a folder that may be missing
std::string ods_command();
std::string glslang();

}  // namespace ods

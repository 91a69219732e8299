// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where things lie on the machine that builds. As functions: a path in every file's flags would have each clone of the
// repository compile all tests anew.
#pragma once
#include <string>

namespace ods {

std::string source_folder();  // of the repository
std::string shared_scenes();  // a folder that need not exist
std::string ods_command();
std::string glslang();

}  // namespace ods

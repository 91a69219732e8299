// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The package stereo-360 for npm (web/package): <stereo-360> as a module and as a script, the mesh for three.js and
// A-Frame, and the types of both. Its scripts are those that `ods view --export` writes.
#pragma once
#include <map>
#include <string>

namespace ods {

// Returns the contents of the package's files by their names. folder: web/package. Throws Error(kInput) if a file there
// cannot be read.
std::map<std::string, std::string> package_files(const std::string& folder);

// Return index.d.ts, the types for TypeScript, and custom-elements.json, the manifest for editors, from the tables of
// the package's README. Throw Error(kInput) if a table is missing.
std::string element_types(const std::string& readme);
std::string element_manifest(const std::string& readme);

}  // namespace ods

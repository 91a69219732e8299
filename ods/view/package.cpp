// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/package.h"

#include <fmt/format.h>

#include <filesystem>

#include "ods/files/read_file.h"
#include "ods/view/bundle.h"

namespace ods {

namespace fs = std::filesystem;

constexpr size_t kMaxFile = size_t{16} << 20;  // bytes

std::map<std::string, std::string> package_files(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".cpp") continue;
    files[fs::relative(entry.path(), folder).generic_string()] = read_text(entry.path().native(), kMaxFile);
  }
  files["LICENSE"] = read_text(folder + "/../../LICENSE", kMaxFile);
  files["index.d.ts"] = element_types(files["README.md"]);
  files["custom-elements.json"] = element_manifest(files["README.md"]);
  files["stereo-360.js"] = bundle("stereo-360.js");
  files["aframe.js"] = bundle("aframe.js");
  files["stereo-360.mjs"] = bundle("stereo-360.js", PageHost::kFolder, ScriptKind::kModule);
  for (const std::string_view later : kLaterScripts) {
    files[std::string(later)] = bundle_later(later, PageHost::kFolder);
    const std::string module = fmt::format("{}.mjs", later.substr(0, later.rfind('.')));
    files[module] = bundle_later(later, PageHost::kFolder, ScriptKind::kModule);
  }
  files["three.mjs"] = bundle("three.js", PageHost::kFolder, ScriptKind::kModule);
  files["aframe.mjs"] = bundle("aframe.js", PageHost::kFolder, ScriptKind::kModule);
  return files;
}

}  // namespace ods

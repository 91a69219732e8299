// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/layered_file.h"

#include <filesystem>

#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/files/confined_file.h"
#include "ods/layers/file/layers_info.h"

namespace ods {

namespace fs = std::filesystem;

bool is_layered_scene(const std::string& path) {
  std::error_code fault;
  if (small_letters(fs::path(path).extension().string()) != ".glb" || !fs::is_regular_file(path, fault)) return false;
  try {
    return read_layers_info(path).has_value();
  } catch (const Error&) {
    return true;
  }
}

LayeredFile read_layered_file(const std::string& path) {
  const std::string name = read_layers_info(path)->fallback;
  if (name.empty()) return {};
  const fs::path folder = fs::canonical(path).parent_path();
  const std::string fallback = (folder / name).native();
  try {
    const ConfinedFile confined(fallback, folder.native(), Reach::kDirectly);
    return {fallback, ""};
  } catch (const Error&) {
    return {"", name};
  }
}

}  // namespace ods

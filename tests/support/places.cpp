// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/places.h"

namespace ods {

std::string source_folder() {
  return SOURCE_FOLDER;
}

std::string shared_scenes() {
  return SHARED_SCENES;
}

std::string ods_command() {
  return ODS_COMMAND;
}

std::string glslang() {
  return GLSLANG;
}

}  // namespace ods

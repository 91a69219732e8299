// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// kinds_of_scene FOLDER: writes the scenes of tests/support/kinds_of_scene.h into a folder, for docs/kinds_sheet.sh.
#include "tests/support/kinds_of_scene.h"

#include <cstdio>
#include <fstream>
#include <iterator>

#include "tests/support/scene_file.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "kinds_of_scene FOLDER\n");
    return 2;
  }
  for (const ods::KindOfScene& kind : ods::kinds_of_scene()) {
    const ods::Binary bytes = ods::glb_of(kind.make());
    std::ofstream file(std::string(argv[1]) + "/" + kind.name + ".glb", std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    if (!file) return 1;
  }
  return 0;
}

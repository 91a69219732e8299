// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// --portable on another processor, which qemu's user mode stands for: without AVX, and with reciprocals that are exact,
// as no maker's are.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/support/cli_runner.h"

namespace ods::portable_test {

class RenderPortable : public Cli, public ::testing::WithParamInterface<const char*> {
 protected:
  std::string render_by(const std::string& program, const std::string& name) {
    const std::string line = program + " '" + ods_command() + "' render " + GetParam() + " --noise none " +
                             "--denoise none --portable -q -o " + folder.path(name) + " >/dev/null 2>&1";
    EXPECT_EQ(std::system(line.c_str()), 0) << line;
    return folder.read(name);
  }

  // The emulator by its two names; empty without one.
  static std::string emulator() {
    for (const std::string name : {"qemu-x86_64", "qemu-x86_64-static"}) {
      if (std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0) return name + " -cpu Nehalem";
    }
    return "";
  }
};

TEST_P(RenderPortable, AnOldProcessorGivesTheSameBits) {
  if (emulator().empty()) GTEST_SKIP() << "skipped: there is no qemu-x86_64";
  if (kSanitized) GTEST_SKIP() << "skipped: a sanitizer takes all the address space";
  const std::string here = render_by("", "here.exr");
  EXPECT_TRUE(here == render_by(emulator(), "there.exr"));
}

// The first has surfaces that touch, where reciprocals once decided.
INSTANTIATE_TEST_SUITE_P(Scenes, RenderPortable,
                         ::testing::Values("toys --width 96 --samples 3", "wineglass --width 16 --samples 2"));

}  // namespace ods::portable_test

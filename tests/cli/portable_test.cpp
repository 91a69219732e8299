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

class Portable : public Cli {
 protected:
  std::string render_by(const std::string& program, const std::string& name) {
    const std::string line = program + " '" + ods_command() + "' render toys --width 32 --samples 2 --noise none " +
                             "--denoise none --portable -q -o " + folder.path(name) + " >/dev/null 2>&1";
    EXPECT_EQ(std::system(line.c_str()), 0) << line;
    return folder.read(name);
  }
};

TEST_F(Portable, AnOldProcessorGivesTheSameBits) {
  if (std::system("command -v qemu-x86_64 >/dev/null 2>&1") != 0) GTEST_SKIP() << "skipped: there is no qemu-x86_64";
  EXPECT_EQ(render_by("", "here.exr"), render_by("qemu-x86_64 -cpu Nehalem", "there.exr"));
}

}  // namespace ods::portable_test

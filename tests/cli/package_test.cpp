// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The Debian package and the container: what is in them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/cli_runner.h"

namespace ods::package_test {

bool works(const std::string& words) {
  return std::system(("{ " + words + "; } >/dev/null 2>&1").c_str()) == 0;
}

class Package : public Cli {
 protected:
  // The output of a shell command.
  std::string output_of(const std::string& words) {
    EXPECT_EQ(std::system(("{ " + words + "; } >" + folder.path("output.txt") + " 2>&1").c_str()), 0)
        << words << "\n"
        << folder.read("output.txt");
    return folder.read("output.txt");
  }
};

TEST_F(Package, HoldsWhatDebianExpects) {
  if (!works("command -v dpkg-shlibdeps && command -v file")) GTEST_SKIP() << "skipped: there is no dpkg-dev or file";
  const std::string build = std::filesystem::path(ods_command()).parent_path().native();
  output_of("cpack --config " + build + "/CPackConfig.cmake -B " + folder.path("package"));
  const std::string package = folder.path("package") + "/ods_*.deb";
  const std::string files = output_of("dpkg-deb -c " + package);
  for (const char* file : {"/usr/bin/ods", "/usr/share/man/man1/ods.1.gz", "/usr/share/man/man1/ods-render.1.gz",
                           "/usr/share/bash-completion/completions/ods", "/usr/share/zsh/vendor-completions/_ods",
                           "/usr/share/doc/ods/copyright", "/usr/share/doc/ods/changelog.Debian.gz"}) {
    EXPECT_NE(files.find(std::string(" .") + file), std::string::npos) << file << " is not among\n" << files;
  }
  EXPECT_EQ(files.find("/usr/include"), std::string::npos) << "headers need the libraries' own";
  const std::string control = output_of("dpkg-deb -f " + package + " Depends Description");
  for (const char* library : {"libc6 (", "libembree", "libtiff", "libwebp", "libavcodec", "libtbb"}) {
    EXPECT_NE(control.find(library), std::string::npos) << library << " in " << control;
  }
  if (works("command -v lintian")) output_of("lintian --allow-root --fail-on error " + package);
}

}  // namespace ods::package_test

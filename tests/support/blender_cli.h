// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs the command on files that it converts with Blender, with the test's own cache.
#pragma once
#include "tests/support/cli_runner.h"
#include "tests/support/programs.h"

class BlenderCli : public Cli {
 protected:
  void SetUp() override {
    static const std::string kMissing = ods::missing("Blender", "blender --version");
    if (!kMissing.empty()) GTEST_SKIP() << kMissing;
    setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1);
  }
};

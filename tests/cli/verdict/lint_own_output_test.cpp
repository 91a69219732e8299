// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods lint finds no fault in what ods renders by default; above all none at the poles. The pictures are rendered
// without light, so that a few samples show every texture without noise, and a stop darker than that shows them: white
// things are white there, which lint calls clipped.
#include <filesystem>

#include "ods/scene/builtin/builtin.h"
#include "tests/support/cli_runner.h"

namespace ods::own_output_lint_test {

class LintOwnOutput : public Cli {
 protected:
  // The report of lint on a scene.
  std::string lint(const std::string& scene, const std::string& options = "") {
    const std::string picture = folder.path("picture.png");
    EXPECT_EQ(run("render " + scene + " --unlit --exposure -1 --denoise none --width 640 --samples 2 -o " + picture +
                  options),
              0)
        << err;
    run("lint " + picture);
    return out;
  }

  static bool is_silent(const std::string& report) {
    return report.find("no fault found") != std::string::npos && report.find("warning") == std::string::npos;
  }
};

TEST_F(LintOwnOutput, OfBuiltInScenesHasNoFaultThatLintFinds) {
  for (const std::string& name : ods::names_of(ods::builtin_scenes())) {
    if (name == "furnace") continue;  // nothing but one even light: eyes cannot be told apart
    const std::string report = lint(name);
    EXPECT_TRUE(is_silent(report)) << name << "\n" << report;
  }
}

TEST_F(LintOwnOutput, OfSharedScenesHasNoFaultThatLintFinds) {
  const std::string atrium = shared_scenes() + "/atrium.glb";
  if (!std::filesystem::exists(atrium)) GTEST_SKIP() << "skipped: no shared scenes";
  const std::string report = lint(atrium);
  EXPECT_TRUE(is_silent(report)) << report;
}

// Otherwise the tests above would not cover the poles.
TEST_F(LintOwnOutput, WithoutAMergeHasFaultsAtThePoles) {
  EXPECT_NE(lint("fractal", " --merge none").find("no-pole-merge"), std::string::npos) << out;
}

}  // namespace ods::own_output_lint_test

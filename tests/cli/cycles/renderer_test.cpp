// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Options that Cycles cannot honour, without Blender.
#include "tests/support/cli_runner.h"

namespace ods::renderer_test {

using RendererOptions = Cli;

TEST_F(RendererOptions, ThatCyclesCannotHonourAreRefused) {
  const char* const kOptions[] = {"--quality draft",
                                  "--lamp none",
                                  "--unlit",
                                  "--bake 512",
                                  "--indirect path",
                                  "--caustics path",
                                  "--clamp 3",
                                  "--filter box",
                                  "--object-layer",
                                  "--save-unfinished",
                                  "--animation walk",
                                  "--variant night",
                                  "--solid-glass",
                                  "--unit cm",
                                  "--up z",
                                  "--as object",
                                  "--portable",
                                  "--light-unit watt",
                                  "--with a.glb --at 0,0,0",
                                  "--device NVIDIA"};
  for (const std::string option : kOptions) {
    EXPECT_EQ(run("render a.blend --renderer cycles -o " + folder.path("a.exr") + " " + option), 2) << option << err;
    expect_one_error();
    EXPECT_NE(err.find(option.substr(0, option.find(' '))), std::string::npos) << err;
    EXPECT_NE(err.find("--renderer cycles"), std::string::npos) << err;
    if (option == "--device NVIDIA") continue;
    EXPECT_NE(err.find("cannot be used with --renderer cycles: "), std::string::npos) << "what to do: " << err;
  }
}

TEST_F(RendererOptions, CyclesRendersFilesOfBlender) {
  EXPECT_EQ(run("render spheres --renderer cycles -o " + folder.path("a.png")), 3);
  expect_one_error();
  EXPECT_NE(err.find("not a .blend"), std::string::npos) << err;
  EXPECT_EQ(run("render a.blend --renderer eevee -o " + folder.path("a.png")), 2);
  expect_one_error();
}

}  // namespace ods::renderer_test

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods layers as users call it.
#include <csignal>

#include "ods/layers/file/layers_info.h"
#include "ods/scene/load/load.h"
#include "tests/support/cli_runner.h"

namespace ods::layers_command_test {

class LayersCommand : public Cli {
 protected:
  // The words that bake the built-in scene of spheres small and quickly.
  std::string layers(const std::string& more, const std::string& output = "spheres.layers.glb") const {
    return "layers spheres --width 256 --samples 2 --noise none -o " + folder.path(output) + " " + more;
  }
};

TEST_F(LayersCommand, WritesAFileThatViewersRead) {
  ASSERT_EQ(run(layers("--box 0.25 --yaw 30 --fallback spheres_360_TB.png")), 0) << err;
  EXPECT_NE(out.find("spheres.layers.glb"), std::string::npos) << out;
  EXPECT_NE(err.find(" draw calls"), std::string::npos) << err;
  const std::optional<LayersInfo> info = read_layers_info(folder.path("spheres.layers.glb"));
  ASSERT_TRUE(info);
  EXPECT_EQ(info->box.size, vec3(0.25f));
  EXPECT_NEAR(info->yaw, 30.0f, 1e-3f);
  EXPECT_EQ(info->width, 256);
  EXPECT_EQ(info->fallback, "spheres_360_TB.png");
  EXPECT_EQ(info->scene, "spheres");
  EXPECT_GT(info->light.probes.count.x, 1);
  EXPECT_GT(load_scene(folder.path("spheres.layers.glb")).triangles.size(), 20u);
  EXPECT_FALSE(std::filesystem::exists(folder.path("spheres.layers.glb.unfinished")));
  ASSERT_EQ(run("view " + folder.path("spheres.layers.glb") + " --export " + folder.path("site")), 0) << err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("site/index.html")));
}

TEST_F(LayersCommand, WritesTheOtherForms) {
  ASSERT_EQ(run(layers("--plain", "plain.glb")), 0) << err;
  EXPECT_EQ(folder.read("plain.glb").find("EXT_meshopt_compression"), std::string::npos);
  ASSERT_EQ(run(layers("", "spheres.usdz")), 0) << err;
  EXPECT_EQ(folder.read("spheres.usdz").substr(0, 2), "PK");
}

TEST_F(LayersCommand, RefusesBeforeItBakes) {
  EXPECT_EQ(run("layers spheres"), 2);
  EXPECT_NE(err.find("-o scene.layers.glb"), std::string::npos) << err;
  EXPECT_EQ(run(layers("", "spheres.obj")), 2);
  EXPECT_NE(err.find(".usdz"), std::string::npos) << err;
  EXPECT_EQ(run(layers("--fallback ../other.png")), 2);
  EXPECT_EQ(run(layers("--box 3")), 2);
  EXPECT_EQ(run("layers room --width 256 --box 2 -o " + folder.path("room.glb")), 2);
  EXPECT_NE(err.find("--box of at most"), std::string::npos) << err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("room.glb")));
}

// Ctrl-C keeps the light so far, for the same command only (tests/layers/bake_test.cpp resumes).
TEST_F(LayersCommand, KeepsTheLightWhenInterrupted) {
  const std::string output = folder.path("long.glb"), kept = output + ".unfinished";
  Ods interrupted({"layers", "spheres", "--width", "512", "--samples", "100000", "--noise", "none", "-o", output});
  interrupted.wait_for("triangles are seen");
  interrupted.wait_for(" left");  // while the light cache is filled, there is nothing to keep
  interrupted.kill(SIGINT);
  EXPECT_EQ(interrupted.finish(), 128 + SIGINT);
  EXPECT_NE(interrupted.err.find("the same command resumes"), std::string::npos) << interrupted.err;
  EXPECT_TRUE(std::filesystem::exists(kept));
  EXPECT_FALSE(std::filesystem::exists(output));
  EXPECT_EQ(run("layers spheres --width 512 --samples 8 --noise none -o " + output), 2) << err;
  EXPECT_NE(err.find(kept), std::string::npos) << err;
  EXPECT_EQ(run("layers spheres --width 512 --samples 1 --noise none --restart -o " + output), 0) << err;
  EXPECT_FALSE(std::filesystem::exists(kept));
}

}  // namespace ods::layers_command_test

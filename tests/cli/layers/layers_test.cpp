// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods layers as users call it.
#include <csignal>

#include "ods/layers/file/layers_info.h"
#include "ods/picture/stored_picture.h"
#include "ods/scene/load/load.h"
#include "tests/support/cli_runner.h"
#include "tests/support/moving_files.h"

namespace ods::layers_command_test {

class LayersCommand : public Cli {
 protected:
  // The words that bake the built-in scene of spheres small and quickly.
  std::string layers(const std::string& more, const std::string& output = "spheres.layers.glb") const {
    return "layers spheres --width 256 --samples 2 --noise none -o " + folder.path(output) + " " + more;
  }
};

Scene playing(Scene scene) {
  play(scene.animation, "");
  return scene;
}

TEST_F(LayersCommand, WritesAFileThatViewersRead) {
  ASSERT_EQ(run(layers("--box 0.25 --yaw 30 --fallback spheres_360_TB.png")), 0) << err;
  EXPECT_NE(out.find("spheres.layers.glb"), std::string::npos) << out;
  EXPECT_NE(err.find(" draw calls"), std::string::npos) << err;
  EXPECT_NE(err.find("holes: 0.0"), std::string::npos) << err;
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

TEST_F(LayersCommand, MakesThePictureOutsideTheBox) {
  ASSERT_EQ(run(layers("--fallback outside_360_TB.jpg", "spheres.glb")), 0) << err;
  const StoredPicture picture = open_picture(folder.path("outside_360_TB.jpg"), {});
  EXPECT_EQ(picture.eyes.size(), 2u);
  EXPECT_NE(out.find("outside_360_TB.jpg"), std::string::npos) << out;
  const std::string before = folder.read("outside_360_TB.jpg");
  ASSERT_EQ(run(layers("--fallback outside_360_TB.jpg --yaw 90", "spheres.glb")), 0) << err;
  EXPECT_EQ(folder.read("outside_360_TB.jpg"), before);
}

TEST_F(LayersCommand, ExportsAPage) {
  ASSERT_EQ(run(layers("--export", "site/")), 0) << err;
  EXPECT_EQ(out, folder.path("site/view.json") + "\n");
  for (const char* const name : {"index.html", "item/0/picture.glb", "item/0/fallback.jpg"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path(std::string("site/") + name))) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("site.unfinished")));
}

TEST_F(LayersCommand, RefusesBeforeItBakes) {
  EXPECT_EQ(run("layers spheres"), 2);
  EXPECT_NE(err.find("-o scene.layers.glb"), std::string::npos) << err;
  EXPECT_EQ(run(layers("", "spheres.obj")), 2);
  EXPECT_NE(err.find(".usdz"), std::string::npos) << err;
  EXPECT_EQ(run(layers("--fallback ../other.png")), 2);
  EXPECT_EQ(run(layers("--fallback other.txt")), 2);
  EXPECT_NE(err.find("other.txt"), std::string::npos) << err;
  EXPECT_EQ(run(layers("--export --fallback other.jpg", "site")), 2);
  folder.write("file", "");
  EXPECT_NE(run(layers("--export", "file")), 0);
  EXPECT_EQ(err.find("triangles are seen"), std::string::npos) << err;
  EXPECT_EQ(run(layers("--box 3")), 2);
  EXPECT_EQ(run("layers room --width 256 --box 2 -o " + folder.path("room.glb")), 2);
  EXPECT_NE(err.find("--box of at most"), std::string::npos) << err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("room.glb")));
}

TEST_F(LayersCommand, MakesAFilm) {
  const std::string output = folder.path("toys.layers.glb");
  const std::string toys = "layers toys --width 256 --samples 1 --noise none --exposure 0 -o ";
  ASSERT_EQ(run(toys + output + " --frames 0-9x3 --fps 10 --light-every 2"), 0) << err;
  EXPECT_NE(err.find("4 frames: "), std::string::npos) << err;
  EXPECT_NE(err.find("their light at 3 of the frames: "), std::string::npos) << err;
  EXPECT_FALSE(std::filesystem::exists(output + ".unfinished"));
  EXPECT_FALSE(std::filesystem::exists(output + ".unfinished.0"));
  const Scene scene = load_scene(output);
  EXPECT_NEAR(length_of(playing(scene).animation), 0.9, 1e-6);
  EXPECT_GT(scene.animation.instances.size(), 3u);
  EXPECT_EQ(run(toys + output + " --frames 0-9 --time 1"), 2);
  EXPECT_NE(err.find("--time"), std::string::npos) << err;
  EXPECT_EQ(run(toys + folder.path("toys.usdz") + " --frames 0-9"), 2);
  EXPECT_NE(err.find("a film of layers is a .glb"), std::string::npos) << err;
  EXPECT_EQ(run(toys + output + " --frames 3"), 2);
  EXPECT_NE(err.find("2 to 1000 frames, not 1"), std::string::npos) << err;
  EXPECT_EQ(run(toys + output + " --frames 9-1x-1"), 2);
  EXPECT_NE(err.find("goes forwards"), std::string::npos) << err;
  EXPECT_EQ(run(toys + output + " --light-every 3"), 2);
  EXPECT_NE(err.find("--light-every goes with --frames LIST"), std::string::npos) << err;
  EXPECT_EQ(run(layers("--frames 0-9")), 2);
  EXPECT_NE(err.find("nothing moves in these frames"), std::string::npos) << err;
}

// A triangle that the first clip moves in a second, the other in two.
TEST_F(LayersCommand, FilmsTheAnimationOfThatName) {
  GltfBuilder file = make_triangle();
  GltfJson clips = GltfJson::array();
  for (const auto& [name, end] : {std::pair{"short", 1.0f}, {"long", 2.0f}}) {
    file.json["animations"] = {{{"name", name}}};
    animate(file, node_target(0, "translation"), {0, end}, {0, 0, 0, end, 0, 0}, "VEC3");
    clips.push_back(file.json["animations"][0]);
  }
  file.json["animations"] = clips;
  const Binary glb = file.glb();
  folder.write("clips.glb", {glb.begin(), glb.end()});
  const auto film = [&](const std::string& more) {
    return run("layers " + folder.path("clips.glb") + " --position 0.3,0.3,2 --width 256 --samples 1 --noise none " +
               "--exposure 0 --frames all --fps 4 -o " + folder.path("film.glb") + more);
  };
  for (const auto& [words, frames] : {std::pair{"", "4 frames: "}, {" --animation long", "8 frames: "}}) {
    ASSERT_EQ(film(words), 0) << err;
    EXPECT_NE(err.find(frames), std::string::npos) << err;
  }
  EXPECT_EQ(film(" --animation lung"), 2);
  EXPECT_NE(err.find("did you mean 'long'?"), std::string::npos) << err;
}

TEST_F(LayersCommand, TakesAPictureWithDepth) {
  const std::string picture = folder.path("spheres.exr"), output = folder.path("picture.layers.glb");
  ASSERT_EQ(run("render spheres --width 256 --samples 2 --noise none --position 0,1.4,0.5 -o " + picture), 0) << err;
  ASSERT_EQ(run("layers " + picture + " --box 0.2 -o " + output), 0) << err;
  EXPECT_NE(err.find("the picture does not show "), std::string::npos) << err;
  const std::optional<LayersInfo> info = read_layers_info(output);
  ASSERT_TRUE(info);
  EXPECT_EQ(info->scene, "spheres.exr");
  EXPECT_EQ(info->width, 256);
  EXPECT_NEAR(info->box.center.y, 1.4f, 1e-5f);
  EXPECT_EQ(info->light.probes.count.x, 1);
  EXPECT_GT(load_scene(output).triangles.size(), 20u);
}

TEST_F(LayersCommand, TellsOptionsOfPicturesFromThoseOfScenes) {
  const std::string output = " -o " + folder.path("x.glb");
  EXPECT_EQ(run("layers picture.exr --samples 3" + output), 2);
  EXPECT_NE(err.find("--samples is for scenes"), std::string::npos) << err;
  EXPECT_EQ(run("layers picture.exr --near 3" + output), 2);
  EXPECT_NE(err.find("--near goes with --depth FILE"), std::string::npos) << err;
  EXPECT_EQ(run("layers spheres --depth depth.png" + output), 2);
  EXPECT_NE(err.find("--depth is for pictures"), std::string::npos) << err;
  ASSERT_EQ(run("render spheres --width 128 --samples 1 --noise none -o " + folder.path("flat_360_TB.png")), 0) << err;
  EXPECT_EQ(run("layers " + folder.path("flat_360_TB.png") + output), 2);
  EXPECT_NE(err.find("has no depth: render it as .exr with depth, or add --depth FILE"), std::string::npos) << err;
}

// Ctrl-C keeps the light so far, for the same command only (tests/layers/light/bake_test.cpp resumes).
TEST_F(LayersCommand, KeepsTheLightWhenInterrupted) {
  const std::string output = folder.path("long.glb"), kept = output + ".unfinished";
  Ods interrupted({"layers", "spheres", "--width", "512", "--samples", "20000", "--noise", "none", "-o", output,
                   "--progress", "json"});
  interrupted.wait_for("\"progress\":0.16");  // the geometry ends at 0.15
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

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes that name files where they have no business, and scenes with nothing to render.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/support/cli_runner.h"
#include "tests/support/compressed_gltf.h"
#include "tests/support/gltf_builder.h"

namespace fs = std::filesystem;

namespace ods::cli_confine_test {

constexpr const char* kSecret = "root:x:0:0:secret";

class RenderConfined : public Cli {
 protected:
  RenderConfined() {
    const ods::Binary bytes = ods::make_triangle().binary;
    for (const char* name : {"in", "out", "in/textures"}) fs::create_directory(folder.path(name));
    for (const char* name : {"in/a b.bin", "in/textures/a.bin", "out/a.bin"})
      folder.write(name, {bytes.begin(), bytes.end()});
    folder.write("out/secret", kSecret);
  }

  // A triangle whose buffer is there; returns the scene's path.
  std::string scene(const std::string& uri, const std::string& name = "in/scene.gltf") {
    ods::GltfBuilder file = ods::make_triangle();
    file.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", uri}}};
    folder.write(name, file.json.dump());
    return folder.path(name);
  }

  int info(const std::string& path, bool confined) {
    return run("info " + path + (confined ? " --confine " + folder.path("in") : ""));
  }

  void expect_refused(const std::string& words) {
    EXPECT_EQ(out, "");
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_NE(err.find(words), std::string::npos) << err;
    EXPECT_EQ(err.find("secret:"), std::string::npos) << err;
  }
};

TEST_F(RenderConfined, RelativePathsAreRead) {
  for (const char* uri : {"a%20b.bin", "a b.bin", "./textures/../a b.bin", "textures/a.bin", "../in/a%20b.bin"}) {
    EXPECT_EQ(info(scene(uri), false), 0) << uri << ": " << err;
    EXPECT_EQ(info(scene(uri), true), 0) << uri << ": " << err;
  }
  EXPECT_EQ(info(scene("../out/a.bin"), false), 0) << err;
}

TEST_F(RenderConfined, AbsolutePathsAndUrlsAreRefused) {
  const std::string there = folder.path("out/a.bin");
  std::string escaped = there;
  escaped.replace(0, 1, "%2F");
  for (const std::string& uri : {there, escaped, "/" + there, "file://" + there, "FILE:" + there,
                                 std::string("https://example.org/a.bin"), std::string("ftp:a.bin")}) {
    for (const bool confined : {false, true}) {
      EXPECT_EQ(info(scene(uri), confined), 3) << uri;
      expect_refused("relative to the scene");
    }
  }
}

TEST_F(RenderConfined, NothingOutsideOfTheFolderIsRead) {
  fs::create_symlink(folder.path("out/a.bin"), folder.path("in/link.bin"));
  fs::create_directory_symlink(folder.path("out"), folder.path("in/away"));
  fs::create_symlink(folder.path("in/a b.bin"), folder.path("in/inside.bin"));
  for (const char* uri : {"../out/a.bin", "..%2Fout%2Fa.bin", "%2e%2e/out/a.bin", "link.bin", "away/a.bin",
                          "textures/../../out/a.bin", "../out/absent.bin", "away/absent.bin"}) {
    EXPECT_EQ(info(scene(uri), true), 3) << uri;
    expect_refused("is outside");
  }
  EXPECT_EQ(info(scene("inside.bin"), true), 0) << err;
}

TEST_F(RenderConfined, TheSceneItselfAndTheSkyLieInsideToo) {
  const std::string outside = scene("a.bin", "out/scene.gltf"), inside = scene("a b.bin");
  fs::create_symlink(outside, folder.path("in/linked.gltf"));
  for (const std::string& path : {outside, folder.path("in/linked.gltf"), folder.path("in/../out/scene.gltf")}) {
    EXPECT_EQ(info(path, true), 3) << path;
    expect_refused("is outside");
  }
  const std::string confine = " --confine " + folder.path("in") + " ";
  const std::string render = "render -q --width 16 --samples 1 -o " + folder.path("p.png") + confine;
  EXPECT_EQ(run(render + inside), 0) << err;
  EXPECT_EQ(run("render -q --width 16 --samples 1 furnace -o " + folder.path("out/sky.hdr")), 0) << err;
  EXPECT_EQ(run(render + inside + " --env " + folder.path("out/sky.hdr")), 3);
  expect_refused("is outside");
  fs::copy(folder.path("out/sky.hdr"), folder.path("in/sky.hdr"));
  EXPECT_EQ(run(render + inside + " --env " + folder.path("in/sky.hdr")), 0) << err;
  EXPECT_EQ(run("rig --scene " + outside + confine), 3);
  expect_refused("is outside");
  EXPECT_EQ(run("video -q --width 16 --samples 1 " + outside + confine + " --duration 1 -o " + folder.path("f.mp4")),
            3);
  expect_refused("is outside");
}

TEST_F(RenderConfined, ArchivesLieInsideToo) {
  const ods::Binary zip = ods::make_zip({{"model/scene.glb", ods::make_triangle().glb()}});
  for (const char* name : {"in/a.zip", "out/a.zip"}) folder.write(name, {zip.begin(), zip.end()});
  EXPECT_EQ(info(folder.path("in/a.zip"), true), 0) << err;
  EXPECT_EQ(run("render -q --width 16 --samples 1 " + folder.path("in/a.zip") + " --confine " + folder.path("in") +
                " -o " + folder.path("p.png")),
            0)
      << err;
  EXPECT_EQ(info(folder.path("out/a.zip"), false), 0) << err;
  EXPECT_EQ(info(folder.path("out/a.zip"), true), 3);
  expect_refused("is outside");
}

// A link that changes all the time: the file that was checked is the one that is read, or nothing is.
TEST_F(RenderConfined, ASkyIsNotReplacedAfterItsCheck) {
  ASSERT_EQ(run("render -q --width 16 --samples 1 furnace -o " + folder.path("in/sky.hdr")), 0) << err;
  std::atomic<bool> is_over = false;
  std::thread other([&] {
    for (const char* target = "out/secret"; !is_over; target = *target == 'o' ? "in/sky.hdr" : "out/secret") {
      fs::create_symlink(folder.path(target), folder.path("new"));
      fs::rename(folder.path("new"), folder.path("in/link.hdr"));
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
  });
  for (int i = 0; i < 16; i++) {
    if (run("render -q --width 16 --samples 1 furnace -o " + folder.path("p.png") + " --env " +
            folder.path("in/link.hdr") + " --confine " + folder.path("in")) != 0) {
      expect_refused("link.hdr': it is outside");
    }
  }
  is_over = true;
  other.join();
}

// Neither a scene nor a sky reveals whether a file outside exists, and messages do not name descriptors.
TEST_F(RenderConfined, MessagesNameTheFileAsItWasGiven) {
  const std::string confine = " --confine " + folder.path("in");
  const std::string sky = "render furnace -o " + folder.path("p.png") + confine + " --env ";
  for (const std::string& command : {sky, "info" + confine + " "}) {
    EXPECT_EQ(run(command + folder.path("out/secret")), 3);
    expect_refused("/out/secret': it is outside");
    EXPECT_EQ(run(command + folder.path("out/absent")), 3);
    expect_refused("/out/absent': it is outside");
    folder.write("in/broken.hdr", "no picture");
    EXPECT_EQ(run(command + folder.path("in/broken.hdr")), 3);
    expect_refused("/in/broken.hdr");
  }
}

TEST_F(RenderConfined, TheFolderMustBeThere) {
  EXPECT_EQ(run("info " + scene("a b.bin") + " --confine " + folder.path("absent")), 3);
  expect_refused("--confine: there is no folder");
}

// Messages to a stranger must not contain the contents of a file.
TEST_F(RenderConfined, MessagesQuoteNoOtherFile) {
  ods::GltfBuilder file = ods::make_triangle();
  file.json["images"] = {{{"uri", "../out/secret"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
  file.primitive()["material"] = 0;
  const ods::Binary glb = file.glb();
  folder.write("in/scene.glb", {glb.begin(), glb.end()});
  EXPECT_EQ(info(folder.path("in/scene.glb"), false), 3);
  expect_refused("");
  EXPECT_EQ(err.find("root"), std::string::npos) << err;
  EXPECT_EQ(info(scene("../out/secret"), false), 3);
  expect_refused("");
  EXPECT_EQ(err.find("root"), std::string::npos) << err;
  fs::copy(folder.path("out/secret"), folder.path("in/secret.gltf"));
  EXPECT_EQ(info(folder.path("in/secret.gltf"), false), 3);
  EXPECT_EQ(err.find("root"), std::string::npos) << err;
}

class RenderEmpty : public RenderConfined {
 protected:
  void expect_nothing_to_render(const ods::GltfBuilder& file) {
    const ods::Binary glb = file.glb();
    folder.write("in/scene.glb", {glb.begin(), glb.end()});
    const std::string path = folder.path("in/scene.glb");
    EXPECT_EQ(run("info " + path), 0) << err;
    EXPECT_EQ(run("render --width 16 --samples 1 " + path + " -o " + folder.path("p.png")), 3);
    EXPECT_NE(err.find("nothing to render"), std::string::npos) << err;
    EXPECT_NE(err.find("scene.glb"), std::string::npos) << err;
    EXPECT_FALSE(fs::exists(folder.path("p.png")));
    EXPECT_EQ(run("video --width 16 --samples 1 --duration 1 " + path + " -o " + folder.path("f.mp4")), 3);
    EXPECT_NE(err.find("nothing to render"), std::string::npos) << err;
    EXPECT_FALSE(fs::exists(folder.path("f.mp4")));
  }
};

TEST_F(RenderEmpty, NoNodes) {
  ods::GltfBuilder file;
  file.json = ods::GltfJson::parse(R"({"asset": {"version": "2.0"}})");
  expect_nothing_to_render(file);
}

TEST_F(RenderEmpty, ASceneWithoutNodes) {
  ods::GltfBuilder file = ods::make_triangle();
  file.json["scenes"] = ods::GltfJson::parse(R"([{"nodes": []}])");
  expect_nothing_to_render(file);
}

TEST_F(RenderEmpty, OnlyLines) {
  ods::GltfBuilder file = ods::make_triangle();
  file.primitive()["mode"] = 1;
  expect_nothing_to_render(file);
}

TEST_F(RenderEmpty, EverythingIsScaledToNothing) {
  ods::GltfBuilder file = ods::make_triangle();
  file.node(0)["scale"] = {0, 0, 0};
  expect_nothing_to_render(file);
}

}  // namespace ods::cli_confine_test

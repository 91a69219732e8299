// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes in .zip archives, as shops deliver them.
#include <gtest/gtest.h>

#include <random>

#include "ods/base/error.h"
#include "tests/support/compressed_gltf.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

// A textured triangle with files beside it.
std::map<std::string, Binary> loose_scene(const std::string& folder, const std::string& picture = "textures/wood.png") {
  GltfBuilder file = make_triangle();
  file.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", "scene.bin"}}};
  file.json["images"] = {{{"uri", picture}}};
  file.json["textures"] = GltfJson::parse(R"([{"source": 0}])");
  file.json["materials"] = GltfJson::parse(R"([{"emissiveTexture": {"index": 0}}])");
  const std::string text = file.json.dump();
  return {{folder + "scene.gltf", {text.begin(), text.end()}},
          {folder + "scene.bin", file.binary},
          {folder + "textures/wood.png", small_png()}};
}

Scene load(const Binary& bytes) {
  return load_gltf_bytes(bytes, "test.zip");
}

std::string error_of_zip(const Binary& bytes) {
  try {
    load(bytes);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    const std::string what = error.what();
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_NE(what.find("test.zip"), std::string::npos) << what;
    return what;
  }
}

TEST(GltfZip, OneFile) {
  const Scene scene = load(make_zip({{"readme.txt", {'a'}}, {"model/Chair.GLB", make_triangle().glb()}}));
  EXPECT_EQ(scene.triangles.size(), 1u);
  EXPECT_EQ(scene.name, "test");
}

TEST(GltfZip, FilesBesideTheScene) {
  for (const char* folder : {"", "a/b/"}) {
    const Scene scene = load(make_zip(loose_scene(folder)));
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.texels.size(), 4u);
    EXPECT_TRUE(scene.warnings.empty());
  }
}

TEST(GltfZip, FilesAboveTheScene) {
  std::map<std::string, Binary> files = loose_scene("source/", "../textures/wood.png");
  files["textures/wood.png"] = small_png();
  files.erase("source/textures/wood.png");
  EXPECT_EQ(load(make_zip(files)).texels.size(), 4u);
}

TEST(GltfZip, OtherSpellings) {
  const Scene scene = load(make_zip(loose_scene("a/", "Textures\\wood.PNG")));
  EXPECT_EQ(scene.texels.size(), 4u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("read 'textures/wood.png' instead"), std::string::npos) << scene.warnings[0];
}

TEST(GltfZip, ArchivesWithBackslashes) {
  std::map<std::string, Binary> files = loose_scene("");
  files["textures\\wood.png"] = files["textures/wood.png"];
  files.erase("textures/wood.png");
  EXPECT_EQ(load(make_zip(files)).texels.size(), 4u);
}

TEST(GltfZip, LitterOfMacs) {
  std::map<std::string, Binary> files = loose_scene("");
  files["__MACOSX/._scene.gltf"] = files["._scene.gltf"] = {'x'};
  EXPECT_EQ(load(make_zip(files)).texels.size(), 4u);
}

TEST(GltfZip, ExactlyOneScene) {
  EXPECT_NE(error_of_zip(make_zip({{"a.txt", {'a'}}})).find("without a .glb or .gltf"), std::string::npos);
  const Binary glb = make_triangle().glb();
  const std::string error = error_of_zip(make_zip({{"a.glb", glb}, {"b/c.gltf", glb}}));
  EXPECT_NE(error.find("2 scenes: a.glb, b/c.gltf; unpack it and name one"), std::string::npos) << error;
  std::map<std::string, Binary> many;
  for (int i = 10; i < 30; i++) many[std::to_string(i) + ".glb"] = glb;
  EXPECT_NE(error_of_zip(make_zip(many)).find("20 scenes: 10.glb, "), std::string::npos);
  EXPECT_LT(error_of_zip(make_zip(many)).size(), 200u);
}

TEST(GltfZip, AbsentFiles) {
  std::map<std::string, Binary> files = loose_scene("a/");
  files.erase("a/textures/wood.png");
  const std::string error = error_of_zip(make_zip(files));
  EXPECT_NE(error.find("refers to textures/wood.png: it holds no file 'a/textures/wood.png'"), std::string::npos)
      << error;
}

// Whatever archive or scene name, nothing outside of the archive is read.
TEST(GltfZip, NothingOutsideTheArchive) {
  const TemporaryFolder folder;
  const Binary png = small_png(), zip = make_zip(loose_scene("", "../secret.png"));
  folder.write("secret.png", {png.begin(), png.end()});
  std::filesystem::create_directory(folder.path("in"));
  folder.write("in/a.zip", {zip.begin(), zip.end()});
  EXPECT_THROW(load_gltf(folder.path("in/a.zip")), Error);
  folder.write("in/secret.png", {png.begin(), png.end()});
  const Binary other = make_zip(loose_scene("", "secret.png"));
  folder.write("in/b.zip", {other.begin(), other.end()});
  EXPECT_THROW(load_gltf(folder.path("in/b.zip")), Error);
  EXPECT_NE(error_of_zip(make_zip({{"../a.glb", make_triangle().glb()}, {"/b.glb", {}}})).find("without a .glb"),
            std::string::npos);
}

TEST(GltfZip, ConfinedAndUnpackedNowhere) {
  const TemporaryFolder folder;
  const Binary zip = make_zip(loose_scene(""));
  std::filesystem::create_directory(folder.path("in"));
  folder.write("in/a.zip", {zip.begin(), zip.end()});
  folder.write("a.zip", {zip.begin(), zip.end()});
  const std::string confine = std::filesystem::canonical(folder.path("in")).native();
  EXPECT_EQ(load_gltf(folder.path("in/a.zip"), {.confine = confine}).texels.size(), 4u);
  EXPECT_THROW(load_gltf(folder.path("a.zip"), {.confine = confine}), Error);
  EXPECT_EQ(gltf_files(folder.path("in/a.zip")), std::vector<std::string>{});
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.zip", "in"}));
}

// --- damage

// The offset of a file's entry in the list at the end.
size_t entry_of(const Binary& zip, const std::string& name) {
  const std::string text(zip.begin(), zip.end());
  return text.rfind(name) - 46;
}

TEST(GltfZipDamage, BombsAreFoundBeforeTheyUnpack) {
  Binary zip = make_zip(loose_scene(""));
  const size_t entry = entry_of(zip, "scene.bin");
  for (int i = 0; i < 4; i++) zip[entry + 24 + size_t(i)] = i == 3 ? 0x7f : 0xff;  // its unpacked size
  const std::string error = error_of_zip(zip);
  EXPECT_NE(error.find("far more than an archive of its size"), std::string::npos) << error;
}

TEST(GltfZipDamage, SizesThatAreNotTrue) {
  for (const int change : {-1, 1}) {
    Binary zip = make_zip(loose_scene(""));
    zip[entry_of(zip, "scene.bin") + 24] += static_cast<unsigned char>(change);
    EXPECT_NE(error_of_zip(zip), "");
  }
}

TEST(GltfZipDamage, WrongChecksum) {
  Binary zip = make_zip(loose_scene(""));
  zip[entry_of(zip, "scene.bin") + 16] ^= 1;
  EXPECT_NE(error_of_zip(zip).find("'scene.bin' cannot be unpacked"), std::string::npos) << error_of_zip(zip);
}

TEST(GltfZipDamage, Encrypted) {
  Binary zip = make_zip({{"a.glb", make_triangle().glb()}});
  zip[entry_of(zip, "a.glb") + 8] |= 1;
  zip[6] |= 1;
  EXPECT_NE(error_of_zip(zip).find("encrypted"), std::string::npos) << error_of_zip(zip);
}

TEST(GltfZipDamage, CutAndFlipped) {
  const Binary whole = make_zip(loose_scene("a/"));
  for (size_t length = 4; length < whole.size(); length++) {
    EXPECT_NE(error_of_zip({whole.begin(), whole.begin() + ptrdiff_t(length)}), "") << length;
  }
  std::mt19937 random(7);
  for (int round = 0; round < 1000; round++) {
    Binary zip = flip_bits(whole, 1 + round % 3, random);
    zip[0] = 'P', zip[1] = 'K', zip[2] = 3, zip[3] = 4;
    error_of_zip(zip);
  }
}

}  // namespace
}  // namespace ods

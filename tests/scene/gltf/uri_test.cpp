// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Names of files as programs write them, even against the specification.
#include <gtest/gtest.h>

#include <filesystem>

#include "ods/base/error.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;

namespace ods {
namespace {

class GltfUri : public testing::Test {
 protected:
  GltfUri() {
    for (const char* name : {"in", "in/textures", "out"}) fs::create_directory(folder.path(name));
  }

  void write(const std::string& name) const {
    const Binary bytes = make_triangle().binary;
    folder.write(name, {bytes.begin(), bytes.end()});
  }

  // A triangle whose buffer has this URI.
  std::string scene(const std::string& uri) const {
    GltfBuilder file = make_triangle();
    file.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", uri}}};
    folder.write("in/scene.gltf", file.json.dump());
    return folder.path("in/scene.gltf");
  }

  // Loads it with and without limits; returns the warnings.
  std::vector<std::string> warnings(const std::string& uri) const {
    const std::string confine = fs::canonical(folder.path("in")).native();
    const Scene loaded = load_gltf(scene(uri)), confined = load_gltf(scene(uri), {.confine = confine});
    EXPECT_EQ(loaded.triangles.size(), 1u) << uri;
    EXPECT_EQ(loaded.warnings, confined.warnings);
    return loaded.warnings;
  }

  std::string error(const std::string& uri, const std::string& confine) const {
    try {
      load_gltf(scene(uri), {.confine = confine.empty() ? "" : fs::canonical(folder.path(confine)).native()});
      return "";
    } catch (const Error& fault) {
      EXPECT_EQ(fault.kind(), ErrorKind::kInput);
      return fault.what();
    }
  }

  TemporaryFolder folder;
};

TEST_F(GltfUri, AsTheSpecificationSays) {
  for (const char* name : {"in/a b.bin", "in/textures/wood.bin", "in/100%.bin", "in/a#b?.bin", "in/a\\b.bin"})
    write(name);
  for (const char* uri : {"a%20b.bin", "a b.bin", "textures/wood.bin", "./textures/../textures/wood.bin", "100%25.bin",
                          "a%23b%3F.bin", "a%5Cb.bin"}) {
    EXPECT_EQ(warnings(uri), std::vector<std::string>{}) << uri;
  }
}

struct Spelling {
  const char* file;
  const char* uri;
};

class GltfUriSpelling : public GltfUri, public testing::WithParamInterface<Spelling> {};

TEST_P(GltfUriSpelling, IsFound) {
  const auto& [name, uri] = GetParam();
  write(std::string("in/") + name);
  const std::vector<std::string> said = warnings(uri);
  ASSERT_EQ(said.size(), 1u) << uri;
  EXPECT_NE(said[0].find(uri), std::string::npos) << said[0];
  EXPECT_NE(said[0].find("read '" + std::string(name) + "' instead"), std::string::npos) << said[0];
  EXPECT_EQ(gltf_files(scene(uri)), std::vector<std::string>{name});
}

INSTANTIATE_TEST_SUITE_P(All, GltfUriSpelling,
                         testing::Values(Spelling{"textures/wood.bin", "textures\\wood.bin"},
                                         Spelling{"textures/wood.bin", ".\\textures\\wood.bin"},
                                         Spelling{"textures/my wood.bin", "textures%5Cmy%20wood.bin"},
                                         Spelling{"my wood.bin", "my%2520wood.bin"},  // encoded twice
                                         Spelling{"100%41.bin", "100%41.bin"},        // not encoded at all
                                         Spelling{"wood.bin", "Wood.BIN"},
                                         Spelling{"textures/Wood.bin", "Textures/wood.bin"},
                                         Spelling{"textures/Wood.bin", "TEXTURES\\wood.BIN"},
                                         Spelling{"textures/My Wood.bin", "Textures/my%20wood.bin"}));

TEST_F(GltfUri, TheRightSpellingCounts) {
  write("in/WOOD.bin");
  folder.write("in/wood.bin", "too short");
  EXPECT_EQ(warnings("WOOD.bin"), std::vector<std::string>{});
  EXPECT_NE(error("wood.bin", "").find("should have"), std::string::npos);
}

TEST_F(GltfUri, OneWarningForAllFiles) {
  write("in/a.bin");
  const Binary png = small_png();
  folder.write("in/textures/wood.png", {png.begin(), png.end()});
  GltfBuilder file = make_triangle();
  file.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", "A.bin"}}};
  file.json["images"] = {{{"uri", "textures\\Wood.png"}}, {{"uri", "Textures/wood.PNG"}}};
  file.json["textures"] = GltfJson::parse(R"([{"source": 0}, {"source": 1}])");
  file.json["materials"] = GltfJson::parse(R"([{"emissiveTexture": {"index": 0}}, {"emissiveTexture": {"index": 1}}])");
  folder.write("in/scene.gltf", file.json.dump());
  const Scene loaded = load_gltf(folder.path("in/scene.gltf"));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("and 2 more"), std::string::npos) << loaded.warnings[0];
  EXPECT_EQ(loaded.texels.size(), 4u);  // one file, read once
}

TEST_F(GltfUri, NothingOutsideIsFoundByAnotherSpelling) {
  write("out/a.bin");
  for (const char* uri : {"..\\out\\a.bin", "../OUT/a.bin", "..%5Cout%5Ca.bin", "%252e%252e/out/a.bin"}) {
    EXPECT_EQ(error(uri, ""), "") << uri;
    const std::string confined = error(uri, "in");
    EXPECT_NE(confined.find("is outside the folder"), std::string::npos) << uri << ": " << confined;
  }
  const std::string absolute = folder.path("out/a.bin");
  std::string backslashes = absolute, twice = absolute;
  std::replace(backslashes.begin(), backslashes.end(), '/', '\\');
  twice.replace(0, 1, "%252F");
  for (const std::string& uri : {backslashes, twice, "C:" + backslashes, "file:///" + absolute}) {
    EXPECT_NE(error(uri, ""), "") << uri;
    EXPECT_NE(error(uri, "in"), "") << uri;
  }
}

// Only the first are searched for: listing a folder again for each would exceed the test's time limit.
TEST_F(GltfUri, ManyFilesMayBeAbsent) {
  GltfBuilder file = make_triangle();
  for (int i = 0; i < 3000; i++) file.json["images"].push_back({{"uri", "Textures\\" + std::to_string(i) + ".png"}});
  folder.write("in/scene.gltf", file.json.dump());
  for (int i = 0; i < 1000; i++) folder.write("in/" + std::to_string(i), "");
  file.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", "a.bin"}}};
  write("in/a.bin");
  folder.write("in/scene.gltf", file.json.dump());
  EXPECT_EQ(load_gltf(folder.path("in/scene.gltf")).triangles.size(), 1u);
}

TEST_F(GltfUri, AbsentFilesAreNamedAsTheFileNamesThem) {
  EXPECT_NE(error("Textures\\Wood.bin", "").find("refers to Textures\\Wood.bin: no such file"), std::string::npos)
      << error("Textures\\Wood.bin", "");
}

}  // namespace
}  // namespace ods

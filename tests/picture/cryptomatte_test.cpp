// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/cryptomatte.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>

#include "ods/image/image_file.h"
#include "tests/support/temporary_folder.h"

namespace ods::cryptomatte_test {

// Known answers of MurmurHash3_x86_32 with the seed 0.
TEST(Cryptomatte, HashesAreMurmurs) {
  EXPECT_EQ(murmur3(""), 0u);
  EXPECT_EQ(murmur3("test"), 0xba6bd213u);
  EXPECT_EQ(murmur3("Hello, world!"), 0xc0363e43u);
  EXPECT_EQ(murmur3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

TEST(Cryptomatte, NumbersAreNumbers) {
  for (int i = 0; i < 20000; i++) EXPECT_TRUE(std::isnormal(matte_number(std::to_string(i)))) << i;
}

TEST(Cryptomatte, WhatIsWrittenIsReadInBothEyes) {
  const TemporaryFolder folder;
  const std::vector<std::string> names = {"Lamp", "Table \"large\"", "B\xc3\xa4r"};
  Picture picture;
  std::vector<Image> numbers;
  for (const int eye : {kLeft, kRight}) {
    picture.eyes.push_back({eye, Image(6, 3, 3), Image(6, 3, 1), {}, {}});
    Image& own = numbers.emplace_back(6, 3, 1);
    for (size_t i = 0; i < 18; i++) {
      picture.eyes.back().radiance.pixels[3 * i] = 0.25f;
      picture.eyes.back().depth.pixels[i] = static_cast<float>(i) + 1.0f;
      own.pixels[i] = i == 17 ? 0.0f : matte_number(names[(i + static_cast<size_t>(eye)) % 3]);
    }
  }
  PictureRows rows = rows_of(picture, true);
  SaveOptions save;
  add_cryptomatte(rows, save, numbers, names);
  const std::string path = folder.path("x.exr");
  const StereoCamera camera;
  save_picture(rows, &camera, save, path);
  const std::optional<Cryptomatte> matte = find_cryptomatte(read_info(path), path);
  ASSERT_TRUE(matte);
  EXPECT_EQ(matte->layer, "CryptoObject");
  ASSERT_EQ(matte->names.size(), 3u);
  for (const std::string& name : names) EXPECT_EQ(matte->names.at(matte_number(name)), name);
  const StoredPicture stored = open_picture(path);
  for (size_t eye = 0; eye < 2; eye++) EXPECT_EQ(matte_of_eye(stored, eye, *matte).pixels, numbers[eye].pixels);
  EXPECT_TRUE(matte_of_eye(stored, 0, {"Other", {}}).pixels.empty());
}

TEST(Cryptomatte, HeadersOfOthersAndDamagedOnes) {
  FileInfo info;
  EXPECT_FALSE(find_cryptomatte(info, "x.exr"));
  info.text["cryptomatte/1234567/name"] = "ViewLayer.CryptoMaterial";
  info.text["cryptomatte/1234567/manifest"] = "{\"Steel\":\"3f800000\"}";
  info.text["cryptomatte/89abcde/name"] = "ViewLayer.CryptoObject";
  info.text["cryptomatte/89abcde/manifest"] =
      "{\"Cube\":\"40000000\",\"bad\":\"xyz\",\"number\":5,\"long\":\"123456789\"}";
  const std::optional<Cryptomatte> matte = find_cryptomatte(info, "x.exr");
  ASSERT_TRUE(matte);
  EXPECT_EQ(matte->layer, "ViewLayer.CryptoObject");
  ASSERT_EQ(matte->names.size(), 1u);
  EXPECT_EQ(matte->names.at(2.0f), "Cube");
  for (const char* text : {"", "{", "[]", "\"x\""}) {
    info.text["cryptomatte/89abcde/manifest"] = text;
    EXPECT_TRUE(find_cryptomatte(info, "x.exr")->names.empty()) << text;
  }
}

// A number that is not one has no place in an ordered list.
TEST(Cryptomatte, NamesOfNoNumberAreLeftOut) {
  FileInfo info;
  info.text["cryptomatte/89abcde/name"] = "CryptoObject";
  info.text["cryptomatte/89abcde/manifest"] = "{\"a\":\"7fc00000\",\"b\":\"40000000\",\"c\":\"ffffffff\"}";
  EXPECT_EQ(find_cryptomatte(info, "x.exr")->names, (std::map<float, std::string>{{2.0f, "b"}}));
}

// Nothing else of the file gets into a copy.
TEST(Cryptomatte, OnlyNamesAndNumbersOfAFileAreCopied) {
  const TemporaryFolder folder;
  folder.write("x.exr", "");
  folder.write("names.json", "{\"Cube\": \"40000000\", \"token\": \"secret\", \"deep\": {\"a\": \"secret\"}}");
  FileInfo info;
  info.text["cryptomatte/89abcde/manif_file"] = "names.json";
  const std::vector<Attribute> copied = matte_attributes(info, folder.path("x.exr"));
  ASSERT_EQ(copied.size(), 1u);
  EXPECT_EQ(copied[0].name, "cryptomatte/89abcde/manifest");
  EXPECT_EQ(std::get<std::string>(copied[0].value), "{\"Cube\":\"40000000\"}");
}

// The specification's `manif_file`, which must be in the picture's folder.
TEST(Cryptomatte, NamesMayBeInAFileBeside) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("shots"));
  const std::string path = folder.path("shots/x.exr");
  folder.write("shots/x.exr", "");
  folder.write("shots/names.json", "{\"Cube\":\"40000000\"}");
  folder.write("secret.json", "{\"Secret\":\"40000000\"}");
  FileInfo info;
  info.text["cryptomatte/89abcde/name"] = "CryptoObject";
  info.text["cryptomatte/89abcde/manif_file"] = "names.json";
  EXPECT_EQ(find_cryptomatte(info, path)->names, (std::map<float, std::string>{{2.0f, "Cube"}}));
  FileInfo copy;  // in another folder
  for (const Attribute& each : matte_attributes(info, path)) copy.text[each.name] = std::get<std::string>(each.value);
  EXPECT_EQ(copy.text.size(), 2u);
  EXPECT_EQ(find_cryptomatte(copy, "gone.exr")->names, (std::map<float, std::string>{{2.0f, "Cube"}}));
  std::filesystem::create_directory(folder.path("shots/below"));
  for (const char* name : {"shots/below/secret.json", "shots/secret.txt", "shots/.secret.json"}) {
    folder.write(name, "{\"Secret\":\"40000000\"}");
  }
  folder.write("shots/key.json", "-----BEGIN PRIVATE KEY-----");
  std::filesystem::create_symlink("../secret.json", folder.path("shots/out.json"));
  std::filesystem::create_symlink(".secret.json", folder.path("shots/link.json"));
  std::filesystem::create_symlink("..", folder.path("shots/up"));
  for (const std::string& other :
       {std::string("../secret.json"), folder.path("secret.json"), std::string("none"), std::string(),
        std::string("below/secret.json"), std::string("secret.txt"), std::string(".secret.json"),
        std::string("key.json"), std::string("out.json"), std::string("link.json"), std::string("up/secret.json"),
        std::string("./names.json")}) {
    info.text["cryptomatte/89abcde/manif_file"] = other;
    EXPECT_TRUE(find_cryptomatte(info, path)->names.empty()) << other;
    EXPECT_EQ(std::get<std::string>(matte_attributes(info, path)[0].value), other);
  }
  EXPECT_TRUE(find_cryptomatte(info, folder.path("gone.exr"))->names.empty());
}

}  // namespace ods::cryptomatte_test

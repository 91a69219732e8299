// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Cameras and programs add data of their own after the end of a file. They are no damage: every command gives the same
// answer with them.
#include <gtest/gtest.h>

#include "tests/outside/outside.h"

namespace ods::trailing_bytes_test {

class TrailingBytes : public Outside {
 protected:
  // The exit code and the output of each command, without the file's name.
  std::vector<std::string> answers(const std::string& name, const std::string& output) const {
    std::vector<std::string> all;
    for (const std::string& command :
         {"probe " + name, "lint " + name, "convert " + name + " --layout top-bottom --to vr180 -q -o " + output,
          "inject " + name + " -o tagged_" + name + " --layout top-bottom --projection lat-long"}) {
      Ran ran = shell("ods " + command);
      for (size_t at; (at = ran.out.find(name)) != std::string::npos;) ran.out.erase(at, name.size());
      if (!command.starts_with("convert")) ran.out = fmt::format("{} {}", ran.code, ran.out);
      all.push_back(command.starts_with("convert") ? std::to_string(ran.code) : ran.out);
    }
    return all;
  }

  void expect_no_damage(const std::string& ending) const {
    const bool is_video = ending == "mp4" || ending == "mov" || ending == "mkv" || ending == "webm";
    const std::string output = is_video ? "out_180_LR.mp4" : "out_180_LR.png", whole = "whole_360_TB." + ending;
    const std::vector<std::string> right = answers(whole, output);
    EXPECT_EQ(right[2], "0") << ending;
    const std::string converted = folder.read(output);
    std::vector<std::string> tails = {"8db42d694ccc418790edff439fe026bf"};
    // Tails that look like headers of boxes with large and small sizes, a short one, and zeros.
    for (const std::string& tail :
         {std::string("\0\1\2\3\4\5\6\7rest", 12), std::string("\xff\xff\xff\xff....", 8),
          std::string("\0\0\0\1abcdefghijkl", 16), std::string("short"), std::string(400, '\0')}) {
      if (ending == "mp4" || ending == "heic") tails.push_back(tail);
    }
    for (const std::string& tail : tails) {
      const std::string name = "with_360_TB." + ending;
      folder.write(name, folder.read(whole) + tail);
      const std::vector<std::string> with = answers(name, output);
      for (size_t i = 0; i < right.size(); i++) EXPECT_EQ(with[i], right[i]) << ending << " and " << tail;
      EXPECT_TRUE(is_video || folder.read(output) == converted) << ending << " and " << tail;
    }
  }
};

TEST_F(TrailingBytes, OfPicturesAreNoDamage) {
  for (const char* ending : {"png", "jpg", "tif", "webp", "exr", "hdr"}) {
    make_picture(std::string("whole_360_TB.") + ending);
    expect_no_damage(ending);
  }
}

TEST_F(TrailingBytes, OfPhonesPicturesAreNoDamage) {
  if (const std::string why = missing("heif-enc", "heif-enc --help >/dev/null 2>&1"); !why.empty()) GTEST_SKIP() << why;
  make_picture("a.png");
  for (const char* ending : {"heic", "avif"}) {
    const Ran made = shell(
        fmt::format("heif-enc {} -q 80 a.png -o whole_360_TB.{}", ending == std::string("avif") ? "-A" : "", ending));
    if (made.code != 0) continue;  // without that encoder
    expect_no_damage(ending);
  }
}

TEST_F(TrailingBytes, OfVideosAreNoDamage) {
  make_picture("a.0001.png"), make_picture("a.0002.png");
  for (const char* ending : {"mp4", "mov", "mkv", "webm"}) {
    const Ran made = shell(
        fmt::format("ods encode 'a.####.png' -q --layout top-bottom --projection lat-long -o whole_360_TB.{}", ending));
    ASSERT_EQ(made.code, 0) << made.out;
    expect_no_damage(ending);
  }
}

}  // namespace ods::trailing_bytes_test

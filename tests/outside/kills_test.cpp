// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Ten times each, commands that make a file are ended at moments that look random, the same in every run as far as the
// machine allows: by SIGTERM, which they handle, or SIGKILL, which they cannot. A file with its final name is complete,
// and the same command then makes the same file as an undisturbed one.
#include <random>

#include "tests/outside/outside.h"

namespace ods::kills_test {

class Kills : public Outside {
 protected:
  using Words = std::vector<std::string>;

  // more: options of the command, behind the name of its output, which is name with this ending.
  void try_all(const Words& command, const std::string& ending) {
    const auto words = [&](const std::string& name) {
      Words all = command;
      all.insert(all.end(), {"--threads", "2", "-o", folder.path(name + ending)});
      return all;
    };
    const auto start = std::chrono::steady_clock::now();
    Ods whole(words("whole"));
    ASSERT_EQ(whole.finish(), 0) << whole.err;
    const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
    std::mt19937 random(7);
    for (int i = 0; i < 10; i++) {
      Ods ods(words("a"));
      std::this_thread::sleep_for(all * (static_cast<double>(random() % 1000) / 1000.0));
      const int number = random() % 2 == 0 ? SIGTERM : SIGKILL;
      ods.kill(number);
      const int code = ods.finish();
      EXPECT_TRUE(code == 0 || code == (number == SIGTERM ? 128 + SIGTERM : 1000 + SIGKILL) ||
                  code == 1000 + SIGTERM)  // before it listens
          << code << ", signal " << number << ": " << ods.err;
      if (std::filesystem::exists(folder.path("a" + ending))) expect_whole(ending);
      if (i % 4 != 3 && i != 9) continue;  // others begin with what this one has left
      Ods again(words("a"));
      EXPECT_EQ(again.finish(), 0) << again.err;
      expect_whole(ending);
      std::filesystem::remove(folder.path("a" + ending));
    }
    for (const std::string& name : folder.names()) EXPECT_FALSE(name.starts_with("a" + ending)) << name;
  }

  void expect_whole(const std::string& ending) const {
    EXPECT_TRUE(folder.read("a" + ending) == folder.read("whole" + ending)) << "another file than without signals";
  }
};

TEST_F(Kills, Render) {
  try_all({"render", "toys", "-q", "--width", "96", "--samples", "24", "--noise", "none", "--denoise", "none"}, ".exr");
}

TEST_F(Kills, Video) {
  try_all({"video", "toys", "-q", "--width", "32", "--samples", "4", "--frames", "1-8", "--codec", "h264"}, ".mp4");
}

TEST_F(Kills, Convert) {
  ASSERT_EQ(run("video toys -q --width 64 --samples 1 --frames 1-8 --codec h264 -o " + folder.path("in_360_TB.mp4")), 0)
      << err;
  try_all({"convert", folder.path("in_360_TB.mp4"), "-q", "--to", "cube-3x2"}, ".mp4");
}

TEST_F(Kills, Encode) {
  for (int frame = 1; frame <= 9; frame++) make_picture(fmt::format("f_TB.{}.png", frame));
  try_all({"encode", folder.path("f_TB.#.png"), "-q", "--codec", "hevc"}, ".mp4");
}

}  // namespace ods::kills_test

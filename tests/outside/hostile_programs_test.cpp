// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Programs that ods starts: none hangs it, outlives it, or leaves something behind.
#include "tests/outside/outside.h"

namespace ods::hostile_programs_test {

class HostilePrograms : public Outside {
 protected:
  // The exit of ods within a limit of two seconds for other programs; nullopt if it does not end.
  std::optional<Ran> info(const std::string& scene) const {
    const Ran ran = run_line("/usr/bin/timeout -s KILL 15 '" + ods_command() + "' info '" + folder.path(scene) +
                             "' --blender-limit 2");
    return ran.code == 137 ? std::nullopt : std::optional(ran);
  }

  // A program that never ends, and writes its process's number into "pid".
  void hang_assimp() {
    program("bin/assimp", "echo $$ >'" + folder.path("pid") + "'\nexec /bin/sleep 60\n");
    environment.set("PATH", folder.path("bin"));
  }
  bool lives() const { return kill(std::stoi(folder.read("pid")), 0) == 0; }
};

// 94 bytes of a file of triangles, for which some versions of assimp never end.
TEST_F(HostilePrograms, ACutFileOfTrianglesEnds) {
  if (const std::string why = only("assimp"); !why.empty()) GTEST_SKIP() << why;
  folder.write("cut.ply",
               "ply\nformat ascii 1.0\ncomment Created by Open Asset Import Library - http://assimp.sf.net (v5.2");
  const std::optional<Ran> ran = info("cut.ply");
  ASSERT_TRUE(ran) << "it hangs";
  EXPECT_EQ(ran->code, 3) << ran->out;
  EXPECT_NE(ran->out.find("cut.ply"), std::string::npos) << ran->out;
}

TEST_F(HostilePrograms, ThatHangAreEnded) {
  write_triangle("triangle.obj");
  hang_assimp();
  const std::optional<Ran> ran = info("triangle.obj");
  ASSERT_TRUE(ran) << "it hangs";
  EXPECT_EQ(ran->code, 3) << ran->out;
  EXPECT_TRUE(soon([&] { return !lives(); }));
}

TEST_F(HostilePrograms, EndWithOds) {
  write_triangle("triangle.obj");
  hang_assimp();
  for (const int number : {SIGTERM, SIGINT, SIGHUP, SIGKILL}) {
    folder.write("pid", "");
    Ods ods({"info", folder.path("triangle.obj")});
    ASSERT_TRUE(soon([&] { return folder.read("pid").ends_with("\n"); }));
    ods.kill(number);
    ods.finish();
    EXPECT_TRUE(soon([&] { return !lives(); })) << "after signal " << number;
    if (lives()) kill(std::stoi(folder.read("pid")), SIGKILL);
  }
}

TEST_F(HostilePrograms, LeaveNothingBehind) {
  if (const std::string why = missing("blender", "command -v blender"); !why.empty()) GTEST_SKIP() << why;
  write_triangle("triangle.obj");
  ASSERT_EQ(run("info " + folder.path("triangle.obj")), 0) << err;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("tmp")));
}

// An archive unpacks as a folder of the program's name.
TEST_F(HostilePrograms, AFolderIsNotAProgram) {
  write_triangle("triangle.obj");
  std::filesystem::create_directories(folder.path("apps/blender"));
  program("bin/blender", "echo started >'" + folder.path("started") + "'\nexit 1\n");
  environment.set("PATH", folder.path("apps") + ":" + folder.path("bin") + ":" + std::getenv("PATH"));
  run_line("'" + ods_command() + "' info " + folder.path("triangle.obj"));
  EXPECT_EQ(folder.read("started"), "started\n");
}

TEST_F(HostilePrograms, QuietIsQuiet) {
  std::string why = only("assimp");
  if (!why.empty()) why = only("blender");
  if (!why.empty()) GTEST_SKIP() << "skipped: neither assimp nor blender is installed";
  write_triangle("triangle.obj");
  EXPECT_EQ(run("render " + folder.path("triangle.obj") + " --width 16 --samples 1 -q -o " + folder.path("o.png")), 0)
      << err;
  EXPECT_EQ(err, "");
  EXPECT_EQ(out, "");
}

}  // namespace ods::hostile_programs_test

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Long renderings as their user meets them: interrupted, resumed, in parts.
#include <gtest/gtest.h>

#include <csignal>

#include "tests/support/cli_runner.h"

namespace ods::cli_resume_test {

class RenderResume : public Cli {
 protected:
  // A picture that takes seconds, so that a signal comes in the middle: of one thread, which takes as much work from
  // the other tests whatever the machine.
  std::vector<std::string> words(const std::string& file, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = {"render", "toys", "--width",         "128",       "--samples", "160", "--noise",
                                    "none",   "-o",   folder.path(file), "--threads", "1"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  // Starts, and sends the signal as soon as rendering is on its way. Returns the exit code.
  int interrupted(const std::vector<std::string>& arguments, int number = SIGINT) {
    Ods command(arguments);
    command.wait_for(" %,");
    command.kill(number);
    const int code = command.finish();
    out = command.out, err = command.err;
    return code;
  }

  int whole(const std::vector<std::string>& arguments) {
    Ods command(arguments);
    const int code = command.finish();
    out = command.out, err = command.err;
    return code;
  }
};

TEST_F(RenderResume, GoesOnToTheSameBits) {
  ASSERT_EQ(whole(words("whole.png", {"--threads", "2"})), 0) << err;
  ASSERT_EQ(interrupted(words("a.png")), 128 + SIGINT) << err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.png.unfinished", "whole.png"}));
  EXPECT_NE(err.find("the same command resumes"), std::string::npos) << err;
  EXPECT_TRUE(err.ends_with("ods: interrupted\n")) << err;
  ASSERT_EQ(interrupted(words("a.png"), SIGTERM), 128 + SIGTERM) << err;
  ASSERT_EQ(whole(words("a.png")), 0) << err;
  EXPECT_NE(err.find("resuming from '"), std::string::npos) << err;
  EXPECT_EQ(folder.read("a.png"), folder.read("whole.png"));
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.png", "whole.png"}));
}

// One machine of a farm dies, and another takes up its part. A finished part is not rendered again.
TEST_F(RenderResume, APartGoesOnElsewhereAndIsMadeOnce) {
  ASSERT_EQ(whole(words("whole.exr")), 0) << err;
  const auto part = [&](const std::string& number) {
    return std::vector<std::string>{
        "render", "toys", "--width",         "128", "--samples",           "160", "--threads", "1",
        "--part", number, "--skip-existing", "-o",  folder.path("p_#.exr")};
  };
  ASSERT_EQ(interrupted(part("2/2"), SIGTERM), 128 + SIGTERM) << err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"p_2.exr.unfinished", "whole.exr"}));
  ASSERT_EQ(whole(part("2/2")), 0) << err;
  EXPECT_EQ(out, folder.path("p_2.exr") + "\n");
  ASSERT_EQ(whole(part("2/2")), 0) << err;
  EXPECT_EQ(out, "");
  EXPECT_NE(err.find("p_2.exr' exists already"), std::string::npos) << err;
  Ods merge({"merge", folder.path("p_#.exr"), "-o", folder.path("merged.exr"), "--wait", "600"});
  merge.wait_for("these are missing: 1");
  ASSERT_EQ(whole(part("1/2")), 0) << err;
  EXPECT_EQ(merge.finish(), 0) << merge.err;
  EXPECT_EQ(folder.read("merged.exr"), folder.read("whole.exr"));
}

TEST_F(RenderResume, OtherOptionsAreRefusedByName) {
  ASSERT_EQ(interrupted(words("a.png")), 128 + SIGINT) << err;
  const std::string kept = folder.read("a.png.unfinished");
  EXPECT_EQ(whole(words("a.png", {"--seed", "3"})), 2);
  EXPECT_NE(err.find("--seed was 0, now 3; --restart discards it"), std::string::npos) << err;
  EXPECT_EQ(folder.read("a.png.unfinished"), kept);
  folder.write("a.png.unfinished", kept.substr(0, kept.size() / 2));
  EXPECT_EQ(whole(words("a.png")), 3);
  EXPECT_NE(err.find("is damaged"), std::string::npos) << err;
  ASSERT_EQ(run("render furnace --width 16 --samples 2 --restart -o " + folder.path("a.png")), 0) << err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
}

TEST_F(RenderResume, WhatThereIsCanBeSaved) {
  ASSERT_EQ(interrupted(words("a.png", {"--save-unfinished", "--exposure", "1.5", "--layout", "sbs"}), SIGTERM),
            128 + SIGTERM)
      << err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.png", "a.png.unfinished"}));
  EXPECT_EQ(out, folder.path("a.png") + "\n");
  ASSERT_EQ(run("merge " + folder.path("a.png.unfinished") + " -o " + folder.path("b.png")), 0) << err;
  EXPECT_EQ(folder.read("a.png"), folder.read("b.png"));
}

TEST_F(RenderResume, ASecondSignalEndsAtOnce) {
  Ods command(words("a.png"));
  command.wait_for(" %,");
  command.kill(SIGINT);
  command.wait_for("stopping");
  command.kill(SIGINT);
  EXPECT_EQ(command.finish(), 128 + SIGINT);
  EXPECT_FALSE(std::filesystem::exists(folder.path("a.png")));
}

class MergeCommand : public Cli {
 protected:
  void SetUp() override {
    for (int part = 1; part <= 3; part++) {
      ASSERT_EQ(run(render("part_" + std::to_string(part) + ".exr", "--part " + std::to_string(part) + "/3")), 0)
          << err;
    }
  }
  std::string render(const std::string& file, const std::string& more) const {
    return "render toys -q --width 48 --samples 20 --tone linear -o " + folder.path(file) + " " + more;
  }
  std::string parts() const { return folder.path("part_#.exr"); }
};

TEST_F(MergeCommand, GivesTheBitsOfOneRendering) {
  for (const std::string file : {"a.png", "a.exr"}) {
    ASSERT_EQ(run(render(file, "--noise none")), 0) << err;
    const std::string whole = folder.read(file);
    ASSERT_EQ(run("merge " + parts() + " -o " + folder.path(file)), 0) << err;
    EXPECT_EQ(folder.read(file), whole) << file;
  }
  ASSERT_EQ(run(render("a.png", "--noise none --brighter 1")), 0) << err;
  const std::string brighter = folder.read("a.png");
  ASSERT_EQ(run("merge " + parts() + " --brighter 1 -o " + folder.path("a.png")), 0) << err;
  EXPECT_EQ(folder.read("a.png"), brighter);
  ASSERT_EQ(run(render("a.exr", "--noise none --statistics --denoise own")), 0) << err;
  const std::string whole = folder.read("a.exr");
  ASSERT_EQ(run("merge " + parts() + " --statistics --denoise own -o " + folder.path("a.exr")), 0) << err;
  EXPECT_EQ(folder.read("a.exr"), whole);
}

TEST_F(MergeCommand, MissingPartsAreNamed) {
  std::filesystem::remove(folder.path("part_2.exr"));
  const std::string merge = "merge " + parts() + " -o " + folder.path("a.png");
  EXPECT_EQ(run(merge), 3);
  EXPECT_NE(err.find("of 3 parts, these are missing: 2"), std::string::npos) << err;
  EXPECT_EQ(run(merge + " --incomplete"), 0) << err;
}

TEST_F(MergeCommand, WhatDoesNotBelongIsNamed) {
  const std::string one = folder.path("part_1.exr"), to = " -o " + folder.path("a.png");
  ASSERT_EQ(run(render("other.exr", "--part 2/3 --seed 5")), 0) << err;
  EXPECT_EQ(run("merge " + one + " " + folder.path("other.exr") + to), 3);
  EXPECT_NE(err.find("--seed was 0, now 5"), std::string::npos) << err;
  ASSERT_EQ(run(render("other.exr", "--part 2/4")), 0) << err;
  EXPECT_EQ(run("merge " + one + " " + folder.path("other.exr") + to), 3);
  EXPECT_NE(err.find("it is one of 4 parts, not of 3"), std::string::npos) << err;
  EXPECT_EQ(run("merge " + one + " " + one + to), 3);
  EXPECT_NE(err.find("are the same part, 1/3"), std::string::npos) << err;
  ASSERT_EQ(run(render("other.exr", "")), 0) << err;
  EXPECT_EQ(run("merge " + one + " " + folder.path("other.exr") + to), 3);
  EXPECT_NE(err.find("is not a part of a picture"), std::string::npos) << err;
  EXPECT_EQ(run("merge " + folder.path("none_#.exr") + to), 3);
  EXPECT_EQ(run("merge " + one + " -o " + one), 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path("a.png")));
}

TEST_F(MergeCommand, PartsAreExact) {
  for (const std::string wrong : {"--part 4/3", "--part 0/3", "--part 3", "--part 1/3x", "--part 1/3 --noise 0.1",
                                  "--part 1/3 --time-limit 1s", "--part 1/3 --denoise own", "--part 1/30"}) {
    EXPECT_EQ(run(render("a.exr", wrong)), 2) << wrong << err;
  }
  EXPECT_EQ(run(render("a.png", "--part 1/3")), 2) << err;
  EXPECT_EQ(run(render("a.#.exr", "--part 1/3 --frames 1-2")), 2) << err;
  EXPECT_EQ(run(render("a.#.exr", "--restart --frames 1-2")), 2) << err;
}

}  // namespace ods::cli_resume_test

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Texts of files do not reach a terminal as control characters, whichever command prints them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ods/base/text.h"
#include "tests/support/cli_runner.h"
#include "tests/support/tagged_videos.h"

namespace ods::terminal_text_test {

using namespace ods::made;

class TerminalText : public Cli {
 protected:
  // Runs a command, whatever its exit code, and looks at all that it prints.
  void expect_clean(const std::vector<std::string>& words) {
    Ods ods(words);
    ods.finish();
    EXPECT_FALSE(ods.out.empty() && ods.err.empty()) << words[0];
    for (const std::string& said : {ods.out, ods.err}) EXPECT_EQ(terminal_text(said), said) << words[0];
  }
};

// Moves the cursor: ESC [, alone as 0x9b, and as U+009B.
const std::string kHostile =
    "a\x1b[2J\x9b"
    "2J\xc2\x9b"
    "2J\r\x7f\xff";

TEST_F(TerminalText, OfNamesIsClean) {
  const std::string name = folder.path(kHostile + "_360_TB.png"), other = folder.path("b_360_TB.png");
  ASSERT_EQ(run("testcard -q --width 64 -o " + other), 0) << err;
  std::filesystem::copy_file(other, name);
  for (const char* command : {"lint", "probe", "info", "comfort"}) {
    expect_clean({command, name});
    expect_clean({command, name, "--json"});
    expect_clean({command, name + "none"});
  }
  expect_clean({"compare", name, other});
  expect_clean({"compare", name, other, "--json"});
  expect_clean({"convert", name, "-o", name + "/x.png"});
  expect_clean({"convert", name, "-o", name + ".png", "--progress", "json", "-q"});
  expect_clean({"render", "room", "-o", name + ".nothing"});
  expect_clean({kHostile});
  expect_clean({"lint", "--" + kHostile});
}

TEST_F(TerminalText, OfVideosIsClean) {
  Mp4Options options;
  options.height = 256;
  options.entry_boxes = st3d(1) + sv3d(kHostile, kWhole);
  folder.write("v.mp4", mp4(options));
  expect_clean({"probe", folder.path("v.mp4")});
  expect_clean({"probe", folder.path("v.mp4"), "--json"});
  Ods ods({"probe", folder.path("v.mp4")});
  ods.finish();
  EXPECT_NE(ods.out.find("(by a [2J?2J?2J"), std::string::npos) << ods.out << ods.err;
}

TEST_F(TerminalText, OfScenesIsClean) {
  nlohmann::json scene = {{"asset",
                           {{"version", "2.0"},
                            {"generator",
                             "a\x1b[2J\xc2\x9b"
                             "2J"}}},
                          {"scenes", {{{"nodes", {0}}}}},
                          {"nodes",
                           {{{"name",
                              "n\x1b[2J\xc2\x9b"
                              "2J"}}}},
                          {"materials", {{{"name", "m\x1b[2J"}}}}};
  folder.write("scene.gltf", scene.dump());
  expect_clean({"info", folder.path("scene.gltf")});
  expect_clean({"info", folder.path("scene.gltf"), "--json"});
}

}  // namespace ods::terminal_text_test

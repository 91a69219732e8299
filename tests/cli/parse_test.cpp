// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Parsing a command line opens no file, starts no program and prints nothing.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "tests/support/temporary_folder.h"

namespace ods::parse_test {

// The lines of a command's help that start with "  ods NAME ", as words; a remark after two spaces is left out.
std::vector<std::vector<std::string>> examples_of(const Command& command) {
  std::string help;
  Options options(std::string(command.name), {"--help"});
  try {
    command.parse(options);
  } catch (const HelpRequest& request) {
    help = request.text;
  }
  std::vector<std::vector<std::string>> examples;
  std::istringstream lines(help);
  const std::string start = "  ods " + std::string(command.name) + " ";
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(start)) continue;
    line = line.substr(start.size());
    for (const char* const end : {"  ", " > ", " < ", " || "}) line = line.substr(0, line.find(end));
    std::vector<std::string> words(1);
    char quote = 0;
    for (const char c : line) {
      if (quote ? c == quote : c == '\'') {
        quote = quote ? 0 : c;
      } else if (c == ' ' && !quote) {
        if (!words.back().empty()) words.emplace_back();
      } else {
        words.back() += c;
      }
    }
    if (words.back().empty()) words.pop_back();
    examples.push_back(words);
  }
  return examples;
}

// None of the files in the examples exists.
TEST(Parse, NeedsNoFileAndPrintsNothing) {
  const TemporaryFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path(""));
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  size_t count = 0;
  for (const Command& command : commands()) {
    for (const std::vector<std::string>& words : examples_of(command)) {
      count++;
      std::vector<std::pair<std::string, std::string>> given[2];
      for (auto& each : given) {
        Options options(std::string(command.name), words);
        try {
          for (const GivenWord& word : command.parse(options).given) each.emplace_back(word.name, word.value);
        } catch (const std::exception& error) {
          ADD_FAILURE() << command.name << " " << words[0] << ": " << error.what();
        }
      }
      EXPECT_EQ(given[0], given[1]) << command.name;
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(std::filesystem::is_empty("."));
  std::filesystem::current_path(before);
  EXPECT_GT(count, 2 * commands().size());
}

TEST(Parse, TakesWhatFollowsTheDoubleDash) {
  Options options("submit", {"--to", "slurm", "--", "render", "--width", "0"});
  EXPECT_EQ(options.take_rest(), (std::vector<std::string>{"render", "--width", "0"}));
  EXPECT_EQ(options.words(), (std::vector<std::string>{"--to", "slurm"}));
}

// A program named blender that is found first on PATH must not be started for a line with a mistake.
TEST(Parse, ReportsATypoBeforeAnythingIsConverted) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"house.blend", "-o", "a.png", "--widht", "512"},
        std::vector<std::string>{"house.blend"},
        std::vector<std::string>{"house.blend", "-o", "a.png", "--width", "0"}}) {
    Options options("render", words);
    EXPECT_THROW(find_command("render")->parse(options), UsageError) << words.back();
  }
}

}  // namespace ods::parse_test

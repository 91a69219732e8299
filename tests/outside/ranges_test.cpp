// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Every option of every command that is a number: at both ends of its range, beyond them, and as what is not a number.
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/outside/outside.h"

namespace ods::ranges_test {

struct Case {
  const char* command;
  const char* words;  // that work, quickly
};

void PrintTo(const Case& each, std::ostream* out) {
  *out << each.command;
}

constexpr Case kCases[] = {
    {"render", "spheres -o x.png --width 16 --samples 1"},
    {"convert", "in_360_TB.png -o x.png"},
    {"denoise", "in.exr -o x.png"},
    {"merge", "part_#.exr -o x.png"},
    {"layers", "spheres -o x.glb --width 256 --samples 1"},
    {"view", "in_360_TB.png --export site"},
    {"video", "spheres -o x.mp4 --width 16 --samples 1 --duration 0.1"},
    {"encode", "in_360_TB.png -o x.mp4"},
    {"submit", "--dry-run --to flamenco -- convert in_360_TB.png -o x.png"},
    {"title", "words -o x.exr --width 64"},
    {"over", "in.exr in_360_TB.png -o x.png"},
    {"rig", "-o rig.json --width 64"},
    {"stitch", "absent.json views -o x.png"},
    {"info", "spheres"},
    {"blender", "--blender absent"},
    {"camera", "--for blender"},
    {"project", "0,0,-1"},
    {"compare", "in_360_TB.png in_360_TB.png"},
    {"comfort", "in_360_TB.png"},
    {"lint", "in_360_TB.png"},
    {"inject", "in_360_TB.png -o x.png"},
    {"testcard", "-o x.png --width 64"},
};

const std::string& help_of(const std::string& command) {
  static std::map<std::string, std::string> helps;
  const auto [help, is_new] = helps.try_emplace(command);
  if (is_new) help->second = run_line("'" + ods_command() + "' " + command + " --help").out;
  return help->second;
}

class Ranges : public Outside, public ::testing::WithParamInterface<Case> {
 protected:
  void SetUp() override {
    Outside::SetUp();
    make_picture("in_360_TB.png", "--width 16"), make_picture("in.exr", "--width 16 --statistics");
  }

  // Commands share options: those before this one in the table have tried the ends of its range.
  bool was_tried(const std::string& option) const {
    for (const Case& each : kCases) {
      if (each.command == std::string_view(GetParam().command)) return false;
      if (std::regex_search(help_of(each.command), std::regex("[ ,]" + option + " [NX][ \n]"))) return true;
    }
    return false;
  }

  // A line of the command with this option in it, once. It has four gigabytes, and so many seconds.
  Ran run_with(const std::string& option, const std::string& value, int seconds = 60) {
    std::vector<std::string> words = {option, "'" + value + "'"};
    std::istringstream all(GetParam().words);
    for (std::string word; all >> word;) {
      if (word == option && all >> word) continue;
      words.push_back("'" + word + "'");
    }
    std::string line = fmt::format("{} timeout -k 60 {} '{}' {}", kSanitized ? "" : "ulimit -v 4000000;", seconds,
                                   ods_command(), GetParam().command);
    for (const std::string& word : words) line += " " + word;
    const Ran ran = shell(line + " >/dev/null");
    for (const std::string& name : folder.names()) {
      if (name.starts_with("x.") || name == "site") std::filesystem::remove_all(folder.path(name));
    }
    return ran;
  }

  void expect_refused(const std::string& option, const std::string& value) {
    const Ran ran = run_with(option, value);
    EXPECT_EQ(ran.code, 2) << option << " " << value << ": " << ran.out;
    EXPECT_NE(ran.out.find(option), std::string::npos) << option << " " << value << ": " << ran.out;
  }

  // Done, refused for another reason, too much for the memory that it has, or still at work when it is terminated.
  void expect_sane(const std::string& option, const std::string& value) {
    const Ran ran = run_with(option, value, 1);
    const bool lacks_memory = ran.code == 1 && ran.out.find("memory") != std::string::npos;
    EXPECT_TRUE((ran.code >= 0 && ran.code <= 5 && ran.code != 1) || lacks_memory || ran.code == 124)
        << option << " " << value << ": exit code " << ran.code << ", " << ran.out;
  }
};

TEST_P(Ranges, OfEveryNumber) {
  const std::string help = help_of(GetParam().command);
  const std::regex option("\n  (?:-[a-z],)?(--[a-z-]+) [NX][ \n]"),
      range("is a (whole )?number from ([^ ]+) to ([^,]+),");
  int count = 0;
  for (std::sregex_iterator each(help.begin(), help.end(), option), end; each != end; ++each, ++count) {
    const std::string name = (*each)[1];
    for (const char* text : {"nan", "1e400", "-inf", "7x"}) expect_refused(name, text);
    std::smatch found;
    const std::string refusal = run_with(name, "nan").out;
    if (!std::regex_search(refusal, found, range)) continue;  // of no range, or for another projection
    const double low = std::stod(found[2]), high = std::stod(found[3]), step = found[1].matched ? 1.0 : 0.001;
    expect_refused(name, fmt::format("{}", low - step * std::max(1.0, std::abs(low))));
    expect_refused(name, fmt::format("{}", high + step * std::max(1.0, std::abs(high))));
    if (!was_tried(name)) expect_sane(name, found[2]), expect_sane(name, found[3]);
  }
  EXPECT_GT(count, 0) << help;
}

INSTANTIATE_TEST_SUITE_P(Commands, Ranges, ::testing::ValuesIn(kCases),
                         [](const auto& each) { return std::string(each.param.command); });

// A command that gets its first number gets its row.
TEST(RangesCover, EveryCommandWithNumbers) {
  std::set<std::string> known;
  for (const Case& each : kCases) known.insert(each.command);
  const std::string overview = run_line("'" + ods_command() + "' --help").out;
  const std::regex row("\n  ([a-z]+) +[a-z]"), number("\n  (?:-[a-z],)?--[a-z-]+ [NX][ \n]");
  for (std::sregex_iterator each(overview.begin(), overview.end(), row), end; each != end; ++each) {
    EXPECT_EQ(std::regex_search(help_of((*each)[1]), number), known.contains((*each)[1])) << (*each)[1];
  }
}

}  // namespace ods::ranges_test

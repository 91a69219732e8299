// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Man pages and completions: they agree with help, and shells and man accept them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/cli_runner.h"

namespace ods::manual_test {

class Manual : public Cli {
 protected:
  // The names of commands, from help.
  std::vector<std::string> commands() {
    EXPECT_EQ(run("--help"), 0);
    std::vector<std::string> names;
    std::istringstream lines(out.substr(out.find("Commands:\n")));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line) && !line.empty()) names.push_back(line.substr(2, line.find(' ', 2) - 2));
    EXPECT_GT(names.size(), 10u);
    return names;
  }

  // The options of a command, from its help, which does not mention itself.
  std::set<std::string> options_of(const std::string& command) {
    EXPECT_EQ(run(command + " --help"), 0);
    std::set<std::string> names = {"-h", "--help"};
    std::istringstream lines(out);
    const std::regex row("^  (-[^ ]+).*");
    std::smatch match;
    for (std::string line; std::getline(lines, line);) {
      if (!std::regex_match(line, match, row)) continue;
      std::istringstream words(match[1].str());
      for (std::string name; std::getline(words, name, ',');) names.insert(name);
    }
    return names;
  }

  // The output of a shell's command; empty if it fails.
  std::string shell(const std::string& words) {
    const std::string file = folder.path("shell.txt");
    if (std::system((words + " >'" + file + "'").c_str()) != 0) return "";
    return folder.read("shell.txt");
  }

  // The completions that bash offers for the last of these words.
  std::set<std::string> completed(const std::string& words) {
    const std::string script = "words=(" + words +
                               "); COMP_WORDS=(\"${words[@]}\"); COMP_CWORD=$((${#words[@]} - 1)); . " +
                               folder.path("ods.bash") +
                               "; _ods ods \"${words[COMP_CWORD]}\" \"${words[COMP_CWORD - 1]}\" 2>/dev/null; printf "
                               "\"%s\\n\" \"${COMPREPLY[@]}\"";
    std::istringstream lines(shell("bash -c '" + script + "'"));
    std::set<std::string> offered;
    for (std::string line; std::getline(lines, line);) offered.insert(line);
    return offered;
  }

  void write_completion(const std::string& shell_name) {
    ASSERT_EQ(run("--help=" + shell_name), 0) << err;
    folder.write("ods." + shell_name, out);
  }
};

using Names = std::set<std::string>;

TEST_F(Manual, HelpFitsATerminalAndNamesAnArgumentOnce) {
  const std::regex twice("^  ([A-Z]+) \\1( .*|$)");
  for (const std::string& command : commands()) {
    EXPECT_EQ(run(command + " --help"), 0);
    std::istringstream lines(out);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_FALSE(std::regex_match(line, twice)) << command << ": " << line;
      EXPECT_TRUE(line.size() <= 100 || line.starts_with("  ods ")) << command << ": " << line;  // examples are pasted
    }
  }
}

TEST_F(Manual, EveryOptionIsInTheManPage) {
  ASSERT_EQ(run("--help=man"), 0) << err;
  const std::string overview = out;
  for (const std::string& command : commands()) {
    EXPECT_NE(overview.find(".BR ods\\-" + command + " (1)\n"), std::string::npos) << command;
    const Names options = options_of(command);
    EXPECT_GT(options.size(), 3u) << command;
    ASSERT_EQ(run(command + " --help=man"), 0) << err;
    for (const std::string& option : options) {
      const std::string bold = "\\fB" + std::regex_replace(option, std::regex("-"), "\\-") + "\\fR";
      EXPECT_NE(out.find(bold), std::string::npos) << command << " " << option;
    }
  }
}

TEST_F(Manual, BashOffersEveryCommandAndOption) {
  write_completion("bash");
  Names names = {"--help", "--version"};
  for (const std::string& command : commands()) {
    names.insert(command);
    EXPECT_EQ(completed("ods " + command + " -"), options_of(command)) << command;
  }
  EXPECT_EQ(completed("ods \"\""), names);
}

TEST_F(Manual, BashOffersValues) {
  write_completion("bash");
  EXPECT_EQ(completed("ods re"), Names{"render"});
  EXPECT_EQ(completed("ods render room --quality \"\""), (Names{"draft", "preview", "final"}));
  EXPECT_EQ(completed("ods convert a.png --to cub"), (Names{"cube-3x2", "cube-6x1", "cube-1x6"}));
  EXPECT_EQ(completed("ods render --layout top"), (Names{"top-bottom", "top-bottom-half"}));
  EXPECT_EQ(completed("ods render --camera-preset cyc"), Names{"cycles"});
  EXPECT_EQ(completed("ods video --size deovr-4"), Names{"deovr-4096"});
  EXPECT_EQ(completed("ods render roo"), Names{"room"});
  EXPECT_EQ(completed("ods render --width 1"), Names{""}) << "a number is nobody's business";
  EXPECT_EQ(completed("ods render --env sk"), Names{""}) << "left to bash, which offers files";
}

TEST_F(Manual, ZshOffersEveryOption) {
  write_completion("zsh");
  const std::string script = out;
  for (const std::string& command : commands()) {
    const size_t begin = script.find("\n    " + command + ")\n");
    ASSERT_NE(begin, std::string::npos) << command;
    const std::string part = script.substr(begin, script.find(";;", begin) - begin);
    for (const std::string& option : options_of(command)) {
      EXPECT_TRUE(std::regex_search(part, std::regex("[ {,']" + option + "['},].*\\["))) << command << " " << option;
    }
  }
  if (std::system("command -v zsh >/dev/null") != 0) GTEST_SKIP() << "skipped: there is no zsh";
  EXPECT_EQ(std::system(("zsh -n " + folder.path("ods.zsh")).c_str()), 0);
}

// ods submit sends what is marked as a file where it is added (cli/console/value_kind.h), and zsh offers files for it.
TEST_F(Manual, OptionsAndArgumentsThatTakeFilesAreMarked) {
  write_completion("zsh");
  const std::regex option("^ .*[']\\[.*\\]:([^:]*):(.*)' \\\\$"), argument("^      '\\*?:([^:]*):(.*)' \\\\$");
  const Names not_files = {"TEXT", "NAME", "COMMAND", "X,Y,Z..."};
  const Names units = {"FILE", "DIR", "SCENE", "LIGHT", "env|PICTURE"};
  const std::regex path("(^|[^A-Z])(FILE|DIR|FOLDER|PICTURE|SCENE|LIGHT)S?($|[^A-Z])");
  Names seen;
  std::istringstream lines(out);
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    const bool is_option = std::regex_match(line, match, option);
    if (!is_option && !std::regex_match(line, match, argument)) continue;
    const std::string unit = match[1], action = match[2];
    const bool is_path = is_option ? std::regex_search(unit, path) : !not_files.contains(unit);
    EXPECT_EQ(action.find("_files") != std::string::npos, is_path) << line;
    if (is_option && is_path) seen.insert(unit);
  }
  EXPECT_EQ(seen, units);
}

TEST_F(Manual, PagesAreGoodTroff) {
  if (std::system("command -v mandoc >/dev/null") != 0) GTEST_SKIP() << "skipped: there is no mandoc";
  std::vector<std::string> pages = {"--help=man"};
  for (const std::string& command : commands()) pages.push_back(command + " --help=man");
  for (const std::string& page : pages) {
    ASSERT_EQ(run(page), 0);
    folder.write("page.1", out);
    EXPECT_EQ(std::system(("mandoc -T lint -W error " + folder.path("page.1")).c_str()), 0) << page;
  }
}

TEST_F(Manual, OtherFormatsAreRefused) {
  for (const char* words : {"render --help=html", "--help=html"}) {
    EXPECT_EQ(run(words), 2) << words;
    expect_one_error();
  }
}

}  // namespace ods::manual_test

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The languages' own parsers return quoted text unchanged.
#include "ods/base/quote.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/programs.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

const std::vector<std::string> kWords = {"plain",
                                         "",
                                         "two words",
                                         "it's",
                                         "say \"yes\"",
                                         "back\\slash",
                                         "$HOME $(id) `id`",
                                         "a;b|c&d>e<f",
                                         "*?[x]{y}~",
                                         "#number",
                                         "-o",
                                         "naïve 日本語",
                                         "a=b",
                                         "<tag/> &amp;",
                                         "%04d ####",
                                         "{{Param.x}}",
                                         "!bang",
                                         "'",
                                         "\"",
                                         "\\n",
                                         "key: value",
                                         "- item",
                                         "'''",
                                         "\xc2\xa0 "};

std::string in_lines(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + "\n";
  return text;
}

TEST(Quote, TheShellGetsTheWords) {
  EXPECT_EQ(run_line("printf '%s\\n' " + shell_line(kWords)).out, in_lines(kWords));
  EXPECT_EQ(shell_line({"ods", "render", "a b.glb", "-o", "x.png"}), "ods render 'a b.glb' -o x.png");
}

// The text stands in a file that Python reads; it prints the strings, a line each.
std::string read_by_python(const std::string& text, const std::string& script) {
  const TemporaryFolder folder;
  folder.write("text", text);
  folder.write("script.py", "import sys\ntext = open(sys.argv[1], encoding='utf-8').read()\n" + script);
  return run_line("PYTHONIOENCODING=utf-8 python3 " + folder.path("script.py") + " " + folder.path("text")).out;
}

TEST(Quote, JsonAndYamlGetTheWords) {
  std::string list;
  for (const std::string& word : kWords) list += (list.empty() ? "[" : ", ") + json_text(word);
  list += "]";
  if (const std::string why = missing("python3", "python3 -c 0"); !why.empty()) GTEST_SKIP() << why;
  EXPECT_EQ(read_by_python(list, "import json\nfor word in json.loads(text): print(word)\n"), in_lines(kWords));
  if (const std::string why = missing("python3-yaml", "python3 -c 'import yaml'"); !why.empty()) GTEST_SKIP() << why;
  EXPECT_EQ(
      read_by_python("words: " + list + "\n", "import yaml\nfor word in yaml.safe_load(text)['words']: print(word)\n"),
      in_lines(kWords));
}

TEST(Quote, XmlGetsTheWords) {
  if (const std::string why = missing("python3", "python3 -c 0"); !why.empty()) GTEST_SKIP() << why;
  std::string xml = "<list>";
  for (const std::string& word : kWords) xml += "<w a=\"" + xml_text(word) + "\">" + xml_text(word) + "</w>";
  const std::string script =
      "import xml.etree.ElementTree as E\nfor w in E.fromstring(text):\n  assert w.get('a') == (w.text or '')\n  "
      "print(w.text or '')\n";
  EXPECT_EQ(read_by_python(xml + "</list>", script), in_lines(kWords));
}

TEST(Quote, LineBreaksControlsAndWrongBytesAreNotQuotable) {
  for (const std::string& word : kWords) EXPECT_TRUE(is_quotable(word)) << word;
  for (const std::string word :
       {"a\nb", "a\r", "tab\t", "\x1b[1m", "\x7f", "latin\xe9", "\xf0\x28\x8c\x28", "\xc0\xaf"}) {
    EXPECT_FALSE(is_quotable(word)) << word;
  }
  EXPECT_FALSE(is_quotable(std::string_view("a\0b", 3)));
}

TEST(Quote, NoLanguageGetsControlCharacters) {
  for (const char* text : {"\x1b[2J", "\x9b", "\xc2\x9b", "a\nb", "a\tb", "\x7f"})
    EXPECT_FALSE(is_quotable(text)) << text;
  EXPECT_EQ(xml_text("\x1b<\x9b>\xc2\x9b"), "?&lt;?&gt;?");
  const nlohmann::ordered_json json = {{"name", "\x1b\x7f\xc2\x9b\xc3\xa9"}};
  EXPECT_EQ(json_document(json), "{\"name\":\"\\u001b\\u007f\\u009b\xc3\xa9\"}");
  EXPECT_EQ(nlohmann::ordered_json::parse(json_document(json, 2)), json);
  EXPECT_EQ(json_document("a\xff"), "\"a\xef\xbf\xbd\"");
}

}  // namespace
}  // namespace ods

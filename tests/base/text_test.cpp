// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/text.h"

#include <gtest/gtest.h>

namespace ods {
namespace {

TEST(ValidUtf8, KeepsCharactersAndReplacesOtherBytes) {
  const std::string good = "a\x7f\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\xf4\x8f\xbf\xbf";
  EXPECT_EQ(valid_utf8(good), good);
  EXPECT_EQ(valid_utf8(""), "");
  const std::string no = "\xef\xbf\xbd";
  EXPECT_EQ(valid_utf8("a\xff"
                       "b"),
            "a" + no + "b");
  EXPECT_EQ(valid_utf8("\xe2\x82"), no + no) << "cut short";
  EXPECT_EQ(valid_utf8("\xc3"
                       "a"),
            no + "a");
  EXPECT_EQ(valid_utf8("\xc0\xaf"), no + no) << "longer than needed";
  EXPECT_EQ(valid_utf8("\xe0\x80\xaf"), no + no + no) << "longer than needed";
  EXPECT_EQ(valid_utf8("\xf0\x80\x80\xaf"), no + no + no + no) << "longer than needed";
  EXPECT_EQ(valid_utf8("\xed\xa0\x80"), no + no + no) << "half of a pair";
  EXPECT_EQ(valid_utf8("\xf4\x90\x80\x80"), no + no + no + no) << "beyond the last character";
}

TEST(TerminalText, HasNothingThatMovesATerminal) {
  EXPECT_EQ(terminal_text("a line\n\tand \xc3\xa9\xe6\x97\xa5\n"), "a line\n\tand \xc3\xa9\xe6\x97\xa5\n");
  EXPECT_EQ(terminal_text("\x1b[2J\r\b\x7f"), "?[2J???");
  EXPECT_EQ(terminal_text("\x9b"
                          "2J \xff"),
            "?2J ?")
      << "bytes that are no UTF-8";
  EXPECT_EQ(terminal_text("\xc2\x9b"
                          "2J \xc2\x85\xc2\xa0"),
            "?2J ?\xc2\xa0")
      << "control characters of two bytes";
  EXPECT_EQ(terminal_text(std::string("a\0b", 3)), "a?b");
}

TEST(LibraryWords, AreOneLineOfText) {
  EXPECT_EQ(library_message("bad\nchannel \"\x80R\"\n"), "bad channel \"\xef\xbf\xbdR\"");
  EXPECT_THROW(library_message("std::bad_alloc"), std::bad_alloc);
}

}  // namespace
}  // namespace ods

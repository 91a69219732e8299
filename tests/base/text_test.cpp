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

TEST(LibraryWords, AreOneLineOfText) {
  EXPECT_EQ(library_words("bad\nchannel \"\x80R\"\n"), "bad channel \"\xef\xbf\xbdR\"");
  EXPECT_THROW(library_words("std::bad_alloc"), std::bad_alloc);
}

}  // namespace
}  // namespace ods

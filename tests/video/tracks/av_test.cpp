// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/tracks/av.h"

#include <gtest/gtest.h>

#include <cerrno>

#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

// FFmpeg's own error codes: FFERRTAG of libavutil/error.h.
constexpr int tag(unsigned char a, char b, char c, char d) {
  return -static_cast<int>(static_cast<unsigned>(a) | static_cast<unsigned>(b) << 8 | static_cast<unsigned>(c) << 16 |
                           static_cast<unsigned>(d) << 24);
}

std::string error_of(int code) {
  try {
    av::checked(code, ErrorKind::kInput, "cannot read 'a.mp4'");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// Each of libavutil/error.h, and one that no FFmpeg has yet.
TEST(Av, FfmpegsOwnErrorsSayMoreThanItsTexts) {
  const int kCodes[] = {
      tag(0xf8, 'B', 'S', 'F'), tag('B', 'U', 'G', '!'),  tag('B', 'U', 'F', 'S'),  tag(0xf8, 'D', 'E', 'C'),
      tag(0xf8, 'D', 'E', 'M'), tag(0xf8, 'E', 'N', 'C'), tag('E', 'O', 'F', ' '),  tag('E', 'X', 'I', 'T'),
      tag('E', 'X', 'T', ' '),  tag(0xf8, 'F', 'I', 'L'), tag('I', 'N', 'D', 'A'),  tag(0xf8, 'M', 'U', 'X'),
      tag(0xf8, 'O', 'P', 'T'), tag('P', 'A', 'W', 'E'),  tag(0xf8, 'P', 'R', 'O'), tag(0xf8, 'S', 'T', 'R'),
      tag('B', 'U', 'G', ' '),  tag('U', 'N', 'K', 'N'),  tag('N', 'E', 'W', '!')};
  for (const int code : kCodes) {
    const std::string text = error_of(code);
    EXPECT_TRUE(text.starts_with("cannot read 'a.mp4': ")) << text;
    for (const char* theirs : {"patches welcome", "should not have happened", "when processing input"}) {
      EXPECT_EQ(text.find(theirs), std::string::npos) << text;
    }
    const bool says_what_to_try = text.find("try ") != std::string::npos || text.find("convert ") != std::string::npos;
    EXPECT_TRUE(says_what_to_try || text.find(": it ") != std::string::npos) << text;
  }
  EXPECT_EQ(error_of(tag('P', 'A', 'W', 'E')),
            "cannot read 'a.mp4': this machine's FFmpeg does not support that; try another codec, format or size, or a "
            "newer FFmpeg");
}

// Whatever the name of a list, FFmpeg recognises it by its first bytes, and would read the files that it names.
TEST(Av, NoFileNamesAnother) {
  const TemporaryFolder folder;
  const auto number = [](uint32_t value, int bytes) {
    return std::string(reinterpret_cast<const char*>(&value), static_cast<size_t>(bytes));
  };
  const std::string samples(8000, '\0');
  folder.write("good.wav", "RIFF" + number(36 + 8000, 4) + "WAVEfmt " + number(16, 4) + number(1, 2) + number(1, 2) +
                               number(8000, 4) + number(8000, 4) + number(1, 2) + number(8, 2) + "data" +
                               number(8000, 4) + samples);
  EXPECT_NE(av::open_file(folder.path("good.wav"), "cannot read it"), nullptr);
  const std::string hls =
      "#EXTM3U\n#EXT-X-TARGETDURATION:9\n#EXTINF:1,\n" + folder.path("good.wav") + "\n#EXT-X-ENDLIST\n";
  folder.write("list.m3u8", hls);
  folder.write("list.wav", hls);
  folder.write("concat.wav", "ffconcat version 1.0\nfile good.wav\n");
  for (const char* list : {"list.m3u8", "list.wav", "concat.wav"}) {
    EXPECT_THROW(av::open_file(folder.path(list), "cannot read it"), Error) << list;
    EXPECT_EQ(error_of(-ENOSPC), "cannot read 'a.mp4': No space left on device") << "what FFmpeg logged of " << list;
  }
}

TEST(Av, ErrorsOfTheSystemKeepTheirWords) {
  EXPECT_EQ(error_of(-ENOSPC), "cannot read 'a.mp4': No space left on device");
  EXPECT_THROW(av::checked(-ENOMEM, ErrorKind::kInput, "cannot read 'a.mp4'"), Error);
  EXPECT_EQ(av::checked(7, ErrorKind::kInput, ""), 7);
}

}  // namespace
}  // namespace ods

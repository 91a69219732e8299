// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/suggest.h"

#include <gtest/gtest.h>

namespace ods {
namespace {

using namespace std::string_view_literals;

TEST(TakenBy, AFileOfAnotherKindLeadsToItsCommands) {
  for (const std::string_view video : {"\0\0\0\x18"
                                       "ftypisom"sv,
                                       "\x1a\x45\xdf\xa3\x9f"sv}) {
    EXPECT_NE(taken_by(video).find("it is a video: ods probe"), std::string::npos);
  }
  EXPECT_NE(taken_by("glTF\2"sv).find("it is a scene: ods render"), std::string::npos);
  for (const std::string_view picture : {"\x89PNG\r\n"sv, "\xff\xd8\xff\xe0"sv, "II*\0"sv, "\x76\x2f\x31\x01"sv}) {
    EXPECT_NE(taken_by(picture).find("it is a picture: ods probe, lint, convert"), std::string::npos);
  }
  for (const std::string_view video : {"RIFF\1\2\3\4AVI LIST"sv, "OggS\0"sv, "G@\x11\x10"sv, "\x06\x0e\x2b\x34\2"sv}) {
    EXPECT_NE(taken_by(video).find("-c copy FILE.mkv"), std::string::npos);
  }
  EXPECT_NE(taken_by("\1\2\3\4G@\0\x10"sv).find("MVC"), std::string::npos) << "m2ts has a time before each packet";
  EXPECT_NE(taken_by("#EXTM3U\n"sv).find("playlist"), std::string::npos);
  EXPECT_NE(taken_by("PK\3\4"sv).find("npz"), std::string::npos);
  for (const std::string_view other : {""sv, "ft"sv, "hello, world"sv, "{}"sv}) EXPECT_EQ(taken_by(other), "");
}

}  // namespace
}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/video/turn_keys.h"

#include <gtest/gtest.h>

#include "ods/base/error.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

TEST(ParseTime, KnowsSecondsMinutesAndHours) {
  EXPECT_EQ(parse_time("12.5"), 12.5);
  EXPECT_EQ(parse_time("0"), 0.0);
  EXPECT_EQ(parse_time("1:02.5"), 62.5);
  EXPECT_EQ(parse_time("2:01:02"), 7262.0);
  EXPECT_EQ(parse_time("90"), 90.0);
  for (const char* wrong : {"", "x", "1:", ":5", "1:60", "1.5:20", "1:2:3:4", "-3", "1e2", "1 ", "nan"}) {
    EXPECT_FALSE(parse_time(wrong)) << wrong;
  }
}

class TurnKeys : public ::testing::Test {
 protected:
  std::vector<TurnKey> read(const std::string& text) const {
    folder.write("a.keys", text);
    return read_turn_keys(folder.path("a.keys"));
  }
  TemporaryFolder folder;
};

TEST_F(TurnKeys, AnglesAreLinearBetweenThem) {
  const std::vector<TurnKey> keys = read("# tripod\n\n0:01 2\n 3 10 20 -4 # a kick\n1:00\t0 0 0\n");
  ASSERT_EQ(keys.size(), 3u);
  const auto expect = [&](double seconds, float yaw, float pitch, float roll) {
    const ViewAngles at = turned_at(keys, seconds);
    EXPECT_NEAR(at.yaw, yaw, 1e-5f) << seconds;
    EXPECT_NEAR(at.pitch, pitch, 1e-5f) << seconds;
    EXPECT_NEAR(at.roll, roll, 1e-5f) << seconds;
  };
  expect(0.0, 0.0f, 0.0f, 2.0f);
  expect(1.0, 0.0f, 0.0f, 2.0f);
  expect(2.0, 5.0f, 10.0f, -1.0f);
  expect(3.0, 10.0f, 20.0f, -4.0f);
  expect(31.5, 5.0f, 10.0f, -2.0f);
  expect(99.0, 0.0f, 0.0f, 0.0f);
}

TEST_F(TurnKeys, WrongLinesAreSaid) {
  for (const char* wrong :
       {"0 1\n0 2\n", "0 1\nfive 2\n", "0 1\n1 2 3\n", "0 1\n1\n", "0 1\n1 400\n", "0 1\n1 nan\n"}) {
    try {
      read(wrong);
      ADD_FAILURE() << wrong;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_NE(std::string(error.what()).find("a.keys', line 2: a keyframe is"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(read("# nothing\n"), Error);
}

}  // namespace
}  // namespace ods

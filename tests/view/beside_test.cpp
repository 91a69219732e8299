// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/beside.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ods/base/error.h"
#include "tests/support/temporary_folder.h"

using namespace ods;

namespace {

class Beside : public ::testing::Test {
 protected:
  // The error in these notes; empty if there is none.
  std::string fault(const std::string& json) const {
    folder_.write("a_360_TB.notes.json", json);
    try {
      read_notes(folder_.path("a_360_TB.jpg"));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
};

}  // namespace

TEST_F(Beside, NotesAreRead) {
  folder_.write("a_360_TB.notes.json", R"({"caption": "A \u00e4", "hotspots": [
    {"yaw": 30, "pitch": -5.5, "title": "One", "text": "<b>two</b>\nthree"}, {"yaw": -300, "title": "Four"}]})");
  const Notes notes = read_notes(folder_.path("a_360_TB.jpg"));
  EXPECT_EQ(notes.caption, "A \u00e4");
  ASSERT_EQ(notes.hotspots.size(), 2u);
  EXPECT_EQ(notes.hotspots[0].yaw, 30.0f);
  EXPECT_EQ(notes.hotspots[0].pitch, -5.5f);
  EXPECT_EQ(notes.hotspots[0].text, "<b>two</b>\nthree");
  EXPECT_EQ(notes.hotspots[1].title, "Four");
  EXPECT_TRUE(read_notes(folder_.path("b.jpg")).hotspots.empty());
  EXPECT_TRUE(read_notes(folder_.path("pair_%V.png")).caption.empty());
}

TEST_F(Beside, TooMuchIsRefused) {
  const auto spots = [](size_t count, const std::string& spot) {
    std::string list;
    for (size_t i = 0; i < count; i++) list += (i ? "," : "") + spot;
    return R"({"hotspots": [)" + list + "]}";
  };
  EXPECT_EQ(fault(spots(200, R"({"title": "a"})")), "");
  EXPECT_NE(fault(spots(201, R"({"title": "a"})")).find("hotspots must be a list of at most 200"), std::string::npos);
  EXPECT_NE(fault(spots(1, R"({"text": "a"})")).find("hotspots.0.title must be text"), std::string::npos);
  EXPECT_NE(fault(spots(1, R"({"title": "a", "pitch": 91})")).find("hotspots.0.pitch"), std::string::npos);
  for (const auto& [key, maximum] : {std::pair{"title", 100}, {"text", 1000}}) {
    const auto with = [&, key = key](int count) {
      const std::string text(static_cast<size_t>(count), 'x'), other = key == std::string("text") ? "title" : "text";
      return spots(1, fmt::format(R"({{"{}": "{}", "{}": "a"}})", key, text, other));
    };
    EXPECT_EQ(fault(with(maximum)), "") << key;
    EXPECT_NE(fault(with(maximum + 1)).find(fmt::format("at most {} bytes", maximum)), std::string::npos) << key;
  }
  EXPECT_NE(fault(R"({"caption": ")" + std::string(401, 'x') + "\"}").find("at most 400 bytes"), std::string::npos);
  EXPECT_NE(fault(R"({"caption": 5})").find("caption must be text"), std::string::npos);
  EXPECT_NE(fault("not JSON").find("a_360_TB.notes.json"), std::string::npos);
  EXPECT_NE(fault(std::string(300'000, ' ')), "");
  EXPECT_NE(fault("[]"), "");
  EXPECT_NE(fault(R"({"hotspots": [5]})"), "");
}

TEST_F(Beside, SubtitlesAreWebVtt) {
  const std::string text = "WEBVTT\n\n00:00.000 --> 00:01.000\nHello\n";
  folder_.write("a.vtt", text);
  EXPECT_EQ(read_subtitles(folder_.path("a.mp4")), text);
  EXPECT_EQ(read_subtitles(folder_.path("b.mp4")), "");
  folder_.write("a.vtt", "1\n00:00:00,000 --> 00:00:01,000\nHello\n");
  EXPECT_THROW(read_subtitles(folder_.path("a.mp4")), Error);
  folder_.write("a.vtt", text + std::string(3 << 20, 'x'));
  EXPECT_THROW(read_subtitles(folder_.path("a.mp4")), Error);
}

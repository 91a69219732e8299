// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/parts_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "ods/base/error.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

const Settings kSet = {{"layout", "as set", ""}};

class PartsFiles : public testing::Test {
 protected:
  std::vector<std::string> records_of(PartsFile& parts) const {
    std::vector<std::string> records;
    parts.read([&](std::string_view record) { records.emplace_back(record); });
    return records;
  }

  // Two parts of one and two records, and what a killed process wrote after them.
  std::string bytes_of_two_parts() {
    std::string bytes;
    {
      PartsFile parts(path, kSet);
      parts.add("one"), parts.end_part();
      parts.add("two"), parts.add(""), parts.end_part();
      parts.add("three");
    }
    bytes = folder.read("film.mp4.unfinished");
    std::filesystem::remove(path + ".unfinished");
    return bytes;
  }

  TemporaryFolder folder;
  const std::string path = folder.path("film.mp4");
};

TEST_F(PartsFiles, FinishedPartsAreReadAndOthersFollow) {
  folder.write("film.mp4.unfinished", bytes_of_two_parts());
  {
    PartsFile parts(path, kSet);
    EXPECT_EQ(parts.count(), 2);
    EXPECT_EQ(records_of(parts), (std::vector<std::string>{"one", "two", ""}));
    parts.add("four"), parts.end_part();
  }
  PartsFile parts(path, kSet);
  EXPECT_EQ(parts.count(), 3);
  EXPECT_EQ(records_of(parts), (std::vector<std::string>{"one", "two", "", "four"}));
  parts.remove();
  EXPECT_FALSE(std::filesystem::exists(path + ".unfinished"));
}

// Wherever a process was killed, whole parts are read and nothing else.
TEST_F(PartsFiles, EveryTruncationGivesWholeParts) {
  const std::string bytes = bytes_of_two_parts();
  const size_t head = std::string("omnistereo parts, 2\n").size() + 4 + settings_text(kSet).size();
  const size_t first = head + 4 + 3 + 12, second = first + 4 + 3 + 4 + 12;
  for (size_t size = 0; size <= bytes.size(); size++) {
    folder.write("film.mp4.unfinished", bytes.substr(0, size));
    PartsFile parts(path, kSet);
    EXPECT_EQ(parts.count(), size < first ? 0 : size < second ? 1 : 2) << size;
    EXPECT_EQ(records_of(parts).size(), size < first ? 0u : size < second ? 1u : 3u) << size;
  }
}

TEST_F(PartsFiles, ChangedSettingsAreDamage) {
  std::string bytes = bytes_of_two_parts();
  bytes[bytes.find("as set")] = 'A';
  folder.write("film.mp4.unfinished", bytes);
  try {
    const PartsFile parts(path, kSet);
    ADD_FAILURE() << "parts of unknown settings are continued";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_NE(std::string(error.what()).find(".unfinished' is damaged"), std::string::npos) << error.what();
  }
  EXPECT_EQ(PartsFile(path, kSet, true).count(), 0);
}

TEST_F(PartsFiles, OfOtherSettingsTheyStayUnlessItStartsOver) {
  const Settings other = {{"layout", "otherwise", ""}};
  const std::string bytes = bytes_of_two_parts();
  folder.write("film.mp4.unfinished", bytes);
  try {
    const PartsFile parts(path, other);
    ADD_FAILURE() << "parts of other settings are continued";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "'" + path +
                                             ".unfinished' was made with other options: layout was as set, now "
                                             "otherwise; `restart` discards it and starts over");
  }
  EXPECT_EQ(folder.read("film.mp4.unfinished"), bytes);
  const PartsFile parts(path, other, true);
  EXPECT_EQ(parts.count(), 0);
  EXPECT_FALSE(std::filesystem::exists(path + ".unfinished"));
}

TEST_F(PartsFiles, NothingStaysWithoutAPart) {
  {
    PartsFile parts(path, {});
    parts.add("one");
    EXPECT_TRUE(std::filesystem::exists(path + ".unfinished"));
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST_F(PartsFiles, AnotherFileAndAnotherProcessAreRefused) {
  folder.write("film.mp4.unfinished", "somebody's");
  EXPECT_THROW(PartsFile(path, {}), Error);
  EXPECT_EQ(folder.read("film.mp4.unfinished"), "somebody's");
  std::filesystem::remove(path + ".unfinished");
  std::filesystem::create_directory(path + ".unfinished");
  EXPECT_THROW(PartsFile(path, {}), Error);
  std::filesystem::remove(path + ".unfinished");
  PartsFile parts(path, {});
  EXPECT_THROW(PartsFile(path, {}), Error);
}

}  // namespace
}  // namespace ods

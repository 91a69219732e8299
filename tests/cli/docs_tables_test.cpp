// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The tables of docs/ list what the sources have.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "ods/camera/file_names.h"
#include "ods/files/read_file.h"
#include "ods/picture/face_files.h"
#include "ods/picture/metadata/format_source.h"
#include "ods/picture/metadata/name_words.h"
#include "tests/support/places.h"

namespace ods::docs_tables_test {

constexpr size_t kLargest = 1 << 20;  // bytes of a page

TEST(DocsTables, ListTheWordsOfNames) {
  std::string table = "| word | meaning |\n|---|---|\n", eyes = "| left | right |\n|---|---|\n", faces = "|---|\n";
  for (const NameWordRow& row : name_words()) table += fmt::format("| `{}` | {} |\n", row.word, row.text);
  for (const EyeWords& row : kEyeWordsTable) eyes += fmt::format("| `{}` | `{}` |\n", row.left, row.right);
  for (const FaceWords& row : kFaceWordsTable) {
    for (const std::string_view word : row.words) faces += fmt::format("| `{}` ", word);
    faces += row.doubt.empty() ? "| read |\n" : fmt::format("| refused: {} |\n", row.doubt);
  }
  const std::string page = read_text(source_folder() + "/docs/foreign.md", kLargest);
  for (const std::string& part : {table, eyes, faces}) EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST(DocsTables, ListTheSourcesOfAFormatInTheirOrder) {
  std::string table = "| source | for example |\n|---|---|\n";
  for (const FormatSourceRow& row : kFormatSourceTable) table += fmt::format("| {} | {} |\n", row.name, row.text);
  EXPECT_NE(read_text(source_folder() + "/docs/identify.md", kLargest).find(table), std::string::npos) << table;
}

}  // namespace ods::docs_tables_test

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// OpenEXR is the judge.
#include "ods/image/codec/exr_rows.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "ods/base/error.h"
#include "tests/support/exr_files.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

const std::vector<std::string> kLight = {"R", "G", "B"};

ExrForm form_of(int width, int height) {
  ExrForm form;
  form.width = width, form.height = height;
  return form;
}

// Half of it smooth, which packs well, half noise, which does not.
std::vector<std::byte> write_noise(const ExrForm& form, const std::string& path) {
  std::mt19937 random(5);
  std::vector<std::byte> pixels(bytes_of_pixels(form));
  for (size_t i = 0; i < pixels.size(); i++) {
    pixels[i] = static_cast<std::byte>(i < pixels.size() / 2 ? i / 64 : random() & 0x3f);
  }
  write_exr(path, form, pixels);
  return pixels;
}

std::vector<std::byte> rows_of(const ExrRows& exr, int begin, int end, size_t channels, size_t row_size) {
  std::vector<std::byte> pixels(static_cast<size_t>(end - begin) * row_size);
  exr.read(begin, end, channels, pixels.data());
  return pixels;
}

TEST(ExrRows, AreWhatWasWritten) {
  const TemporaryFolder folder;
  std::vector<ExrForm> forms(8, form_of(37, 41));
  forms[1].packing = "zips";
  forms[2].width = 1, forms[2].height = 1;
  forms[3].width = 5, forms[3].height = 16;
  forms[4].channels = {"R", "G", "B", "A", "Z", "id"};
  forms[4].types = {Imf::HALF, Imf::HALF, Imf::HALF, Imf::HALF, Imf::FLOAT, Imf::UINT};
  forms[5].order = Imf::DECREASING_Y;
  forms[6].left = -3, forms[6].top = 9;
  forms[7].width = 700, forms[7].types.assign(3, Imf::FLOAT);
  for (size_t i = 0; i < forms.size(); i++) {
    const std::string path = folder.path(std::to_string(i) + ".exr");
    const std::vector<std::byte> written = write_noise(forms[i], path);
    const size_t row_size = written.size() / static_cast<size_t>(forms[i].height);
    const auto exr = ExrRows::open(path, forms[i].channels);
    ASSERT_TRUE(exr) << i;
    EXPECT_TRUE(rows_of(*exr, 0, forms[i].height, forms[i].channels.size(), row_size) == written) << i;
    if (forms[i].height < 40) continue;
    const std::vector<std::byte> some = rows_of(*exr, 7, 35, forms[i].channels.size(), row_size);
    EXPECT_EQ(std::memcmp(some.data(), &written[7 * row_size], some.size()), 0) << i;
  }
}

TEST(ExrRows, FirstChannelsInAnyOrder) {
  const TemporaryFolder folder;
  const std::vector<std::byte> written = write_noise(form_of(37, 41), folder.path("a.exr"));
  const auto exr = ExrRows::open(folder.path("a.exr"), {"B", "R", "G"});
  ASSERT_TRUE(exr);
  const std::vector<std::byte> two = rows_of(*exr, 0, 41, 2, 37 * 4);
  for (size_t i = 0; i < 37 * 41; i++) {
    ASSERT_EQ(std::memcmp(&two[4 * i], &written[6 * i + 4], 2), 0) << i;
    ASSERT_EQ(std::memcmp(&two[4 * i + 2], &written[6 * i], 2), 0) << i;
  }
}

TEST(ExrRows, LeaveOtherFilesAlone) {
  const TemporaryFolder folder;
  for (const char* packing : {"none", "rle", "piz", "pxr24", "b44", "dwaa"}) {
    ExrForm form = form_of(37, 41);
    form.packing = packing;
    write_noise(form, folder.path("a.exr"));
    EXPECT_FALSE(ExrRows::open(folder.path("a.exr"), kLight)) << packing;
  }
  ExrForm tiled = form_of(37, 41);
  tiled.tile = 16;
  write_noise(tiled, folder.path("a.exr"));
  EXPECT_FALSE(ExrRows::open(folder.path("a.exr"), kLight));
  write_noise(form_of(37, 41), folder.path("a.exr"));
  EXPECT_FALSE(ExrRows::open(folder.path("a.exr"), {"R", "Y"}));
  EXPECT_FALSE(ExrRows::open(folder.path("none.exr"), kLight));
  folder.write("a.exr", "no EXR");
  EXPECT_FALSE(ExrRows::open(folder.path("a.exr"), kLight));
}

// Returns whether a file is refused; the pixels of a damaged file may be anything.
bool is_refused(const TemporaryFolder& folder, const std::string& bytes) {
  folder.write("b.exr", bytes);
  const auto exr = ExrRows::open(folder.path("b.exr"), kLight);
  if (!exr) return true;
  try {
    rows_of(*exr, 0, 41, 3, 37 * 6);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    return true;
  }
  return false;
}

TEST(ExrRows, SurviveDamage) {
  const TemporaryFolder folder;
  write_noise(form_of(37, 41), folder.path("a.exr"));
  const std::string whole = folder.read("a.exr");
  for (size_t size = 0; size < whole.size(); size += 97) EXPECT_TRUE(is_refused(folder, whole.substr(0, size))) << size;
  std::mt19937 random(3);
  int refused = 0;
  for (int i = 0; i < 400; i++) {
    std::string file = whole;
    // The data window is left out: OpenEXR has checked it when rows are read.
    const size_t start = i % 2 == 0 ? file.size() / 4 : file.find("lineOrder");
    for (int k = 0; k <= i % 4; k++) file[start + random() % (file.size() - start)] = static_cast<char>(random());
    refused += is_refused(folder, file) ? 1 : 0;
  }
  EXPECT_GT(refused, 100);  // ZIP has a sum over what it packs
}

}  // namespace
}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// OpenImageIO is the judge.
#include "ods/image/codec/exr_rows.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "ods/base/error.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

const std::vector<std::string> kLight = {"R", "G", "B"};

struct Form {
  int width = 37;
  int height = 41;
  std::string packing = "zip";
  std::vector<std::string> channels = kLight;
  std::vector<OIIO::TypeDesc> types = {OIIO::TypeDesc::HALF, OIIO::TypeDesc::HALF, OIIO::TypeDesc::HALF};
  std::string line_order = "increasingY";
  int tile = 0;
  int left = 0;  // of the data window
  int top = 0;
};

OIIO::ImageSpec spec_of(const Form& form) {
  OIIO::ImageSpec spec(form.width, form.height, static_cast<int>(form.channels.size()), form.types[0]);
  spec.channelnames = form.channels;
  spec.channelformats = form.types;
  spec.x = spec.full_x = form.left, spec.y = spec.full_y = form.top;
  spec.tile_width = spec.tile_height = form.tile;
  spec.attribute("compression", form.packing);
  spec.attribute("openexr:lineOrder", form.line_order);
  return spec;
}

// Half of it smooth, which packs well, half noise, which does not.
std::vector<std::byte> make_pixels(const OIIO::ImageSpec& spec) {
  std::mt19937 random(5);
  std::vector<std::byte> pixels(spec.image_bytes(true));
  for (size_t i = 0; i < pixels.size(); i++) {
    pixels[i] = static_cast<std::byte>(i < pixels.size() / 2 ? i / 64 : random() & 0x3f);
  }
  return pixels;
}

std::vector<std::byte> write_exr(const Form& form, const std::string& path) {
  const OIIO::ImageSpec spec = spec_of(form);
  const std::vector<std::byte> pixels = make_pixels(spec);
  const auto out = OIIO::ImageOutput::create("openexr");
  EXPECT_TRUE(out->open(path, spec) && out->write_image(OIIO::TypeDesc(), pixels.data()) && out->close());
  return pixels;
}

std::vector<std::byte> rows_of(const ExrRows& exr, int begin, int end, size_t channels, size_t row_size) {
  std::vector<std::byte> pixels(static_cast<size_t>(end - begin) * row_size);
  exr.read(begin, end, channels, pixels.data());
  return pixels;
}

TEST(ExrRows, AreWhatWasWritten) {
  const TemporaryFolder folder;
  std::vector<Form> forms(8);
  forms[1].packing = "zips";
  forms[2].width = 1, forms[2].height = 1;
  forms[3].width = 5, forms[3].height = 16;
  forms[4].channels = {"R", "G", "B", "A", "Z", "id"};
  forms[4].types.insert(forms[4].types.end(), {OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::UINT32});
  forms[5].line_order = "decreasingY";
  forms[6].left = -3, forms[6].top = 9;
  forms[7].width = 700, forms[7].types.assign(3, OIIO::TypeDesc::FLOAT);
  for (size_t i = 0; i < forms.size(); i++) {
    const std::string path = folder.path(std::to_string(i) + ".exr");
    const std::vector<std::byte> written = write_exr(forms[i], path);
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
  const std::vector<std::byte> written = write_exr({}, folder.path("a.exr"));
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
    Form form;
    form.packing = packing;
    write_exr(form, folder.path("a.exr"));
    EXPECT_FALSE(ExrRows::open(folder.path("a.exr"), kLight)) << packing;
  }
  Form tiled;
  tiled.tile = 16;
  write_exr(tiled, folder.path("a.exr"));
  EXPECT_FALSE(ExrRows::open(folder.path("a.exr"), kLight));
  write_exr({}, folder.path("a.exr"));
  EXPECT_FALSE(ExrRows::open(folder.path("a.exr"), {"R", "Y"}));
  EXPECT_FALSE(ExrRows::open(folder.path("none.exr"), kLight));
  folder.write("a.exr", "no EXR");
  EXPECT_FALSE(ExrRows::open(folder.path("a.exr"), kLight));
}

// Whether a file is refused; what is read of one that is damaged may be anything.
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
  write_exr({}, folder.path("a.exr"));
  const std::string whole = folder.read("a.exr");
  for (size_t size = 0; size < whole.size(); size += 97) EXPECT_TRUE(is_refused(folder, whole.substr(0, size))) << size;
  std::mt19937 random(3);
  int refused = 0;
  for (int i = 0; i < 400; i++) {
    std::string file = whole;
    // Of the data window nothing: OpenImageIO has judged it when rows are read.
    const size_t start = i % 2 == 0 ? file.size() / 4 : file.find("lineOrder");
    for (int k = 0; k <= i % 4; k++) file[start + random() % (file.size() - start)] = static_cast<char>(random());
    refused += is_refused(folder, file) ? 1 : 0;
  }
  EXPECT_GT(refused, 100);  // ZIP has a sum over what it packs
}

}  // namespace
}  // namespace ods

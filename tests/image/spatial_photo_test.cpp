// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/spatial_photo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/base/bytes.h"
#include "ods/image/exif.h"
#include "ods/image/heif_items.h"
#include "tests/support/made_videos.h"
#include "tests/support/temporary_folder.h"

namespace ods::spatial_photo_test {

using made::box, made::number;

std::string full(const std::string& type, const std::string& body, uint64_t flags = 0) {
  return box(type, number(flags, 4) + body);
}

// A HEIC of one picture, whose stream is `pixels`. own: further properties, after hvcC and ispe.
std::string heic(const std::string& pixels, const std::string& own = "", int own_count = 0,
                 const std::string& type = "hvc1") {
  const std::string start = box("ftyp", "heic" + number(0, 4) + "mif1heic");
  std::string numbers = "\x81\x02";
  for (int i = 0; i < own_count; i++) numbers += static_cast<char>(3 + i);
  const auto meta = [&](uint64_t at) {
    return full("meta",
                full("hdlr", number(0, 4) + "pict" + std::string(13, '\0')) + full("pitm", number(7, 2)) +
                    full("iinf", number(1, 2) + full("infe", number(7, 2) + number(0, 2) + type + '\0', 0x02000000)) +
                    box("iprp", box("ipco", box("hvcC", "configuration") + full("ispe", "12345678") + own) +
                                    full("ipma", number(1, 4) + number(7, 2) + number(numbers.size(), 1) + numbers)) +
                    full("iloc", number(0x4400, 2) + number(1, 2) + number(7, 2) + number(0, 2) + number(1, 2) +
                                     number(at, 4) + number(pixels.size(), 4)));
  };
  return start + meta(start.size() + meta(0).size() + 8) + box("mdat", pixels);
}

// The camera of 90 degrees has half its width as focal length: 2^29 in units of 2^-30, as the middle.
const std::string kAdjustment =
    box("uuid", std::string("\xde\x22\x50\x85\x36\xcb\x43\x65\x87\x43\x2f\x87\x05\xe7\xc7\x8a") + number(0, 4));
const std::string kCamera =
    box("uuid", std::string("\x22\xcc\x04\xc7\xd6\xd9\x4e\x07\x9d\x90\x4e\xb6\xec\xba\xf3\xa3") + number(0x1e00, 4) +
                    number(1 << 29, 4) + number(1 << 29, 4) + number(1 << 29, 4));
std::string place(const std::string& contents) {
  return box("uuid", std::string("\x43\x63\xe9\x14\x5b\x7d\x4a\xab\x97\xae\xbe\xa6\x98\x03\xb4\x34") + contents);
}

// All bytes, written out by hand. Group and properties have the form of those in a file that Image I/O wrote.
TEST(SpatialPhoto, IsTheseBytes) {
  const std::string made = make_spatial_photo(heic("left eye"), heic("the right eye"), {90.0, 0.0235});
  const std::string start = box("ftyp", "heic" + number(0, 4) + "mif1miafheic");
  const auto item = [](uint64_t id) { return full("infe", number(id, 2) + number(0, 2) + "hvc1" + '\0', 0x02000000); };
  const auto meta = [&](uint64_t at) {
    const std::string places = number(0x4400, 2) + number(2, 2) + number(1, 2) + number(0, 2) + number(1, 2) +
                               number(at, 4) + number(8, 4) + number(2, 2) + number(0, 2) + number(1, 2) +
                               number(at + 8, 4) + number(13, 4);
    const std::string properties = box("hvcC", "configuration") + full("ispe", "12345678") + place(number(0x10, 4)) +
                                   kCamera + kAdjustment + place(number(0x11, 4) + number(23500, 4));
    const std::string associations = number(3, 4) + number(1, 2) + "\x05\x81\x02\x03\x04\x05" + number(2, 2) +
                                     "\x05\x81\x02\x06\x04\x05" + number(4, 2) + "\x01\x05";
    return full("meta", full("hdlr", number(0, 4) + "pict" + std::string(13, '\0')) + full("pitm", number(1, 2)) +
                            full("iloc", places) + full("iinf", number(2, 2) + item(1) + item(2)) +
                            box("iprp", box("ipco", properties) + full("ipma", associations)) +
                            box("grpl", full("ster", number(4, 4) + number(2, 4) + number(1, 4) + number(2, 4))));
  };
  EXPECT_EQ(made, start + meta(start.size() + meta(0).size() + 8) + box("mdat", "left eyethe right eye"));
}

TEST(SpatialPhoto, OurReaderFindsWhatWasWritten) {
  const TemporaryFolder folder;
  for (const double fov : {4.0, 28.0, 29.0, 63.4, 90.0, 150.0}) {
    folder.write("a.heic", make_spatial_photo(heic("a"), heic("b"), {fov, 0.0234567}));
    const HeifItems items = read_heif_items(FileInput(folder.path("a.heic")));
    EXPECT_EQ(items.pair, (std::vector<uint32_t>{1, 2}));
    EXPECT_EQ(items.primary, 1u);
    EXPECT_NEAR(items.fov, fov, 1e-4) << fov;
    EXPECT_NEAR(items.baseline, 0.023457, 1e-9) << "whole micrometres";
    EXPECT_EQ(items.others, 0);
    EXPECT_EQ(read_exif(FileInput(folder.path("a.heic"))), "");
  }
}

// ISO's own names of the same properties: what other programs write.
TEST(SpatialPhoto, TheBaselineIsReadByItsStandardName) {
  const TemporaryFolder folder;
  std::string file = make_spatial_photo(heic("a"), heic("b"), {90.0, 0.05});
  const std::string old = place(number(0x11, 4) + number(50000, 4));
  const size_t at = file.find(old);
  ASSERT_NE(at, std::string::npos);
  // A box of the same length, whose flags announce only the first of its fields.
  file.replace(at, old.size(), box("cmex", number(1, 4) + number(60000, 4) + std::string(16, '\0')));
  folder.write("a.heic", file);
  EXPECT_NEAR(read_heif_items(FileInput(folder.path("a.heic"))).baseline, 0.06, 1e-9);
}

// A crop stays the last property, because it applies to what the others describe.
TEST(SpatialPhoto, KeepsTheOrderOfProperties) {
  const std::string crop = box("clap", std::string(32, '\1')), color = box("colr", "nclx0");
  const std::string made = make_spatial_photo(heic("a", crop + color, 2), heic("b", crop + color, 2), {90.0, 0.06});
  // hvcC 1, ispe 2, colr 3, extrinsics 4, intrinsics 5, adjustment 6, clap 7; extrinsics of the right eye 8.
  EXPECT_NE(made.find("\x07\x81\x02\x03\x04\x05\x06\x07"), std::string::npos);
  EXPECT_NE(made.find("\x07\x81\x02\x03\x08\x05\x06\x07"), std::string::npos);
}

TEST(SpatialPhoto, ExifDescribesBothEyes) {
  const TemporaryFolder folder;
  const std::string exif = "II*" + std::string("\0\x08\0\0\0\0\0\0\0\0\0", 11);
  const std::string made = make_spatial_photo(heic("a"), heic("b"), {90.0, 0.06}, exif);
  folder.write("a.heic", made);
  EXPECT_EQ(read_exif(FileInput(folder.path("a.heic"))), exif);
  EXPECT_NE(made.find(box("cdsc", number(3, 2) + number(2, 2) + number(1, 2) + number(2, 2))), std::string::npos);
}

TEST(SpatialPhoto, OtherFilesAreRefused) {
  const std::string good = heic("picture");
  EXPECT_THROW(make_spatial_photo(good, heic("b", "", 0, "av01"), {90.0, 0.06}), MalformedFile);
  for (size_t size = 0; size < good.size() - 1; size++) {
    EXPECT_THROW(make_spatial_photo(good.substr(0, size), good, {90.0, 0.06}), MalformedFile) << size;
  }
}

TEST(SpatialPhoto, DamagedExifIsOneLine) {
  const TemporaryFolder folder;
  const std::string made = make_spatial_photo(heic("a"), heic("b"), {90.0, 0.06}, "II*" + std::string(11, '\0'));
  for (size_t at = 20; at < made.size(); at++) {
    for (const char wrong : {'\0', '\x7f', '\xff'}) {
      std::string bad = made;
      bad[at] = wrong;
      folder.write("bad.heic", bad);
      try {
        read_exif(FileInput(folder.path("bad.heic")));
      } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      }
    }
  }
}

}  // namespace ods::spatial_photo_test

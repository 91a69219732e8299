// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/photo_metadata.h"

#include <gtest/gtest.h>

#include "ods/base/bytes.h"
#include "ods/image/exif.h"
#include "ods/image/format/xmp.h"
#include "ods/image/format/xmp_file.h"
#include "tests/support/stereo_jpegs.h"
#include "tests/support/temporary_folder.h"

namespace ods::photo_metadata_test {

// A phone's Exif: lies on its side, shows 640x320 pixels, has a date, a place and a thumbnail.
std::string phone_exif(bool is_little) {
  std::string exif = is_little ? "II*" + std::string(1, '\0') : "MM" + std::string(1, '\0') + "*";
  const auto add = [&](uint64_t value, size_t count) {
    std::string number;
    append_number(number, value, count);
    if (is_little) std::reverse(number.begin(), number.end());
    exif += number;
  };
  const auto entry = [&](uint64_t tag, uint64_t type, uint64_t count, uint64_t value) {
    add(tag, 2), add(type, 2), add(count, 4);
    type == 3 ? (add(value, 2), add(0, 2)) : add(value, 4);
  };
  constexpr size_t kSecond = 8 + 2 + 3 * 12 + 4, kCamera = kSecond + 2 + 2 * 12 + 4, kDate = kCamera + 2 + 2 * 12 + 4;
  add(8, 4);
  add(3, 2);
  entry(0x0112, 3, 1, 6);
  entry(0x0132, 2, 20, kDate);
  entry(0x8769, 4, 1, kCamera);
  add(kSecond, 4);
  add(2, 2);
  entry(0x0201, 4, 1, kDate + 20);
  entry(0x0202, 4, 1, 9);
  add(0, 4);
  add(2, 2);
  entry(0xA002, 4, 1, 640);
  entry(0xA003, 3, 1, 320);
  add(0, 4);
  EXPECT_EQ(exif.size(), kDate);
  return exif + std::string("2024:05:06 07:08:09\0", 20) + "thumbnail";
}

Picture small_picture() {
  EyeImage eye;
  eye.eye = kMono;
  eye.radiance = Image(64, 32, 3);
  return {{eye}};
}

TEST(PhotoMetadata, ExifBelongsToTheNewPixels) {
  for (const bool is_little : {false, true}) {
    const std::string old = phone_exif(is_little), exif = exif_for(old, {128, 64});
    EXPECT_EQ(exif_orientation(old), 6u);
    EXPECT_EQ(exif_orientation(exif), 1u);
    EXPECT_NE(exif.find("2024:05:06 07:08:09"), std::string::npos);
    EXPECT_EQ(exif.find("thumbnail"), std::string::npos);
    EXPECT_EQ(exif_for(exif, {128, 64}), exif);
    EXPECT_NE(exif_for(exif, {256, 64}), exif);
    EXPECT_NE(exif_for(exif, {128, 32}), exif);
    for (size_t size = 0; size + 40 < old.size(); size++) EXPECT_EQ(exif_for(old.substr(0, size), {1, 1}), "") << size;
  }
  EXPECT_EQ(exif_for("MM\0*\0\0\0\x8", {1, 1}), "");
}

TEST(PhotoMetadata, IsKeptInJpegAndPng) {
  const TemporaryFolder folder;
  SaveOptions options;
  options.exif = phone_exif(true);
  options.attributes = {{"GPano:InitialViewHeadingDegrees", std::string("45")}};
  const StereoCamera camera;
  for (const std::string name : {"a.jpg", "a.png"}) {
    save_picture(small_picture(), camera, options, folder.path(name));
    EXPECT_EQ(read_exif(FileInput(folder.path(name))), exif_for(options.exif, {64, 32})) << name;
    SaveOptions again;
    EXPECT_EQ(keep_photo_metadata(folder.path(name), folder.path("b" + name), again), "");
    EXPECT_EQ(again.exif, exif_for(options.exif, {64, 32}));
    ASSERT_EQ(again.attributes.size(), 1u) << name;
    EXPECT_EQ(again.attributes[0].name, "GPano:InitialViewHeadingDegrees");
    save_picture(small_picture(), camera, again, folder.path("b" + name));
    const std::string xmp = read_xmp(folder.path("b" + name));
    EXPECT_EQ(xmp_property(xmp, "GPano:InitialViewHeadingDegrees"), "45");
    EXPECT_EQ(xmp_property(xmp, "GPano:PoseHeadingDegrees"), "0");
    EXPECT_NE(keep_photo_metadata(folder.path(name), "c.webp", again).find("does not keep the Exif"),
              std::string::npos);
  }
}

// In a HEIC it is an item that describes both eyes.
TEST(PhotoMetadata, IsKeptInASpatialPhoto) {
  if (const std::string why = lacks_encoder(FileFormat::kHeif); !why.empty()) GTEST_SKIP() << "skipped: " << why;
  const TemporaryFolder folder;
  Picture pair = small_picture();
  pair.eyes.push_back(pair.eyes[0]);
  pair.eyes[0].eye = kLeft, pair.eyes[1].eye = kRight;
  StereoCamera window;
  window.projection = find_projection("perspective")->setting;
  SaveOptions options, again;
  options.exif = phone_exif(true);
  save_picture(pair, window, options, folder.path("a.heic"));
  EXPECT_EQ(read_exif(FileInput(folder.path("a.heic"))), exif_for(options.exif, {64, 32}));
  EXPECT_EQ(keep_photo_metadata(folder.path("a.heic"), "b.jpg", again), "");
  EXPECT_EQ(again.exif, exif_for(options.exif, {64, 32}));
  EXPECT_EQ(keep_photo_metadata(folder.path("a.heic"), "b.heic", again), "");
  EXPECT_NE(keep_photo_metadata(folder.path("a.heic"), "b.webp", again).find("Exif"), std::string::npos);
}

TEST(PhotoMetadata, PicturesBesideTheEyesAreNamed) {
  const TemporaryFolder folder;
  save_picture(small_picture(), {}, folder.path("a.jpg"));
  const std::string jpeg = folder.read("a.jpg");
  constexpr uint32_t kUndefined = 0;  // as the type of gain maps
  folder.write("b.jpg", made::mpo(jpeg, jpeg, kUndefined));
  folder.write("c.jpg", made::mpo(jpeg, jpeg));
  SaveOptions options;
  EXPECT_NE(keep_photo_metadata(folder.path("b.jpg"), "d.jpg", options).find("gain map"), std::string::npos);
  EXPECT_EQ(keep_photo_metadata(folder.path("c.jpg"), "d.jpg", options), "");
}

}  // namespace ods::photo_metadata_test

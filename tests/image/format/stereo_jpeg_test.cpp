// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/stereo_jpeg.h"

#include <gtest/gtest.h>

#include "ods/base/bytes.h"
#include "ods/files/atomic_file.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/xmp_file.h"
#include "tests/support/stereo_jpegs.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

class StereoJpegs : public testing::Test {
 protected:
  StereoJpeg read(const std::string& bytes) const {
    folder.write("a.jpg", bytes);
    return read_stereo_jpeg(FileInput(folder.path("a.jpg")));
  }

  // Headers alone: the reader stops at the first scan.
  const std::string jpeg = "\xff\xd8" + jpeg_segment(0xDA, "pixels");
  TemporaryFolder folder;
};

TEST_F(StereoJpegs, AnMpoHasTwoPicturesOfTypeDisparity) {
  for (const bool big : {true, false}) {
    const std::string file = made::mpo(jpeg, jpeg, made::kDisparity, big);
    const StereoJpeg stereo = read(file);
    EXPECT_EQ(stereo.right.offset, file.size() - jpeg.size()) << big;
    EXPECT_EQ(stereo.right.size, jpeg.size());
    EXPECT_EQ(stereo.fault, "");
  }
}

TEST_F(StereoJpegs, OtherSecondPicturesAreNoEye) {
  constexpr uint32_t kPanorama = 0x020001, kLargePreview = 0x010002, kUndefined = 0;
  for (const uint32_t type : {kPanorama, kLargePreview, kUndefined}) {
    EXPECT_EQ(read(made::mpo(jpeg, jpeg, type)).right.size, 0u) << type;
  }
  EXPECT_EQ(read(jpeg).right.size, 0u);
}

TEST_F(StereoJpegs, ATruncatedMpoHasOneEyeAndAFault) {
  const std::string file = made::mpo(jpeg, jpeg);
  const StereoJpeg stereo = read(file.substr(0, file.size() - 1));
  EXPECT_EQ(stereo.right.size, 0u);
  EXPECT_NE(stereo.fault.find("cut short"), std::string::npos) << stereo.fault;
}

TEST_F(StereoJpegs, ADamagedIndexIsAFault) {
  const std::string good = made::mpo(jpeg, jpeg);
  const size_t mpf = good.find("MPF");
  for (size_t at = mpf + 4; at < mpf + 60; at++) {
    for (const char wrong : {'\0', '\x7f', '\xff'}) {
      std::string bad = good;
      bad[at] = wrong;
      read(bad);  // returns or reports, and reads nothing outside
    }
  }
  const std::string short_index = jpeg_segment(0xE2, std::string("MPF\0MM", 6));
  EXPECT_NE(read("\xff\xd8" + short_index + jpeg.substr(2)).fault, "");
}

TEST_F(StereoJpegs, AJpsNamesItsLayout) {
  struct Case {
    int flags, layout;
    const char* name;
  };
  for (const auto& [flags, layout, name] : {Case{0, 2, "cross-eyed"},
                                            {4, 2, "side-by-side"},
                                            {6, 2, "side-by-side-half"},
                                            {0, 3, "bottom-top"},
                                            {4, 3, "top-bottom"},
                                            {5, 3, "top-bottom-half"},
                                            {4, 1, "row-interleaved"},
                                            {4, 4, "anaglyph"},
                                            {4, 9, ""}}) {
    EXPECT_EQ(read(made::jps(jpeg, flags, layout)).layout, name);
  }
  EXPECT_EQ(read(made::jps(jpeg, 0, 2, 0)).layout, "mono");
  EXPECT_EQ(read("\xff\xd8" + jpeg_segment(0xE3, "_JPSJPS_") + jpeg.substr(2)).layout, "");
}

TEST_F(StereoJpegs, AMadeMpoHasBothPictures) {
  const std::string left = jpeg.substr(0, 2) + jpeg_segment(0xE0, "JFIF") + jpeg.substr(2);
  const std::string file = make_mpo(left, jpeg);
  const StereoJpeg stereo = read(file);
  EXPECT_EQ(stereo.fault, "");
  EXPECT_EQ(stereo.right.offset + stereo.right.size, file.size());
  const std::string right = file.substr(stereo.right.offset);
  EXPECT_EQ(right.substr(0, 4), "\xff\xd8\xff\xe2");
  EXPECT_TRUE(right.ends_with(jpeg.substr(2)));
  EXPECT_EQ(file.substr(2, 4), left.substr(2, 4)) << "JFIF comes first";
}

TEST_F(StereoJpegs, AMadeJpsHasItsLayout) {
  for (const char* layout : {"side-by-side", "side-by-side-half", "cross-eyed", "top-bottom", "top-bottom-half",
                             "bottom-top", "row-interleaved"}) {
    EXPECT_EQ(read(make_jps(jpeg, layout).value()).layout, layout);
  }
  EXPECT_FALSE(make_jps(jpeg, "checkerboard"));
}

// XMP before or behind the list moves pictures: the list follows.
TEST_F(StereoJpegs, TheListFollowsWhenXmpIsWritten) {
  for (const bool big : {true, false}) {
    folder.write("a.mpo", made::mpo(jpeg, jpeg, made::kDisparity, big));
    for (const std::string packet : {"<x:xmpmeta>long enough</x:xmpmeta>", "<x:xmpmeta/>", ""}) {
      AtomicFile to(folder.path("b.mpo"));
      write_xmp(FileInput(folder.path("a.mpo")), to, packet);
      to.commit();
      const StereoJpeg stereo = read_stereo_jpeg(FileInput(folder.path("b.mpo")));
      EXPECT_EQ(folder.read("b.mpo").substr(stereo.right.offset), jpeg) << big << packet;
      EXPECT_EQ(stereo.right.size, jpeg.size());
      const std::string file = folder.read("b.mpo");
      const size_t entry = file.find("MPF") + 4 + 8 + 2 + 12 + 4;
      EXPECT_EQ(get_number(file, entry + 4, 4, big ? std::endian::big : std::endian::little), stereo.right.offset)
          << "the size of the first picture";
      folder.write("a.mpo", file);
    }
  }
}

}  // namespace
}  // namespace ods

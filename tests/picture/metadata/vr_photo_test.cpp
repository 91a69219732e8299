// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Cardboard photos: both eyes come back, other programs find them, and packets that lie are refused in one line.
#include "ods/picture/metadata/vr_photo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ods/base/base64.h"
#include "ods/base/error.h"
#include "ods/files/md5.h"
#include "ods/files/read_file.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/xmp.h"
#include "ods/image/format/xmp_file.h"
#include "ods/lint/lint.h"
#include "ods/picture/load_eyes.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/save.h"
#include "tests/support/decoded_video.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

TEST(Md5, IsThatOfItsSpecification) {
  EXPECT_EQ(md5(""), "D41D8CD98F00B204E9800998ECF8427E");
  EXPECT_EQ(md5("abc"), "900150983CD24FB0D6963F7D28E17F72");
  EXPECT_EQ(md5("12345678901234567890123456789012345678901234567890123456789012345678901234567890"),
            "57EDF4A22BE3C955AC49DA2E2107B67A");
  EXPECT_EQ(md5(std::string(56, 'a')), "3B0C8AC703F828B04C6C197006D17218");
}

TEST(Base64, IsThatOfItsSpecification) {
  const char* const kPairs[][2] = {{"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : kPairs) {
    EXPECT_EQ(encode_base64(bytes), text);
    EXPECT_EQ(decode_base64(text), bytes);
  }
  std::string all;
  for (int i = 0; i < 256; i++) all += static_cast<char>(i);
  EXPECT_EQ(decode_base64(encode_base64(all)), all);
  EXPECT_EQ(decode_base64("Zm9v!Zm9v"), "foo");
}

// Red at the left, blue at the right, with a pattern so that a JPEG of it is not small.
Picture two_eyes(Extent size) {
  Picture picture;
  for (int eye : {kLeft, kRight}) {
    EyeImage& image = picture.eyes.emplace_back();
    image.eye = eye;
    image.radiance = Image(size.width, size.height, 3);
    unsigned state = 1;
    for (int y = 0; y < size.height; y++) {
      for (int x = 0; x < size.width; x++) {
        state = state * 1664525u + 1013904223u;
        const float noise = static_cast<float>(state >> 24) / 1024.0f;
        const float color[3] = {eye == kLeft ? 0.6f : 0.05f, noise, eye == kRight ? 0.6f : 0.05f};
        std::copy(color, color + 3, image.radiance.at(x, y));
      }
    }
  }
  return picture;
}

class Photo : public testing::Test {
 protected:
  TemporaryFolder folder;
  std::string path = folder.path("a.vr.jpg");

  void make(Extent size = {64, 32}, const char* projection = "lat-long") const {
    StereoCamera camera;
    camera.projection = find_projection(projection)->setting;
    camera.yaw = 30.0f;
    save_picture(two_eyes(size), camera, {}, path);
  }

  // Why it cannot be read; empty: it can.
  std::string error() const {
    try {
      load_eyes(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return error.what();
    }
    return "";
  }
};

vec3 mean(const Image& image) {
  vec3 sum(0.0f);
  for (size_t i = 0; i < image.pixels.size(); i++) sum[static_cast<int>(i % 3)] += image.pixels[i];
  return sum * 3.0f / static_cast<float>(image.pixels.size());
}

TEST_F(Photo, BothEyesComeBack) {
  make();
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.vr.jpg"});
  EXPECT_TRUE(is_photo(path));
  const StoredPicture picture = open_picture(path);
  EXPECT_EQ(picture.size.width, 64);
  EXPECT_EQ(picture.size.height, 32);
  EXPECT_EQ(picture.layout_reason, "it is a Cardboard photo with an embedded right eye");
  EXPECT_TRUE(picture.guesses.empty());
  EXPECT_FLOAT_EQ(picture.camera.yaw, 30.0f);
  const LoadedEyes loaded = load_eyes(path);
  ASSERT_EQ(loaded.eyes.size(), 2u);
  EXPECT_NEAR(mean(loaded.eyes[0]).x, 0.6f, 0.05f);
  EXPECT_NEAR(mean(loaded.eyes[0]).z, 0.05f, 0.05f);
  EXPECT_NEAR(mean(loaded.eyes[1]).x, 0.05f, 0.05f);
  EXPECT_NEAR(mean(loaded.eyes[1]).z, 0.6f, 0.05f);
}

TEST_F(Photo, TheLeftEyeIsTheJpegItself) {
  make();
  StereoCamera camera;
  save_picture(two_eyes({64, 32}), camera, {}, folder.path("%V.jpg"));
  EXPECT_EQ(read_image(path).pixels, read_image(folder.path("left.jpg")).pixels);
  folder.write("right_of_a.jpg", read_right_eye(path));
  EXPECT_EQ(read_image(folder.path("right_of_a.jpg")).pixels, read_image(folder.path("right.jpg")).pixels);
  EXPECT_EQ(load_eyes(path, Layout::kSeparate).eyes.size(), 1u) << "asked for as one eye";
}

TEST_F(Photo, PartsOfTheSphereAreReported) {
  make({32, 32}, "vr180");
  const StoredPicture picture = open_picture(path);
  EXPECT_EQ(projection_name(picture.camera.projection), "vr180");
  EXPECT_NE(read_xmp(path).find("GPano:CroppedAreaLeftPixels=\"16\""), std::string::npos);
}

// GPano in the first rdf:Description, or some readers show one eye twice.
TEST_F(Photo, PacketsAreAsReadersLookForThem) {
  make({512, 256});
  const std::string packet = read_xmp(path), first = packet.substr(packet.find("<rdf:Description"));
  EXPECT_LT(first.find("GPano:ProjectionType=\"equirectangular\""), first.find("/>"));
  EXPECT_LT(first.find("GImage:Mime=\"image/jpeg\""), first.find("/>"));
  size_t pieces = 0;
  for (const JpegSegment& segment : read_jpeg_headers(FileInput(path))) {
    if (segment.data.starts_with(kJpegExtendedXmp)) pieces++;
  }
  EXPECT_GT(pieces, 1u) << "the test is to have an eye that one segment cannot hold";
}

TEST_F(Photo, OneEyeIsAnOrdinaryJpegWithGpano) {
  Picture one = two_eyes({64, 32});
  one.eyes.pop_back();
  save_picture(one, StereoCamera(), {}, path);
  EXPECT_FALSE(is_photo(path));
  EXPECT_TRUE(gpano_camera(read_xmp(path)));
}

TEST_F(Photo, WhatItHasNoWordForIsRefused) {
  StereoCamera fisheye;
  fisheye.projection = find_projection("fisheye")->setting;
  EXPECT_THROW(save_picture(two_eyes({32, 32}), fisheye, {}, path), Error);
  EXPECT_THROW(save_picture(two_eyes({32, 32}), {}, path), Error);
  EXPECT_THROW(check_output(path, {}, {kLeft, kRight}, {32, 32}, &fisheye.projection), Error);
  EXPECT_NO_THROW(check_output(path, {}, {kLeft, kRight}, {32, 32}));
  EXPECT_TRUE(folder.names().empty());
}

TEST_F(Photo, LintSeesBothEyesAndNothingWrongWithItsGpano) {
  make({256, 128});
  const LintReport report = lint(path, {});
  EXPECT_EQ(report.eye_count, 2);
  EXPECT_EQ(report.eye.width, 256);
  for (const Finding& finding : report.findings) EXPECT_NE(finding.fault, Fault::kMetadata) << finding.evidence;
}

// --- packets that lie ------------------------------------------------------------------------------------------------

struct Lie {
  const char* what;
  size_t at;  // in a segment's data
  std::string bytes;
  const char* error;
};

TEST_F(Photo, PacketsThatLieAreRefused) {
  const size_t id = 35, length = id + 32, offset = length + 4, data = offset + 4;
  const Lie lies[] = {{"another MD5", id, std::string(32, 'A'), "it is not there"},
                      {"a length of 2^32 - 1", length, "\xff\xff\xff\xff", "its length differs"},
                      {"no length", length, std::string(4, '\0'), "its length differs"},
                      {"an offset beyond the end", offset, "\xff\xff\xff\xf0", "missing or duplicated"},
                      {"an offset before another", offset, std::string("\0\0\0\1", 4), "missing or duplicated"},
                      {"other bytes", data + 200, "AAAAAAAAAAAA", "MD5"}};
  make({256, 128});
  const std::string whole = folder.read("a.vr.jpg");
  const size_t first = whole.find(kJpegExtendedXmp), second = whole.find(kJpegExtendedXmp, first + 1);
  ASSERT_NE(second, std::string::npos);
  for (const Lie& lie : lies) {
    for (const size_t segment : {first, second}) {
      std::string bytes = whole;
      bytes.replace(segment + lie.at, lie.bytes.size(), lie.bytes);
      folder.write("a.vr.jpg", bytes);
      EXPECT_TRUE(is_photo(path));
      EXPECT_NE(error().find("the right eye in"), std::string::npos) << lie.what << ": " << error();
    }
    std::string bytes = whole;
    for (const size_t segment : {first, second}) bytes.replace(segment + lie.at, lie.bytes.size(), lie.bytes);
    folder.write("a.vr.jpg", bytes);
    EXPECT_NE(error().find(lie.error), std::string::npos) << lie.what << ": " << error();
  }
  folder.write("a.vr.jpg", whole.substr(0, first - 4) + whole.substr(second - 4));
  EXPECT_NE(error().find("missing or duplicated"), std::string::npos) << error();
  folder.write("a.vr.jpg", whole.substr(0, second - 4) + whole.substr(first - 4));
  EXPECT_NE(error().find("missing or duplicated"), std::string::npos) << error();
}

// A photo with this in place of the right eye's letters, and an MD5 that is right.
std::string with_right_eye(const std::string& photo, const std::string& data) {
  const size_t first = photo.find(kJpegExtendedXmp) - 4, end = photo.find("\xff\xdb", first);
  const std::string body = make_xmp_body({{"GImage:Data", data}}), id = md5(body);
  std::string bytes = photo.substr(0, first);
  const size_t note = bytes.find("HasExtendedXMP=\"") + 16;
  bytes.replace(note, 32, id);
  std::string length;
  for (int shift = 24; shift >= 0; shift -= 8) length += static_cast<char>(body.size() >> shift & 0xff);
  const std::string segment = std::string(kJpegExtendedXmp) + id + length + std::string(4, '\0') + body;
  return bytes + jpeg_segment(kJpegApp1, segment) + photo.substr(end);
}

TEST_F(Photo, RightEyesThatAreNoPicturesAreRefused) {
  make();
  const std::string photo = folder.read("a.vr.jpg"), right = read_right_eye(path);
  folder.write("a.vr.jpg", with_right_eye(photo, encode_base64(right)));
  EXPECT_EQ(error(), "") << "the way this test makes photos is wrong";
  for (const std::string& data : {std::string(), std::string("no letters!"), encode_base64("text"),
                                  encode_base64(right.substr(0, right.size() / 2)), encode_base64("\xff\xd8\xff")}) {
    folder.write("a.vr.jpg", with_right_eye(photo, data));
    EXPECT_NE(error(), "") << data.substr(0, 20);
    EXPECT_EQ(error().find("/proc"), std::string::npos) << error();
  }
  TemporaryFolder other;
  save_picture(two_eyes({32, 16}), StereoCamera(), {}, other.path("%V.jpg"));
  folder.write("a.vr.jpg", with_right_eye(photo, encode_base64(other.read("right.jpg"))));
  EXPECT_NE(error().find("64x32 and 32x16"), std::string::npos) << error();
}

TEST_F(Photo, CutShortItIsOneLine) {
  make();
  const std::string whole = folder.read("a.vr.jpg");
  for (size_t size = 0; size < whole.size(); size += 1 + whole.size() / 300) {
    folder.write("a.vr.jpg", whole.substr(0, size));
    EXPECT_NE(error(), "") << size;
  }
}

// Other photos have a second picture in them, too.
TEST_F(Photo, WithoutGpanoItIsAPictureOfOneEye) {
  make();
  std::string bytes = folder.read("a.vr.jpg");
  bytes.replace(bytes.find("equirectangular"), 3, "cyl");
  folder.write("a.vr.jpg", bytes);
  EXPECT_FALSE(is_photo(path));
  EXPECT_EQ(load_eyes(path).eyes.size(), 1u);
}

TEST_F(Photo, ExiftoolFindsTheRightEye) {
  if (!is_installed("exiftool")) GTEST_SKIP() << "skipped: exiftool is not installed";
  make({256, 128});
  EXPECT_EQ(output_of("exiftool -Warning -Error " + path), "");
  EXPECT_EQ(output_of("exiftool -s3 -XMP-GImage:ImageMimeType -XMP-GPano:ProjectionType " + path),
            "image/jpeg\nequirectangular\n");
  EXPECT_EQ(output_of("exiftool -b -XMP-GImage:ImageData " + path), read_right_eye(path));
}

}  // namespace
}  // namespace ods

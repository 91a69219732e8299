// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// VR photos: both eyes come back, other programs find them, VR180 cameras' own are read, and packets that lie are
// refused in one line.
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
#include "ods/picture/metadata/tag_picture.h"
#include "ods/picture/save.h"
#include "tests/support/camera_photos.h"
#include "tests/support/decoded_video.h"
#include "tests/support/temporary_folder.h"

namespace ods::vr_photo_test {

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

  std::string right_eye() const {
    std::vector<std::string> warnings;
    return read_right_eye(path, warnings);
  }

  // The warnings about a file that can be read.
  std::string guesses() const {
    std::string all;
    for (const std::string& guess : open_picture(path).guesses) all += guess + "\n";
    return all;
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
  EXPECT_EQ(picture.layout_reason, "it is a VR photo with an embedded right eye");
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
  folder.write("right_of_a.jpg", right_eye());
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
  const size_t length = 35 + 32, offset = length + 4;
  const Lie lies[] = {{"a length of 2^32 - 1", length, "\xff\xff\xff\xff", "its length differs"},
                      {"no length", length, std::string(4, '\0'), "its length differs"},
                      {"an offset beyond the end", offset, "\xff\xff\xff\xf0", "missing or duplicated"},
                      {"an offset before another", offset, std::string("\0\0\0\1", 4), "missing or duplicated"}};
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
  const std::string photo = folder.read("a.vr.jpg"), right = right_eye();
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

// --- as others write them --------------------------------------------------------------------------------------------

// A right eye is not lost because another program has changed the packet without its MD5.
TEST_F(Photo, AWrongMd5IsAWarning) {
  make({256, 128});
  const std::string whole = folder.read("a.vr.jpg"), right = right_eye();
  EXPECT_EQ(guesses(), "");
  const size_t note = whole.find("HasExtendedXMP=\"") + 16;
  std::string bytes = whole;
  bytes.replace(note, 32, std::string(32, 'A'));  // of no segment
  folder.write("a.vr.jpg", bytes);
  EXPECT_NE(guesses().find("MD5"), std::string::npos);
  EXPECT_EQ(right_eye(), right);
  for (size_t at = bytes.find(kJpegExtendedXmp); at != std::string::npos; at = bytes.find(kJpegExtendedXmp, at + 1)) {
    bytes.replace(at + kJpegExtendedXmp.size(), 32, std::string(32, 'a'));  // the segments agree, in other letters
  }
  folder.write("a.vr.jpg", bytes);
  EXPECT_NE(guesses().find("MD5"), std::string::npos);
  EXPECT_EQ(right_eye(), right);
}

// VR180 cameras and Google's own writer for them.
struct Camera {
  const char* what;
  std::string gpano;
  float longitude, latitude;  // of the right and upper edge
};

class Vr180 : public Photo, public testing::WithParamInterface<int> {
 protected:
  static const Camera& camera() {
    static const Camera kCameras[] = {
        {"with all of GPano",
         crop("64", "64", "32", "0") + "<GPano:ProjectionType>equirectangular</GPano:ProjectionType>", 90.0f, 90.0f},
        {"without ProjectionType",
         crop("64", "64", "32", "0") + "<GPano:PoseHeadingDegrees>25</GPano:PoseHeadingDegrees>", 90.0f, 90.0f},
        {"less than a half",
         crop("64", "80", "48", "8") + "<GPano:InitialViewHeadingDegrees>180</GPano:InitialViewHeadingDegrees>", 72.0f,
         72.0f},
        {"only a heading", "<GPano:PoseHeadingDegrees>25</GPano:PoseHeadingDegrees>", 90.0f, 90.0f},
        {"no GPano at all", "", 90.0f, 90.0f},
        {"a crop that makes no sense", crop("64", "0", "32", "0"), 90.0f, 90.0f}};
    return kCameras[GetParam()];
  }
  void SetUp() override {
    const TemporaryFolder eyes;
    save_picture(two_eyes({64, 64}), {}, eyes.path("%V.jpg"));
    const std::string left = eyes.read("left.jpg"), right = eyes.read("right.jpg");
    folder.write("a.vr.jpg", photo_of(left, camera().gpano, in_lines(right)));
    right_ = right;
  }

  std::string right_;
};

TEST_P(Vr180, BothEyesAndTheirPartOfTheSphereAreRead) {
  SCOPED_TRACE(camera().what);
  EXPECT_TRUE(is_photo(path));
  EXPECT_EQ(right_eye(), right_);
  const StoredPicture picture = open_picture(path);
  ASSERT_EQ(picture.eyes.size(), 2u);
  EXPECT_EQ(picture.camera.projection.kind, kLatLong);
  EXPECT_NEAR(picture.camera.projection.longitude.x, -camera().longitude, 1e-4f);
  EXPECT_NEAR(picture.camera.projection.longitude.y, camera().longitude, 1e-4f);
  EXPECT_NEAR(picture.camera.projection.latitude.y, camera().latitude, 1e-4f);
  EXPECT_EQ(picture.camera.yaw, camera().gpano.find("PoseHeading") != std::string::npos ? 25.0f : 0.0f);
  const LoadedEyes loaded = load_eyes(path);
  EXPECT_NEAR(mean(loaded.eyes[0]).x, 0.6f, 0.05f);
  EXPECT_NEAR(mean(loaded.eyes[1]).z, 0.6f, 0.05f);
}

// Tagging adds what readers need, and changes nothing else.
TEST_P(Vr180, TaggingKeepsCropAndHeadings) {
  SCOPED_TRACE(camera().what);
  const StereoCamera before = open_picture(path).camera;
  const std::vector<Attribute> old = gpano_properties(read_xmp(path));
  for (const bool turns : {false, true}) {
    std::vector<std::string> notes;
    PictureTag tag = complete_tag({}, path, notes);
    if (turns) tag.camera.yaw = 33.0f;
    tag_picture(path, path, tag);
    EXPECT_TRUE(is_photo(path));
    EXPECT_EQ(right_eye(), right_);
    const std::string xmp = read_xmp(path);
    EXPECT_EQ(xmp_property(xmp, "GPano:ProjectionType"), "equirectangular");
    ASSERT_TRUE(gpano_camera(xmp));
    EXPECT_EQ(gpano_camera(xmp)->projection, before.projection);
    EXPECT_EQ(gpano_camera(xmp)->yaw, turns ? 33.0f : before.yaw);
    for (const Attribute& each : old) {
      const bool changes = (turns && each.name == "GPano:PoseHeadingDegrees") ||
                           camera().gpano.find(">0</GPano:FullPanoH") != std::string::npos;
      if (changes) continue;
      EXPECT_EQ(xmp_property(xmp, each.name), std::get<std::string>(each.value)) << each.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cameras, Vr180, testing::Range(0, 6));

TEST_F(Photo, OfTwoRightEyesTheFirstIsUsed) {
  make({64, 64}, "vr180");
  const std::string right = right_eye();
  save_picture(two_eyes({64, 64}), {}, folder.path("%V.jpg"));
  const std::string data = "<GImage:Data>" + encode_base64(right) + "</GImage:Data>";
  folder.write("a.vr.jpg",
               photo_of(folder.read("left.jpg"), crop("64", "64", "32", "0"),
                        data + "<GImage:Data>" + encode_base64(folder.read("left.jpg")) + "</GImage:Data>"));
  EXPECT_EQ(right_eye(), right);
  EXPECT_NE(guesses().find("more than one right eye"), std::string::npos) << guesses();
}

// Exiftool's own photo, which is how LR2VR and others make theirs.
TEST_F(Photo, OfExiftoolIsRead) {
  if (!is_installed("exiftool")) GTEST_SKIP() << "skipped: exiftool is not installed";
  save_picture(two_eyes({64, 64}), {}, folder.path("%V.jpg"));
  const std::string right = folder.read("right.jpg");
  for (const std::string type : {"", "-XMP-GPano:ProjectionType=equirectangular "}) {
    std::filesystem::remove(path);
    output_of(
        "exiftool -XMP-GPano:FullPanoWidthPixels=128 -XMP-GPano:FullPanoHeightPixels=64 "
        "-XMP-GPano:CroppedAreaLeftPixels=32 -XMP-GPano:CroppedAreaTopPixels=0 "
        "-XMP-GPano:CroppedAreaImageWidthPixels=64 -XMP-GPano:CroppedAreaImageHeightPixels=64 " +
        type + "-XMP-GImage:ImageMimeType=image/jpeg '-XMP-GImage:ImageData<=" + folder.path("right.jpg") + "' " +
        folder.path("left.jpg") + " -o " + path);
    EXPECT_TRUE(is_photo(path));
    EXPECT_EQ(right_eye(), right);
    const StoredPicture picture = open_picture(path);
    EXPECT_EQ(picture.eyes.size(), 2u);
    EXPECT_TRUE(is_vr180(picture.camera.projection));
  }
}

TEST_F(Photo, OfAnotherFocusItIsAPictureOfOneEye) {
  save_picture(two_eyes({64, 64}), {}, folder.path("%V.jpg"));
  const std::string data = "<GImage:Data>" + encode_base64(folder.read("right.jpg")) + "</GImage:Data>";
  folder.write("a.jpg", photo_of(folder.read("left.jpg"), "<GFocus:BlurAtInfinity>0.02</GFocus:BlurAtInfinity>", data));
  EXPECT_FALSE(is_photo(folder.path("a.jpg")));
  folder.write("a.jpg", photo_of(folder.read("left.jpg"), "", data));
  EXPECT_TRUE(is_photo(folder.path("a.jpg")));
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
  EXPECT_EQ(output_of("exiftool -b -XMP-GImage:ImageData " + path), right_eye());
}

}  // namespace ods::vr_photo_test

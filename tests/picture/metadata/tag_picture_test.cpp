// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures that are told what they are: nothing else in the file changes, other programs read it, and no file is too
// odd to be refused in one line.
#include "ods/picture/metadata/tag_picture.h"

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include <algorithm>
#include <cstring>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/image/format/exr_header.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/format/xmp_file.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/save.h"
#include "tests/support/decoded_video.h"
#include "tests/support/exr_files.h"
#include "tests/support/temporary_folder.h"

namespace ods::tag_picture_test {

const int kWidth = 16, kHeight = 8;

Picture gradient(const std::vector<int>& eyes, int height = kHeight) {
  Picture picture;
  for (int eye : eyes) {
    EyeImage& image = picture.eyes.emplace_back();
    image.eye = eye;
    image.radiance = Image(kWidth, height, 3);
    for (size_t i = 0; i < image.radiance.pixels.size(); i++) {
      image.radiance.pixels[i] = static_cast<float>(i % 97) / 97.0f;
    }
  }
  return picture;
}

PictureTag sphere(float yaw = 90.0f) {
  PictureTag tag;
  tag.camera.yaw = yaw;
  return tag;
}

std::string read_bytes(const std::string& path) {
  const std::vector<unsigned char> bytes = read_file(path, kMaxFileBytes);
  return {bytes.begin(), bytes.end()};
}

class Tagged : public testing::TestWithParam<const char*> {
 protected:
  TemporaryFolder folder;
  std::string path = folder.path(std::string("a.") + GetParam());

  void SetUp() override { save_picture(gradient({kMono}), {}, path); }

  StereoCamera camera() const {
    std::vector<std::string> guesses;
    return find_format(read_info(path), path, {}).camera;
  }
};

TEST_P(Tagged, SaysWhatItIsAndKeepsItsPixels) {
  const Image before = read_image(path);
  tag_picture(path, path, sphere());
  EXPECT_EQ(read_image(path).pixels, before.pixels);
  EXPECT_FLOAT_EQ(camera().yaw, 90.0f);
  EXPECT_TRUE(is_full_lat_long(camera().projection));
  PictureTag front = sphere(0.0f);
  front.camera.projection = find_projection("vr180")->setting;
  tag_picture(path, path, front);
  EXPECT_EQ(read_image(path).pixels, before.pixels);
  EXPECT_FLOAT_EQ(camera().yaw, 0.0f);
  EXPECT_EQ(projection_name(camera().projection), "vr180");
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST_P(Tagged, AnotherFileLeavesTheOldOne) {
  const std::string before = read_bytes(path), other = folder.path(std::string("b.") + GetParam());
  tag_picture(path, other, sphere());
  EXPECT_EQ(read_bytes(path), before);
  EXPECT_NE(read_bytes(other), before);
}

TEST_P(Tagged, RemovingLeavesWhatWasThere) {
  const std::string before = read_bytes(path);
  tag_picture(path, path, sphere());
  tag_picture(path, path, std::nullopt);
  EXPECT_FALSE(find_format(read_info(path), path, {}).has_camera);
  if (path.ends_with("jpg") || path.ends_with("png")) {
    EXPECT_EQ(read_bytes(path), before);
  }
}

TEST_P(Tagged, TheHeaderIsReadWithoutAnImageLibrary) {
  const FileInfo own = read_picture_header(path), other = read_info(path);
  EXPECT_EQ(own.width, other.width);
  EXPECT_EQ(own.height, other.height);
  EXPECT_EQ(own.is_float, other.is_float);
}

TEST_P(Tagged, CutShortItIsRefusedOrWhole) {
  tag_picture(path, path, sphere());
  const std::string whole = read_bytes(path), cut = folder.path("cut");
  const size_t step = whole.size() / 150 + 1;
  for (size_t size = 0; size < whole.size(); size += size < 40 ? 1 : step) {
    folder.write("cut", whole.substr(0, size));
    try {
      tag_picture(cut, cut, sphere(10.0f));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_EQ(folder.read("cut"), whole.substr(0, size));
    }
    EXPECT_EQ(folder.names().size(), 2u) << "something half-written stays";
  }
}

TEST_P(Tagged, DamagedBytesNeverCrash) {
  tag_picture(path, path, sphere());
  const std::string whole = read_bytes(path), bad = folder.path("bad");
  const size_t step = whole.size() / 300 + 1;
  for (size_t at = 0; at < whole.size(); at += at < 100 ? 1 : step) {
    std::string bytes = whole;
    for (size_t i = at; i < std::min(at + 4, bytes.size()); i++) bytes[i] = '\xff';
    folder.write("bad", bytes);
    try {
      tag_picture(bad, bad, sphere(10.0f));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, Tagged, testing::Values("jpg", "png", "tif", "exr"));

// --- what stays ------------------------------------------------------------------------------------------------------

const char* const kOthers =
    "<?xpacket begin='' id='W5M0MpCehiHzreSzNTczkc9d'?><x:xmpmeta xmlns:x='adobe:ns:meta/'><rdf:RDF xmlns:rdf='r'>"
    "<!-- <rdf:Description> --><rdf:Description rdf:about='' xmlns:dc='d' dc:format='a > b' "
    "GPano:ProjectionType = 'cylindrical'><dc:title>A &amp; B</dc:title></rdf:Description>"
    "<rdf:Description><GPano:PoseHeadingDegrees>7</GPano:PoseHeadingDegrees><GPano:Nothing/></rdf:Description>"
    "</rdf:RDF></x:xmpmeta>  <?xpacket end='w'?>";

TEST(Xmp, EverythingButGpanoStays) {
  const std::optional<std::string> packet =
      replace_gpano(kOthers, {{"GPano:ProjectionType", std::string("equirectangular")}, {"GPano:PosePitchDegrees", 3}});
  ASSERT_TRUE(packet);
  EXPECT_EQ(*packet,
            "<?xpacket begin='' id='W5M0MpCehiHzreSzNTczkc9d'?><x:xmpmeta xmlns:x='adobe:ns:meta/'><rdf:RDF "
            "xmlns:rdf='r'><!-- <rdf:Description> --><rdf:Description "
            "xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\" GPano:ProjectionType=\"equirectangular\" "
            "GPano:PosePitchDegrees=\"3\" rdf:about='' xmlns:dc='d' dc:format='a > b'><dc:title>A &amp; "
            "B</dc:title></rdf:Description><rdf:Description></rdf:Description></rdf:RDF></x:xmpmeta>  "
            "<?xpacket end='w'?>");
  EXPECT_TRUE(has_properties(*packet));
  EXPECT_TRUE(has_properties(*replace_gpano(kOthers, {})));
  EXPECT_FALSE(has_properties(*replace_gpano(make_xmp({{"GPano:PosePitchDegrees", 3}}), {})));
}

TEST(Xmp, WhatIsNoXmlIsNotTouched) {
  for (const char* packet : {"", "nothing", "<rdf:Description", "<a '>", "<!-- <rdf:Description/>", "<x:xmpmeta/>",
                             "<rdf:Description><GPano:a></rdf:Description>", "<![CDATA[<rdf:Description/>"}) {
    EXPECT_FALSE(replace_gpano(packet, {{"GPano:PosePitchDegrees", 3}})) << packet;
  }
  // Attributes that are none: what is left when GPano's are taken out would be read otherwise.
  for (const char* attributes :
       {"GPano:a\"?> <x y=\"1\"", "b='1'GPano:a='2'c='3'", "GPano:a b='1'", "GPano:a=1", "b"}) {
    const std::string packet = std::string("<rdf:Description ") + attributes + "></rdf:Description>";
    EXPECT_FALSE(replace_gpano(packet, {{"GPano:PosePitchDegrees", 3}})) << packet;
    EXPECT_TRUE(has_properties(packet)) << packet;
  }
}

TEST(TagPicture, OtherWordsInAPacketStayInEveryFormat) {
  const TemporaryFolder folder;
  for (const char* name : {"a.jpg", "a.png", "a.tif"}) {
    save_picture(gradient({kMono}), {}, folder.path(name));
    const FileInput file(folder.path(name));
    AtomicFile to(folder.path(name));
    write_xmp(file, to, kOthers);
    to.commit();
    EXPECT_EQ(read_xmp(folder.path(name)), kOthers);
    tag_picture(folder.path(name), folder.path(name), sphere());
    EXPECT_NE(read_xmp(folder.path(name)).find("<dc:title>A &amp; B</dc:title>"), std::string::npos) << name;
    EXPECT_FLOAT_EQ(gpano_camera(read_xmp(folder.path(name)))->yaw, 90.0f) << name;
    tag_picture(folder.path(name), folder.path(name), std::nullopt);
    EXPECT_NE(read_xmp(folder.path(name)).find("<dc:title>A &amp; B</dc:title>"), std::string::npos) << name;
    EXPECT_FALSE(gpano_camera(read_xmp(folder.path(name)))) << name;
  }
}

TEST(TagPicture, AJpegStaysByteForByteAroundItsPacket) {
  const TemporaryFolder folder;
  save_picture(gradient({kMono}), {}, folder.path("a.jpg"));
  const std::string before = folder.read("a.jpg");
  tag_picture(folder.path("a.jpg"), folder.path("a.jpg"), sphere());
  std::string after = folder.read("a.jpg");
  const size_t at = after.find("http://ns.adobe.com/xap/1.0/") - 4;
  const size_t size = static_cast<unsigned char>(after[at + 2]) * 256u + static_cast<unsigned char>(after[at + 3]) + 2u;
  EXPECT_EQ(after.erase(at, size), before);
}

TEST(TagPicture, ACompressedPacketInAPngIsRefused) {
  const TemporaryFolder folder;
  save_picture(gradient({kMono}), {}, folder.path("a.png"));
  std::string file = folder.read("a.png");
  file.insert(kPngAfterHeader, png_chunk("iTXt", std::string("XML:com.adobe.xmp\0\1\0\0\0zip", 25)));
  folder.write("a.png", file);
  EXPECT_THROW(tag_picture(folder.path("a.png"), folder.path("a.png"), sphere()), Error);
  EXPECT_EQ(folder.read("a.png"), file);
}

TEST(TagPicture, APngWhoseHeaderHasAnotherLengthIsRefused) {
  const TemporaryFolder folder;
  const std::string sides("\0\0\0\x10\0\0\0\x08", 8), rest(20, '\x08');
  folder.write("a.png", "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", sides + rest) + png_chunk("IEND", ""));
  EXPECT_THROW(tag_picture(folder.path("a.png"), folder.path("a.png"), sphere()), Error);
}

TEST(TagPicture, APacketThatAJpegHasNoRoomForIsRefused) {
  const TemporaryFolder folder;
  save_picture(gradient({kMono}), {}, folder.path("a.jpg"));
  const FileInput file(folder.path("a.jpg"));
  AtomicFile to(folder.path("b.jpg"));
  EXPECT_NO_THROW(write_xmp(file, to, std::string(65533 - 29, ' ')));
  AtomicFile again(folder.path("c.jpg"));
  EXPECT_THROW(write_xmp(file, again, std::string(65534 - 29, ' ')), Error);
}

// --- TIFFs of every kind ---------------------------------------------------------------------------------------------

std::string number(uint64_t value, size_t count, bool little) {
  std::string bytes;
  for (size_t i = 0; i < count; i++) {
    bytes += static_cast<char>(value >> (8 * (little ? i : count - 1 - i)) & 0xff);
  }
  return bytes;
}

// Two pages of 2x1 grey pixels; the second lies before the first.
std::string tiff(bool big, bool little) {
  const size_t size = big ? 8 : 4, entries = 8;
  const auto n = [&](uint64_t value, size_t count) { return number(value, count, little); };
  std::string file = little ? "II" : "MM";
  file += n(big ? 43 : 42, 2);
  if (big) file += n(8, 2) + n(0, 2);
  const size_t header = file.size() + size, pixels = header, second = pixels + 4;
  const size_t length = (big ? 8 : 2) + entries * (4 + 2 * size) + size;
  file += n(second + length, size) + "abcd";
  const auto directory = [&](uint64_t strip, uint64_t next) {
    file += n(entries, big ? 8 : 2);
    const uint64_t values[][2] = {{256, 2}, {257, 1}, {258, 8}, {259, 1}, {262, 1}, {273, strip}, {278, 1}, {279, 2}};
    for (const auto& [tag, value] : values)
      file += n(tag, 2) + n(4, 2) + n(1, size) + n(value, 4) + std::string(size - 4, '\0');
    file += n(next, size);
  };
  directory(pixels + 2, 0);
  directory(pixels, second);
  return file;
}

TEST(TagPicture, TiffsOfBothByteOrdersAndSizesKeepTheirPagesWhereTheyAre) {
  const TemporaryFolder folder;
  for (const bool big : {false, true}) {
    for (const bool little : {false, true}) {
      // A 4-byte value in 8 bytes has its place at the front in both orders, as TIFF has it.
      const std::string before = tiff(big, little), path = folder.path("a.tif");
      folder.write("a.tif", before);
      const size_t first = big ? 8 : 4, size = big ? 8 : 4;
      for (const float yaw : {10.0f, 20.0f}) {
        tag_picture(path, path, sphere(yaw));
        const std::string after = folder.read("a.tif");
        EXPECT_EQ(after.substr(0, first), before.substr(0, first));
        EXPECT_EQ(after.substr(first + size, before.size() - first - size), before.substr(first + size));
        EXPECT_FLOAT_EQ(gpano_camera(read_xmp(path))->yaw, yaw);
      }
      const std::unique_ptr<TIFF, void (*)(TIFF*)> input(TIFFOpen(path.c_str(), "r"), TIFFClose);
      ASSERT_TRUE(input);
      unsigned char pixels[2] = {};
      ASSERT_EQ(TIFFReadScanline(input.get(), pixels, 0), 1);
      EXPECT_EQ(pixels[0], 'a');
      ASSERT_EQ(TIFFReadDirectory(input.get()), 1) << "the second page is lost";
      ASSERT_EQ(TIFFReadScanline(input.get(), pixels, 0), 1);
      EXPECT_EQ(pixels[1], 'd');
    }
  }
}

// --- EXRs of every kind ----------------------------------------------------------------------------------------------

TEST(TagPicture, ExrsOfEveryPackingKeepTheirPixels) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.exr");
  for (const char* compression : {"none", "rle", "zip", "zips", "piz", "dwaa"}) {
    for (const int tile : {0, 16}) {
      ExrForm form;
      form.width = 80, form.height = 40, form.packing = compression, form.tile = tile;
      form.prepare = [](Imf::Header& header) { header.insert("shot", Imf::StringAttribute("somebody's")); };
      std::vector<float> pixels(80 * 40 * 3);
      for (size_t i = 0; i < pixels.size(); i++) pixels[i] = static_cast<float>(i % 89);
      write_exr_of(path, form, pixels);
      const Image before = read_image(path);
      tag_picture(path, path, sphere());
      EXPECT_EQ(read_image(path).pixels, before.pixels) << compression << tile;
      const FileInfo info = read_info(path);
      EXPECT_EQ(info.text.at("shot"), "somebody's");
      EXPECT_EQ(info.text.at("ods:projection"), "lat-long");
      EXPECT_EQ(info.text.at("textureformat"), "LatLong Environment") << "envmap of one eye";
      EXPECT_FALSE(info.numbers.contains("ods:ipd")) << "nobody knows it";
    }
  }
}

TEST(TagPicture, AnExrOfTwoViewsKeepsItsViewsAndACameraThatIsKnown) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.exr");
  SaveOptions options;
  options.layout = Layout::kMultiview;
  StereoCamera stereo;
  stereo.ipd = 0.07f;
  save_picture(gradient({kLeft, kRight}), stereo, options, path);
  std::vector<std::string> guesses;
  PictureTag tag = complete_tag({}, path, guesses);
  EXPECT_EQ(tag.layout, Layout::kMultiview);
  tag.camera.yaw = 5.0f;
  tag_picture(path, path, tag);
  const Imf::Header header = exr_header(path);
  EXPECT_EQ(Imf::multiView(header).at(1), "right");
  EXPECT_FLOAT_EQ(exr_value<Imf::FloatAttribute>(header, "ods:ipd"), 0.07f);
  EXPECT_FLOAT_EQ(exr_value<Imf::FloatAttribute>(header, "ods:yaw"), 5.0f);
  EXPECT_EQ(folder.read("a.exr").find("envmap"), std::string::npos);
}

TEST(TagPicture, AnExrThatIsTaggedAgainGetsNoCameraThatNobodyKnows) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a_360.exr");
  save_picture(gradient({kMono}), {}, path);
  std::vector<std::string> guesses;
  tag_picture(path, path, complete_tag({}, path, guesses));
  const std::string once = folder.read("a_360.exr");
  tag_picture(path, path, complete_tag({}, path, guesses));
  EXPECT_TRUE(folder.read("a_360.exr") == once);
}

TEST(TagPicture, AnExrThatWasNeverFinishedIsRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.exr");
  save_picture(gradient({kMono}), {}, path);
  std::string bytes = folder.read("a.exr");
  const size_t offsets = read_exr_header(FileInput(path)).end;
  for (size_t i = 0; i < 8; i++) bytes[offsets + i] = 0;
  folder.write("a.exr", bytes);
  EXPECT_THROW(tag_picture(path, path, sphere()), Error);
  EXPECT_EQ(folder.read("a.exr"), bytes);
}

// --- what is refused -------------------------------------------------------------------------------------------------

// ImageMagick keeps the XMP of a JPEG as hexadecimal text, compressed if it is long.
TEST(Xmp, OfImageMagicksPngIsRead) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.png");
  save_picture(gradient({kMono}), {}, path);
  const std::string packet =
      make_xmp({{"GPano:ProjectionType", std::string("equirectangular")}, {"GPano:PoseHeadingDegrees", 45.0f}});
  std::string digits;
  for (const unsigned char c : packet) digits += fmt::format("{:02x}", c);
  for (size_t at = 72; at < digits.size(); at += 73) digits.insert(at, "\n");
  const std::string plain = read_bytes(path), text = fmt::format("\nxmp\n{:8}\n{}\n", packet.size(), digits);
  const auto with = [&](const char* type, const std::string& data) {
    std::string file = plain;
    folder.write("a.png",
                 file.insert(kPngAfterHeader, png_chunk(type, std::string("Raw profile type xmp\0", 21) + data)));
    return read_xmp(path);
  };
  EXPECT_EQ(with("tEXt", text), packet);
  EXPECT_EQ(with("tEXt", "\nxmp\n  4\nzz"), "") << "no digits";
  EXPECT_EQ(with("tEXt", "xmp"), "");
  EXPECT_EQ(with("zTXt", std::string("\0no zlib", 8)), "");
  // An uncompressed block of zlib: two bytes of header, five of the block, the text, the sum.
  if (text.size() > 65535) return;
  uint32_t a = 1, b = 0;
  for (const unsigned char c : text) a = (a + c) % 65521, b = (b + a) % 65521;
  std::string zip = std::string("\x78\x01\x01", 3);
  for (const size_t size : {text.size(), ~text.size()})
    zip += static_cast<char>(size & 0xff), zip += static_cast<char>(size >> 8 & 0xff);
  zip += text;
  append_number(zip, b << 16 | a, 4);
  EXPECT_EQ(with("zTXt", std::string(1, '\0') + zip), packet);
}

TEST(Xmp, MayHaveAnyPrefix) {
  const TemporaryFolder folder;
  folder.write("a.jpg", "\xff\xd8" +
                            jpeg_segment(kJpegApp1, std::string(kJpegXmp) +
                                                        "<x:xmpmeta><rdf:Description "
                                                        "xmlns:p='http://ns.google.com/photos/1.0/panorama/' "
                                                        "p:ProjectionType='equirectangular' p:PoseHeadingDegrees='45' "
                                                        "xmlns:other='o' other:map:p='1'/></x:xmpmeta>") +
                            jpeg_segment(0xDA, "pixels"));
  const std::optional<StereoCamera> camera = gpano_camera(read_xmp(folder.path("a.jpg")));
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->yaw, 45.0f);
}

TEST(TagPicture, GpanoIsForOneEyeAndWholeOrPartialLatLong) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.jpg");
  save_picture(gradient({kMono}, kWidth), {}, path);
  PictureTag both = sphere(), fisheye = sphere();
  both.layout = Layout::kTopBottom;
  fisheye.camera.projection = find_projection("fisheye")->setting;
  EXPECT_THROW(tag_picture(path, path, both), Error);
  EXPECT_THROW(tag_picture(path, path, fisheye), Error);
}

TEST(TagPicture, AnOrdinaryPhotographBecomesNoSphere) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.jpg"), named = folder.path("a_360.jpg");
  save_picture(gradient({kMono}, 11), {}, path);
  save_picture(gradient({kMono}, 11), {}, named);
  std::vector<std::string> guesses;
  EXPECT_THROW(complete_tag({}, path, guesses), Error);
  EXPECT_TRUE(is_full_lat_long(complete_tag({}, named, guesses).camera.projection));
  FormatHint known;
  known.projection = find_projection("lat-long")->setting;
  EXPECT_TRUE(is_full_lat_long(complete_tag(known, path, guesses).camera.projection));
}

// The source of the layout and the projection does not matter.
TEST(TagPicture, AFileThatCannotHaveTheLayoutIsRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.tif"), named = folder.path("a_360_TB.tif");
  save_picture(gradient({kMono}, kHeight + 1), {}, path);
  save_picture(gradient({kMono}, kHeight + 1), {}, named);
  FormatHint layout, both;
  layout.layout = both.layout = Layout::kTopBottom;
  both.projection = find_projection("lat-long")->setting;
  for (const auto& [file, known] : {std::pair(path, layout), {path, both}, {named, FormatHint()}}) {
    std::vector<std::string> guesses;
    try {
      complete_tag(known, file, guesses);
      ADD_FAILURE() << file;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_NE(std::string(error.what()).find("are not two eyes, top-bottom"), std::string::npos) << error.what();
    }
  }
}

TEST(TagPicture, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  save_picture(gradient({kMono}), {}, folder.path("a.webp"));
  folder.write("a.jpg", "no picture");
  folder.write("b.jpg", "");
  for (const char* name : {"a.webp", "a.jpg", "b.jpg", "none.jpg"}) {
    EXPECT_THROW(tag_picture(folder.path(name), folder.path(name), sphere()), Error) << name;
  }
}

// --- other programs --------------------------------------------------------------------------------------------------

TEST(TagPicture, OtherProgramsReadIt) {
  if (!is_installed("exiftool")) GTEST_SKIP() << "skipped: exiftool is not installed";
  const TemporaryFolder folder;
  for (const char* name : {"a.jpg", "a.png", "a.tif"}) {
    save_picture(gradient({kMono}), {}, folder.path(name));
    tag_picture(folder.path(name), folder.path(name), sphere());
    EXPECT_EQ(output_of("exiftool -n -p '$XMP-GPano:ProjectionType $FullPanoWidthPixels $PoseHeadingDegrees' " +
                        folder.path(name)),
              "equirectangular 16 90\n")
        << name;
    EXPECT_EQ(output_of("exiftool -Warning -Error " + folder.path(name)), "") << name;
  }
}

}  // namespace ods::tag_picture_test

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures of other programs' colour spaces, made here byte by byte: they mean the light of their metadata.
#include "ods/image/color_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/image_file.h"
#include "ods/image/tone.h"
#include "ods/picture/load_eyes.h"
#include "ods/picture/stored_picture.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiff_files.h"

namespace ods {
namespace {

// Published numbers (Lindbloom; Apple's Display P3 and Adobe RGB (1998) are given against D50 as ICC profiles are).
const glm::dmat3 kP3ToRec709 = glm::transpose(
    glm::dmat3(1.2249402, -0.2249402, 0.0, -0.0420570, 1.0420570, 0.0, -0.0196376, -0.0786361, 1.0982736));
const Chromaticities kP3{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kRec709.white};

const int kWidth = 8, kHeight = 4;

// Code value of a sample, 0..255.
int code_at(int x, int y, int c) {
  return (x * 29 + y * 61 + c * 40 + 7) % 256;
}

// --- files -----------------------------------------------------------------------------------------------------------

std::string plain_file(const std::string& extension, bool grey = false) {
  const TemporaryFolder folder;
  AtomicFile file(folder.path("file"));
  FileHeader header;
  header.format = *format_of_path("a." + extension);
  header.width = kWidth;
  header.height = kHeight;
  for (const char* name : {"R", "G", "B"}) {
    if (!grey || header.channels.empty()) header.channels.push_back({grey ? "Y" : name, SampleType::kUint8});
  }
  const int count = static_cast<int>(header.channels.size());
  write_image(file, header, [&](int y, std::span<float> row) {
    for (int i = 0; i < kWidth * count; i++) {
      row[static_cast<size_t>(i)] = static_cast<float>(code_at(i / count, y, i % count)) / 255.0f;
    }
  });
  file.commit();
  return folder.read("file");
}

std::string png_with(const std::string& chunks, bool grey = false) {
  return plain_file("png", grey).insert(kPngAfterHeader, chunks);
}

std::string number(double value, size_t size = 4) {
  std::string bytes;
  append_number(bytes, static_cast<uint64_t>(static_cast<int64_t>(std::llround(value))) & 0xffffffffu, size);
  return bytes;
}

std::string gama(double gamma) {
  return png_chunk("gAMA", number(gamma * 1e5));
}

std::string chrm(const Chromaticities& from) {
  std::string data;
  for (const glm::dvec2& xy : {from.white, from.red, from.green, from.blue}) {
    data += number(xy.x * 1e5) + number(xy.y * 1e5);
  }
  return png_chunk("cHRM", data);
}

// ICC.1:2001-04, a profile of a display: three colorants and one curve, or grey. The curve: a gamma.
std::string icc_profile(const std::string& space, double gamma, const std::array<glm::dvec3, 3>& colorants) {
  const auto padded = [](std::string bytes) { return bytes.resize((bytes.size() + 3) / 4 * 4), bytes; };
  const auto xyz = [](glm::dvec3 v) {
    return std::string("XYZ \0\0\0\0", 8) + number(v.x * 65536) + number(v.y * 65536) + number(v.z * 65536);
  };
  const std::string curve = std::string("curv\0\0\0\0\0\0\0\1", 12) + number(gamma * 256, 2);
  std::vector<std::pair<std::string, std::string>> tags = {
      {"desc", std::string("desc\0\0\0\0", 8) + number(9) + std::string("A screen\0", 9) + std::string(78, '\0')},
      {"wtpt", xyz({0.9642, 1.0, 0.8249})}};
  if (space == "GRAY") tags.push_back({"kTRC", curve});
  const char* const kColors[] = {"r", "g", "b"};
  for (size_t c = 0; c < 3 && space == "RGB "; c++) {
    tags.push_back({std::string(kColors[c]) + "XYZ", xyz(colorants[c])});
    tags.push_back({std::string(kColors[c]) + "TRC", curve});
  }
  std::string table = number(static_cast<double>(tags.size())), data;
  const size_t start = 128 + 4 + 12 * tags.size();
  for (const auto& [tag, value] : tags) {
    table += tag + number(static_cast<double>(start + data.size())) + number(static_cast<double>(value.size()));
    data += padded(value);
  }
  std::string header = number(static_cast<double>(start + data.size())) + "ods " + number(0x02400000) + "mntr" + space +
                       "XYZ " + std::string(12, '\0') + "acsp" + std::string(28, '\0');
  header += number(0.9642 * 65536) + number(65536) + number(0.8249 * 65536);
  header.resize(128);
  return header + table + data;
}

// Adobe RGB (1998): gamma 2.19921875, colorants under D50 (Lindbloom).
std::string adobe_rgb() {
  return icc_profile("RGB ", 2.19921875,
                     {glm::dvec3(0.6097559, 0.3111242, 0.0194811), glm::dvec3(0.2052401, 0.6256560, 0.0608902),
                      glm::dvec3(0.1492240, 0.0632197, 0.7448387)});
}

// Linear Rec. 709 of linear Adobe RGB (1998), which has the same blue and red and a greener green.
const glm::dmat3 kAdobeToRec709 =
    glm::transpose(glm::dmat3(1.3983557, -0.3983557, 0.0, 0.0, 1.0, 0.0, 0.0, -0.0429290, 1.0429290));

// zlib's format (RFC 1950) of one block that is stored as it is.
std::string stored(const std::string& bytes) {
  uint32_t a = 1, b = 0;
  for (char byte : bytes) a = (a + static_cast<unsigned char>(byte)) % 65521, b = (b + a) % 65521;
  const auto little = [](size_t value) { return std::string{static_cast<char>(value), static_cast<char>(value >> 8)}; };
  return std::string("\x78\x01\x01", 3) + little(bytes.size()) + little(~bytes.size()) + bytes + number(b, 2) +
         number(a, 2);
}

std::string iccp(const std::string& profile) {
  return png_chunk("iCCP", std::string("some name\0\0", 11) + stored(profile));
}

std::string write(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
  std::ofstream(folder.path(name), std::ios::binary) << bytes;
  return folder.path(name);
}

// --- what they are to mean -------------------------------------------------------------------------------------------

using Curve = std::function<double(double)>;

Curve power(double exponent) {
  return [exponent](double code) { return std::pow(code, exponent); };
}

double srgb(double code) {
  return static_cast<double>(srgb_decode(static_cast<float>(code)));
}

// By read_image() and by open_picture(), whose 16 bits clip what sRGB does not hold.
void expect_light(const std::string& path, const Curve& curve, const glm::dmat3& to_rec709, bool grey = false) {
  const Image image = read_image(path);
  const LoadedEyes loaded = load_eyes(path, Layout::kSeparate);
  for (int y = 0; y < kHeight; y++) {
    for (int x = 0; x < kWidth; x++) {
      glm::dvec3 light;
      for (int c = 0; c < 3; c++) light[c] = curve(code_at(x, y, grey ? 0 : c) / 255.0);
      light = to_rec709 * light;
      for (int c = 0; c < 3; c++) {
        ASSERT_NEAR(static_cast<double>(image.at(x, y)[c]), light[c], 5e-4) << path << " " << x << " " << y << " " << c;
        const double clipped = std::clamp(light[c], 0.0, 1.0);
        ASSERT_NEAR(static_cast<double>(loaded.eyes[0].at(x, y)[c]), clipped, 5e-4) << path << " " << x << " " << y;
      }
    }
  }
}

TEST(ColorSpace, GammaAndPrimariesOfPngAreHonoured) {
  const TemporaryFolder folder;
  const glm::dmat3 same(1.0);
  expect_light(write(folder, "none.png", png_with("")), srgb, same);
  expect_light(write(folder, "linear.png", png_with(gama(1.0))), power(1.0), same);
  expect_light(write(folder, "mac.png", png_with(gama(1.0 / 1.8))), power(1.8), same);
  expect_light(write(folder, "grey.png", png_with(gama(1.0), true)), power(1.0), same, true);
  expect_light(write(folder, "p3.png", png_with(gama(0.45455) + chrm(kP3))), srgb, kP3ToRec709);
  expect_light(write(folder, "linear_p3.png", png_with(gama(1.0) + chrm(kP3))), power(1.0), kP3ToRec709);
  expect_light(write(folder, "only_chrm.png", png_with(chrm(kP3))), srgb, kP3ToRec709);
}

TEST(ColorSpace, ThePngSpecificationRanksTheChunks) {
  const TemporaryFolder folder;
  const glm::dmat3 same(1.0);
  const std::string linear = gama(1.0), intent = png_chunk("sRGB", std::string(1, '\0'));
  const auto cicp = [](char primaries, char transfer) {
    return png_chunk("cICP", std::string{primaries, transfer, '\0', '\1'});
  };
  expect_light(write(folder, "srgb.png", png_with(linear + intent)), srgb, same);
  expect_light(write(folder, "icc.png", png_with(linear + intent + iccp(adobe_rgb()))), power(2.19921875),
               kAdobeToRec709);
  expect_light(write(folder, "cicp.png", png_with(linear + intent + iccp(adobe_rgb()) + cicp(12, 13))), srgb,
               kP3ToRec709);
  expect_light(write(folder, "cicp_linear.png", png_with(intent + cicp(1, 8))), power(1.0), same);
  // Unusable metadata are skipped for the next.
  expect_light(write(folder, "pq.png", png_with(linear + cicp(9, 16))), power(1.0), same);
  expect_light(write(folder, "bad_icc.png", png_with(linear + iccp("no profile"))), power(1.0), same);
}

// 1/2.2 stands for sRGB in most files: their code values stay what they are, to the bit.
TEST(ColorSpace, WhatMeansSrgbStaysAsItIs) {
  const TemporaryFolder folder;
  const Chromaticities rounded{{0.64, 0.33}, {0.3, 0.6}, {0.15, 0.06}, {0.3127, 0.329}};
  const std::string plain = write(folder, "plain.png", png_with(""));
  for (const std::string& chunks : {gama(0.45455), gama(0.45455) + chrm(rounded), gama(0.44), gama(0.47),
                                    png_chunk("sRGB", std::string(1, '\1')) + gama(0.45455)}) {
    const StoredPicture picture = open_picture(write(folder, "a.png", png_with(chunks)));
    EXPECT_EQ(picture.eyes[0].layers[0].sample, SampleType::kUint8);
    EXPECT_EQ(picture.color_fault, "");
    EXPECT_EQ(read_image(folder.path("a.png")).pixels, read_image(plain).pixels);
  }
  EXPECT_EQ(open_picture(write(folder, "a.png", png_with(gama(0.7)))).eyes[0].layers[0].sample, SampleType::kUint16);
}

TEST(ColorSpace, ProfilesOfJpegTiffAndWebpAreHonoured) {
  const TemporaryFolder folder;
  const std::string profile = adobe_rgb();
  const auto expect_profile = [&](const std::string& name, const Image& untagged) {
    const Image image = read_image(folder.path(name));
    for (size_t i = 0; i < image.pixels.size(); i += 3) {
      glm::dvec3 light;
      for (int c = 0; c < 3; c++) {
        light[c] = std::pow(static_cast<double>(srgb_encode(untagged.pixels[i + static_cast<size_t>(c)])), 2.19921875);
      }
      light = kAdobeToRec709 * light;
      for (int c = 0; c < 3; c++) {
        ASSERT_NEAR(static_cast<double>(image.pixels[i + static_cast<size_t>(c)]), light[c], 5e-4) << name;
      }
    }
    EXPECT_EQ(read_info(folder.path(name)).color, "ICC profile 'A screen'");
  };
  // In two pieces, as long profiles are.
  const std::string jpeg = plain_file("jpg"), marker("ICC_PROFILE\0", 12);
  const std::string pieces = jpeg_segment(0xE2, marker + "\1\2" + profile.substr(0, 300)) +
                             jpeg_segment(0xE2, marker + "\2\2" + profile.substr(300));
  const Image plain_jpeg = read_image(write(folder, "plain.jpg", jpeg));
  write(folder, "a.jpg", std::string(jpeg).insert(2, pieces));
  expect_profile("a.jpg", plain_jpeg);

  const std::string webp = plain_file("webp");
  const Image plain_webp = read_image(write(folder, "plain.webp", webp));
  const auto little = [](size_t value) {
    std::string bytes = number(static_cast<double>(value));
    return std::string(bytes.rbegin(), bytes.rend());
  };
  const std::string extended = "VP8X" + little(10) + std::string("\x20\0\0\0\7\0\0\3\0\0", 10);
  const std::string chunk = "ICCP" + little(profile.size()) + profile + std::string(profile.size() % 2, '\0');
  const std::string chunks = "WEBP" + extended + chunk + webp.substr(12);
  write(folder, "a.webp", "RIFF" + little(chunks.size()) + chunks);
  expect_profile("a.webp", plain_webp);

  const Image plain_tiff = read_image(write(folder, "plain.tif", plain_file("tif")));
  TiffForm form;
  form.width = kWidth, form.height = kHeight;
  form.prepare = [&](TIFF* tiff) {
    TIFFSetField(tiff, TIFFTAG_ICCPROFILE, static_cast<uint32_t>(profile.size()), profile.data());
  };
  std::vector<std::byte> codes;
  for (int i = 0; i < kWidth * kHeight * 3; i++) {
    codes.push_back(static_cast<std::byte>(code_at(i / 3 % kWidth, i / 3 / kWidth, i % 3)));
  }
  write_tiff(folder.path("a.tif"), form, codes);
  expect_profile("a.tif", plain_tiff);
}

TEST(ColorSpace, GreyProfilesAreHonoured) {
  const TemporaryFolder folder;
  const std::string path = write(folder, "a.png", png_with(iccp(icc_profile("GRAY", 1.0, {})), true));
  expect_light(path, power(1.0), glm::dmat3(1.0), true);
}

// Each is sRGB then, and told.
TEST(ColorSpace, WhatCannotBeHonouredIsReported) {
  const TemporaryFolder folder;
  const std::string huge = png_chunk("gAMA", std::string(4, '\0'));
  const Chromaticities line{{0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}, {0.3127, 0.329}};
  const std::vector<std::pair<std::string, std::string>> kFiles = {
      {png_with(iccp(icc_profile("CMYK", 1.0, {}))), "is neither RGB nor grey: taken as sRGB"},
      {png_with(iccp(icc_profile("RGB ", 1.0, {}).substr(0, 150))), "is damaged: taken as sRGB"},
      {png_with(png_chunk("iCCP", "no zero")), "its ICC profile is damaged: taken as sRGB"},
      {png_with(png_chunk("iCCP", std::string("a\0\0garbage", 10))), "its ICC profile is damaged: taken as sRGB"},
      {png_with(png_chunk("cICP", std::string("\x09\x10\0\1", 4))), "does not support: taken as sRGB"},
      {png_with(png_chunk("cICP", std::string("\x01\x0d\0\0", 4))), "is not full-range RGB: taken as sRGB"},
      {png_with(huge), "its gAMA 0 makes no sense: taken as sRGB"},
      {png_with(png_chunk("gAMA", "12")), "its gAMA 0 makes no sense: taken as sRGB"},
      {png_with(chrm(line)), "its cHRM has primaries that span no triangle: taken as sRGB"},
      {std::string(plain_file("jpg")).insert(2, jpeg_segment(0xE2, std::string("ICC_PROFILE\0\1\2", 14))), "damaged"},
  };
  for (const auto& [file, expected] : kFiles) {
    const std::string path = write(folder, "a.bin", file);
    std::string fault;
    read_image(path, &fault);
    EXPECT_NE(fault.find(expected), std::string::npos) << fault << " | " << expected;
    const StoredPicture picture = open_picture(path);
    EXPECT_EQ(picture.color_fault, fault);
    EXPECT_EQ(picture.guesses.back(), fault);
    EXPECT_EQ(picture.eyes[0].layers[0].sample, SampleType::kUint8);
  }
}

TEST(ColorSpace, ExrPrimariesAreHonouredInColoursAndNothingElse) {
  const TemporaryFolder folder;
  const char* const kNames[] = {"R", "G", "B", "N.X", "N.Y", "N.Z", "Z", "albedo.R", "albedo.G", "albedo.B"};
  AtomicFile file(folder.path("a.exr"));
  FileHeader header;
  header.format = FileFormat::kExr;
  header.width = kWidth, header.height = kHeight;
  for (const char* name : kNames) {
    header.channels.push_back({name, std::string(name).starts_with("albedo") ? SampleType::kHalf : SampleType::kFloat});
  }
  header.attributes.push_back(
      {"chromaticities", std::vector<float>{0.680f, 0.320f, 0.265f, 0.690f, 0.150f, 0.060f, 0.3127f, 0.3290f}});
  write_image(file, header, [](int, std::span<float> row) {
    const float values[] = {0.5f, 0.25f, 2.0f, 0.5f, 0.25f, 2.0f, 3.0f, 0.5f, 0.25f, 2.0f};
    for (size_t i = 0; i < row.size(); i++) row[i] = values[i % 10];
  });
  file.commit();
  const glm::dvec3 own(0.5, 0.25, 2.0), expected = kP3ToRec709 * own;
  const StoredPicture picture = open_picture(folder.path("a.exr"));
  for (const LayerPixels& layer : picture.eyes[0].layers) {
    const bool color = layer.channels[0] == "R" || layer.channels[0] == "albedo.R";
    if (layer.channels.size() < 3) continue;
    for (int c = 0; c < 3; c++) {
      const std::byte* at = layer.first + 3 * layer.pixel_stride + static_cast<size_t>(c) * bytes_of(layer.sample);
      EXPECT_NEAR(static_cast<double>(sample_value(layer.sample, at)), color ? expected[c] : own[c], 1e-3)
          << layer.channels[0];
    }
  }
  const Image image = read_image(folder.path("a.exr"));
  for (int c = 0; c < 3; c++) EXPECT_NEAR(static_cast<double>(image.at(0, 0)[c]), expected[c], 1e-4);
}

// One eye of another colour space, the other of none: both are read as recorded.
TEST(ColorSpace, EyesOfTwoColourSpacesAreAPair) {
  const TemporaryFolder folder;
  write(folder, "left.png", png_with(gama(1.0)));
  write(folder, "right.png", png_with(""));
  const LoadedEyes loaded = load_eyes(folder.path("%V.png"));
  ASSERT_EQ(loaded.eyes.size(), 2u);
  EXPECT_NEAR(loaded.eyes[0].at(4, 2)[1], static_cast<float>(code_at(4, 2, 1)) / 255.0f, 1e-4f);
  EXPECT_NEAR(loaded.eyes[1].at(4, 2)[1], srgb_decode(static_cast<float>(code_at(4, 2, 1)) / 255.0f), 1e-4f);
}

}  // namespace
}  // namespace ods

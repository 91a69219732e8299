// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// HEIC and AVIF that libheif's own encoder writes, pairs of eyes as phones do, and pictures that are stored turned.
#include <gtest/gtest.h>

#include <cmath>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/image/heif_items.h"
#include "ods/image/image_file.h"
#include "ods/image/orientation.h"
#include "ods/picture/stored_picture.h"
#include "ods/video/container/video_file.h"
#include "tests/support/heif_boxes.h"
#include "tests/support/programs.h"
#include "tests/support/temporary_folder.h"

namespace ods::phone_pictures_test {

using made::box, made::number;

class Heif : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = missing("heif-enc", "heif-enc --help >/dev/null 2>&1"); !why.empty())
      GTEST_SKIP() << why;
  }

  // Red grows to the right, green downwards, and blue is one of the eyes'.
  void write_png(const std::string& name, Extent size, float blue = 0.2f, int bits = 8) const {
    FileHeader header;
    header.width = size.width, header.height = size.height;
    const SampleType sample = bits > 8 ? SampleType::kUint16 : SampleType::kUint8;
    header.channels = {{"R", sample}, {"G", sample}, {"B", sample}};
    AtomicFile file(folder.path(name));
    write_image(file, header, [&](int y, std::span<float> row) {
      for (int x = 0; x < size.width; x++) {
        float* pixel = &row[3 * static_cast<size_t>(x)];
        pixel[0] = static_cast<float>(x) / static_cast<float>(size.width);
        pixel[1] = static_cast<float>(y) / static_cast<float>(size.height), pixel[2] = blue;
      }
    });
    file.commit();
  }
  Ran encode(const std::string& options, const std::string& from, const std::string& to) const {
    return run_line("heif-enc " + options + " " + folder.path(from) + " -o " + folder.path(to));
  }
  std::string error(const std::string& name) const {
    try {
      read_image(folder.path(name));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder;
};

// The largest difference between two pictures as displays show them, in the mean over all pixels.
double difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  double sum = 0.0;
  for (size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); i++) {
    sum += std::abs(std::pow(std::max(0.0, double{a.pixels[i]}), 0.45) -
                    std::pow(std::max(0.0, double{b.pixels[i]}), 0.45));
  }
  return sum / static_cast<double>(a.pixels.size());
}

TEST_F(Heif, HeicAndAvifAreReadAsWhatTheyWereMadeOf) {
  write_png("a.png", {128, 96});
  for (const std::string options : {"-q 95", "-A -q 95"}) {
    const std::string name = options.starts_with("-A") ? "a.avif" : "a.heic";
    const Ran ran = encode(options, "a.png", name);
    if (ran.code != 0) GTEST_SKIP() << "skipped: this heif-enc cannot: " << ran.out;
    const FileInfo info = read_info(folder.path(name));
    EXPECT_EQ(info.width, 128);
    EXPECT_EQ(info.height, 96);
    EXPECT_EQ(info.channels.size(), 3u);
    EXPECT_FALSE(info.is_pair);
    EXPECT_LT(difference(read_image(folder.path(name)), read_image(folder.path("a.png"))), 0.02) << name;
    EXPECT_FALSE(is_video(folder.path(name)));
    EXPECT_EQ(format_of_file(FileInput(folder.path(name))), FileFormat::kHeif);
    const std::unique_ptr<RowReader> rows = open_rows(folder.path(name));
    std::vector<std::byte> bytes(3 * 128 * 2);
    rows->read(10, 12, 3, bytes.data());
    EXPECT_NEAR(static_cast<double>(bytes[3 * 64]), 127.5, 8.0);
  }
}

TEST_F(Heif, TenBitsStayTenBits) {
  write_png("a.png", {128, 96}, 0.2f, 16);
  if (encode("-b 10 -q 95", "a.png", "ten.heic").code != 0) GTEST_SKIP() << "skipped: no encoder of 10 bits";
  EXPECT_EQ(read_info(folder.path("ten.heic")).samples[0], SampleType::kUint16);
  EXPECT_LT(difference(read_image(folder.path("ten.heic")), read_image(folder.path("a.png"))), 0.02);
}

// Two pictures in one file: heif-enc takes several.
TEST_F(Heif, APhonesPairHasBothEyes) {
  write_png("left.png", {128, 96}, 0.1f), write_png("right.png", {128, 96}, 0.8f);
  const Ran ran = run_line("heif-enc -q 95 " + folder.path("left.png") + " " + folder.path("right.png") + " -o " +
                           folder.path("a.heic"));
  if (ran.code != 0) GTEST_SKIP() << "skipped: this heif-enc cannot: " << ran.out;
  const std::string whole = folder.read("a.heic");
  const HeifItems plain = read_heif_items(FileInput(folder.path("a.heic")));
  EXPECT_TRUE(plain.pair.empty());
  const std::string other = number(plain.primary == 1 ? 2 : 1, 4), primary = number(plain.primary, 4);
  const std::string group = box("grpl", box("ster", number(0, 4) + number(99, 4) + number(2, 4) + primary + other));
  // 0.809 of the width: 63.4 degrees.
  const std::string camera = box("cmin", number(0x1000, 4) + number(static_cast<uint64_t>(0.8096 * 65536), 4) +
                                             number(32768, 4) + number(32768, 4));
  folder.write("pair.heic", with_meta(whole, group, camera));
  const FileInfo info = read_info(folder.path("pair.heic"));
  EXPECT_TRUE(info.is_pair);
  const StoredPicture picture = open_picture(folder.path("pair.heic"));
  ASSERT_EQ(picture.eyes.size(), 2u);
  EXPECT_EQ(picture.camera.projection.kind, kPerspective);
  EXPECT_NEAR(picture.camera.projection.fov, 63.4f, 0.1f);
  EXPECT_NEAR(picture.camera.projection.aspect, 128.0f / 96.0f, 1e-4f);
  // visionOS 1 wrote the same under an id of its own.
  const std::string id = "\x22\xcc\x04\xc7\xd6\xd9\x4e\x07\x9d\x90\x4e\xb6\xec\xba\xf3\xa3";
  folder.write("vision.heic", with_meta(whole, group, box("uuid", id + camera.substr(8))));
  EXPECT_NEAR(open_picture(folder.path("vision.heic")).camera.projection.fov, 63.4f, 0.1f);
  const auto blue = [&](size_t eye) { return static_cast<int>(picture.eyes[eye].layers[0].first[2]); };
  EXPECT_NEAR(blue(0), 0.1 * 255, 12);
  EXPECT_NEAR(blue(1), 0.8 * 255, 12);
  OpenOptions one;
  one.format.layout = Layout::kSeparate;
  EXPECT_EQ(open_picture(folder.path("pair.heic"), one).eyes.size(), 1u) << "asked for as one eye";
  folder.write("turned.heic", with_meta(whole, "", box("irot", number(1, 1))));  // by 90 degrees to the left
  EXPECT_EQ(read_info(folder.path("turned.heic")).width, 96);
  const Image turned = read_image(folder.path("turned.heic"));
  EXPECT_GT(turned.at(48, 4)[0], turned.at(48, 120)[0]) << "what was right is above";
}

TEST_F(Heif, DamagedOnesAreOneLine) {
  write_png("a.png", {64, 64});
  if (encode("-q 90", "a.png", "a.heic").code != 0) GTEST_SKIP() << "skipped: no encoder";
  const std::string whole = folder.read("a.heic");
  for (size_t size = 0; size < whole.size(); size += 1 + whole.size() / 60) {
    folder.write("cut.heic", whole.substr(0, size));
    const std::string fault = error("cut.heic");
    EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
    EXPECT_EQ(fault.find("recording"), std::string::npos) << fault;
  }
  uint32_t state = 1;
  for (int i = 0; i < 200; i++) {
    std::string bytes = whole;
    for (int k = 0; k <= i % 4; k++) {
      state = state * 1664525u + 1013904223u;
      bytes[16 + (state >> 8) % (bytes.size() - 16)] = static_cast<char>(state >> 24);
    }
    folder.write("damaged.heic", bytes);
    error("damaged.heic");
  }
}

// Found by fuzzing: libheif does not report the number of bits of a grid whose tiles are overlays.
TEST_F(Heif, AGridOfOverlaysIsRefused) {
  write_png("a.png", {64, 32});
  if (encode("-q 90", "a.png", "a.heic").code != 0) GTEST_SKIP() << "skipped: no encoder";
  std::string whole = folder.read("a.heic");
  if (whole.find("grid") == std::string::npos) GTEST_SKIP() << "skipped: this heif-enc makes no grid of it";
  folder.write("a.heic", whole.replace(whole.find("hvc1"), 4, "iovl"));
  EXPECT_NE(error("a.heic").find("bit depth"), std::string::npos) << error("a.heic");
}

// Files of some hundred bytes that ask for gigabytes or years: each is refused in one line.
TEST_F(Heif, BombsAreRefused) {
  write_png("a.png", {64, 64});
  if (encode("-q 90", "a.png", "a.heic").code != 0) GTEST_SKIP() << "skipped: no encoder";
  const std::string whole = folder.read("a.heic");
  for (const uint64_t side : {30000u, 60000u, 0x7fffffffu, 0xffffffffu}) {
    std::string bomb = whole;
    for (size_t at = bomb.find("ispe"); at != std::string::npos; at = bomb.find("ispe", at + 1)) {
      bomb.replace(at + 8, 8, number(side, 4) + number(side, 4));
    }
    folder.write("bomb.heic", bomb);
    EXPECT_NE(error("bomb.heic"), "") << side;
    EXPECT_EQ(error("bomb.heic").find('\n'), std::string::npos);
  }
  // Pictures 1, 2, ... each made of four of the next one; and one that is made of itself.
  const auto made_of = [&](uint64_t item, uint64_t part) {
    return box("dimg",
               number(item, 2) + number(4, 2) + number(part, 2) + number(part, 2) + number(part, 2) + number(part, 2));
  };
  std::string nested = number(0, 4);
  for (uint64_t item = 1; item < 30; item++) nested += made_of(item, item + 1);
  std::string wide = number(0, 4);  // three levels of a thousand
  for (uint64_t item = 1; item < 4; item++) {
    std::string parts;
    for (int i = 0; i < 1000; i++) parts += number(item + 1, 2);
    wide += box("dimg", number(item, 2) + number(1000, 2) + parts);
  }
  for (const std::string& references : {nested, number(0, 4) + made_of(1, 1), wide}) {
    folder.write("bomb.heic", with_meta(whole, box("iref", references)));
    EXPECT_NE(error("bomb.heic").find("its pictures are made of"), std::string::npos) << error("bomb.heic");
  }
  folder.write("tiles.heic", with_meta(whole, box("iref", number(0, 4) + made_of(9, 1))));
  EXPECT_EQ(error("tiles.heic"), "") << "which nothing shows";
}

TEST(HeifNames, OtherFilesThatBeginAlikeAreCalledByTheirNames) {
  const TemporaryFolder folder;
  const auto words = [&](const std::string& bytes) {
    folder.write("a.bin", bytes);
    try {
      read_image(folder.path("a.bin"));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(words(std::string("\0\0\0\x18", 4) + "ftypcrx " + std::string(20, '\0')).find("Canon"), std::string::npos);
  EXPECT_NE(words("GIF89a" + std::string(20, '\0')).find("GIF"), std::string::npos);
  EXPECT_NE(words(std::string("\xff\x0a") + std::string(20, '\0')).find("JPEG XL"), std::string::npos);
  EXPECT_EQ(words(std::string("\0\0\0\x18", 4) + "ftypheic" + std::string(12, '\0')).find("recording"),
            std::string::npos);
}

// --- odd sides -------------------------------------------------------------------------------------------------------

// A column or a row was cut off, at either end: the eyes are halves all the same, and as far apart.
TEST(OddSides, EyesAreHalvesWithoutTheMiddle) {
  const TemporaryFolder folder;
  for (const bool stacked : {false, true}) {
    for (const bool at_end : {false, true}) {
      const Extent size = stacked ? Extent{64, 127} : Extent{127, 64};
      FileHeader header;
      header.width = size.width, header.height = size.height;
      header.channels = {{"R", SampleType::kUint8}, {"G", SampleType::kUint8}, {"B", SampleType::kUint8}};
      const std::string path = folder.path(stacked ? "a_TB.png" : "a_LR.png");
      AtomicFile file(path);
      const int cut = at_end ? 0 : 1;
      write_image(file, header, [&](int y, std::span<float> row) {
        for (int x = 0; x < size.width; x++) {
          const int along = (stacked ? y : x) + cut, place = along % 64;  // in the eye
          float* pixel = &row[3 * static_cast<size_t>(x)];
          pixel[0] = static_cast<float>(place) / 255.0f, pixel[2] = along >= 64 ? 1.0f : 0.0f;
        }
      });
      file.commit();
      const StoredPicture picture = open_picture(path);
      ASSERT_EQ(picture.eyes.size(), 2u);
      EXPECT_EQ(picture.size.width, stacked ? 64 : 63);
      EXPECT_EQ(picture.size.height, stacked ? 63 : 64);
      const auto codes = [&](size_t eye, int at) {
        const LayerPixels& layer = picture.eyes[eye].layers[0];
        const std::byte* pixel = layer.first + at * (stacked ? layer.row_stride : layer.pixel_stride);
        return std::pair(static_cast<int>(pixel[0]), static_cast<int>(pixel[2]));
      };
      for (const int at : {0, 31, 62}) {
        EXPECT_EQ(codes(0, at), std::pair(at + cut, 0)) << stacked << at_end << at;
        EXPECT_EQ(codes(1, at), std::pair(at + cut, 255)) << stacked << at_end << at;
      }
    }
  }
}

// --- stored turned ---------------------------------------------------------------------------------------------------

TEST(Orientation, PicturesAreReadAsProgramsShowThem) {
  if (const std::string why = missing("exiftool", "exiftool -ver"); !why.empty()) GTEST_SKIP() << why;
  const TemporaryFolder folder;
  FileHeader header;
  header.format = FileFormat::kJpeg;
  header.width = 48, header.height = 32;
  header.channels = {{"R", SampleType::kUint8}, {"G", SampleType::kUint8}, {"B", SampleType::kUint8}};
  header.quality = 100;
  {
    AtomicFile file(folder.path("a.jpg"));
    write_image(file, header, [](int y, std::span<float> row) {
      for (size_t x = 0; x < 48; x++)
        row[3 * x] = static_cast<float>(x) / 48.0f, row[3 * x + 1] = static_cast<float>(y) / 32.0f;
    });
    file.commit();
  }
  // The final places of red (the right of the stored picture) and green (its bottom): right 0, bottom 1, left 2, top 3.
  const int red[] = {0, 2, 2, 0, 1, 1, 3, 3}, green[] = {1, 1, 3, 3, 0, 2, 2, 0};
  for (int orientation = 1; orientation <= 8; orientation++) {
    const std::string path = folder.path("turned.jpg");
    std::filesystem::remove(path);
    ASSERT_EQ(
        run_line("exiftool -n -Orientation=" + std::to_string(orientation) + " " + folder.path("a.jpg") + " -o " + path)
            .code,
        0);
    EXPECT_EQ(orientation_of(FileInput(path)), orientation);
    const Image image = read_image(path);
    EXPECT_EQ(image.width, orientation >= 5 ? 32 : 48);
    const auto side = [&](int channel) {
      const float ends[] = {image.at(image.width - 2, image.height / 2)[channel],
                            image.at(image.width / 2, image.height - 2)[channel],
                            image.at(1, image.height / 2)[channel], image.at(image.width / 2, 1)[channel]};
      return static_cast<int>(std::max_element(ends, ends + 4) - ends);
    };
    EXPECT_EQ(side(0), red[orientation - 1]) << orientation;
    EXPECT_EQ(side(1), green[orientation - 1]) << orientation;
    EXPECT_EQ(open_picture(path, {}).size.width, image.width);
  }
}

}  // namespace ods::phone_pictures_test

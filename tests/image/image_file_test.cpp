// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/image_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <random>

#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/files/atomic_file.h"
#include "ods/image/tone.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

const char* extension_of(FileFormat format) {
  switch (format) {
    case FileFormat::kPng:
      return "png";
    case FileFormat::kJpeg:
      return "jpg";
    case FileFormat::kTiff:
      return "tif";
    case FileFormat::kWebp:
      return "webp";
    case FileFormat::kHdr:
      return "hdr";
    case FileFormat::kExr:
      return "exr";
    case FileFormat::kHeif:
      break;
  }
  return "";
}

// A file of `channels` (of R, G, B, A) whose code values are value(x, y, c), as bytes.
std::string make_file(FileFormat format, int width, int height, const std::string& channels, SampleType sample,
                      const std::function<float(int x, int y, int c)>& value) {
  const TemporaryFolder folder;
  AtomicFile file(folder.path("file"));
  FileHeader header;
  header.format = format;
  header.width = width;
  header.height = height;
  for (char name : channels) header.channels.push_back({std::string(1, name), sample});
  const int count = static_cast<int>(channels.size());
  write_image(file, header, [&](int y, std::span<float> row) {
    for (int i = 0; i < width * count; i++) row[static_cast<size_t>(i)] = value(i / count, y, i % count);
  });
  file.commit();
  return folder.read("file");
}

std::string small_file(FileFormat format) {
  const bool floats = is_scene_referred(format);
  return make_file(format, 24, 12, "RGB", floats ? SampleType::kFloat : SampleType::kUint8,
                   [](int x, int y, int c) { return static_cast<float>((x * 7 + y * 11 + c * 50) % 256) / 255.0f; });
}

// The error of decode_image() or read_image(); empty if it accepts the file.
std::string refusal(const std::string& file) {
  std::string decoded;
  try {
    const CodeImage image = decode_image(bytes_of(file), "a file");
    EXPECT_EQ(image.pixels.size(), static_cast<size_t>(image.width) * static_cast<size_t>(image.height));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    decoded = error.what();
    EXPECT_EQ(decoded.find('\n'), std::string::npos) << decoded;
    EXPECT_NE(decoded.find("'a file'"), std::string::npos) << decoded;
  }
  return decoded;
}

TEST(ImageBytes, AreThoseOfTheFile) {
  for (const FileFormat format : kFileFormats) {
    FileHeader header;
    header.format = format;
    header.width = 70, header.height = 130;  // several bands and strips
    const SampleType sample = is_scene_referred(format) ? SampleType::kFloat : SampleType::kUint8;
    for (const char* name : {"R", "G", "B"}) header.channels.push_back({name, sample});
    const RowSource rows = [](int y, std::span<float> row) {
      for (size_t i = 0; i < row.size(); i++)
        row[i] = static_cast<float>((i * i + static_cast<size_t>(y)) % 97) / 97.0f;
    };
    const TemporaryFolder folder;
    AtomicFile file(folder.path("file"));
    write_image(file, header, rows);
    file.commit();
    EXPECT_EQ(image_bytes("a name", header, rows), folder.read("file")) << static_cast<int>(format);
    EXPECT_EQ(folder.names().size(), 1u);
  }
}

// A texture that is drawn between two texels mixes a transparent one into the other.
TEST(WriteImage, KeepsTheColorsOfTransparentPixels) {
  const auto value = [](int x, int y, int c) {
    if (c == 3) return x < 16 ? 1.0f : 0.0f;
    return static_cast<float>(c == 0 ? x : y) / 64.0f;
  };
  for (const FileFormat format : {FileFormat::kPng, FileFormat::kTiff, FileFormat::kWebp}) {
    const CodeImage image =
        decode_image(bytes_of(make_file(format, 64, 64, "RGBA", SampleType::kUint8, value)), "a file");
    for (int y = 0; y < 64; y++) {
      for (int x = 0; x < 64; x++) {
        const uint32_t texel = image.pixels[static_cast<size_t>(64 * y + x)];
        ASSERT_NEAR(static_cast<int>(texel & 255), 4 * x, 12) << extension_of(format);
        ASSERT_NEAR(static_cast<int>(texel >> 8 & 255), 4 * y, 12) << extension_of(format);
      }
    }
  }
}

TEST(DecodeImage, GivesTheCodesOfEveryChannelCount) {
  const auto value = [](int x, int y, int c) { return static_cast<float>(40 * x + 10 * y + c + 1) / 255.0f; };
  const auto code = [](int x, int y, int c) { return static_cast<uint32_t>(40 * x + 10 * y + c + 1); };
  for (SampleType sample : {SampleType::kUint8, SampleType::kUint16}) {
    for (const char* channels : {"Y", "YA", "RGB", "RGBA"}) {
      const CodeImage image =
          decode_image(bytes_of(make_file(FileFormat::kPng, 3, 2, channels, sample, value)), "a file");
      ASSERT_EQ(image.width, 3);
      ASSERT_EQ(image.height, 2);
      const int count = static_cast<int>(std::string(channels).size());
      for (int y = 0; y < 2; y++) {
        for (int x = 0; x < 3; x++) {
          const bool grey = count < 3;
          const uint32_t r = code(x, y, 0), g = code(x, y, grey ? 0 : 1), b = code(x, y, grey ? 0 : 2);
          const uint32_t a = count % 2 == 0 ? code(x, y, count - 1) : 255u;
          EXPECT_EQ(image.pixels[static_cast<size_t>(3 * y + x)], r | g << 8 | b << 16 | a << 24) << channels;
        }
      }
    }
  }
}

TEST(ReadImage, IsLinear) {
  const TemporaryFolder folder;
  const auto value = [](int x, int, int c) { return static_cast<float>(x + c) / 255.0f; };
  for (const char* channels : {"Y", "RGB"}) {
    folder.write("a.bin", make_file(FileFormat::kPng, 200, 1, channels, SampleType::kUint8, value));
    const Image image = read_image(folder.path("a.bin"));
    ASSERT_EQ(image.channels, 3);
    for (int x = 0; x < 200; x++) {
      for (int c = 0; c < 3; c++) {
        const int code = channels[0] == 'Y' ? x : x + c;
        ASSERT_NEAR(image.at(x, 0)[c], srgb_decode(static_cast<float>(code) / 255.0f), 1e-6f);
      }
    }
  }
  const auto light = [](int x, int y, int c) {
    return std::exp2(static_cast<float>(x + y - 6)) * static_cast<float>(c);
  };
  for (FileFormat format : {FileFormat::kExr, FileFormat::kHdr}) {
    folder.write("a.bin", make_file(format, 16, 2, "RGB", SampleType::kFloat, light));
    const Image image = read_image(folder.path("a.bin"));
    for (int c = 0; c < 3; c++) EXPECT_NEAR(image.at(15, 1)[c], light(15, 1, c), light(15, 1, 2) / 256.0f);
  }
}

TEST(ReadImage, SaysWhyNot) {
  const TemporaryFolder folder;
  folder.write("empty", "");
  folder.write("text.png", "this is no picture");
  for (const char* name : {"absent", "empty", "text.png", "", "."}) {
    try {
      read_image(folder.path(name));
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_NE(std::string(error.what()).find(folder.path(name)), std::string::npos);
    }
  }
}

TEST(DecodeImage, RefusesTruncatedFiles) {
  for (FileFormat format : kFileFormats) {
    const std::string whole = small_file(format);
    ASSERT_EQ(refusal(whole), "") << extension_of(format);
    for (size_t size = 0; size < whole.size(); size += 1 + whole.size() / 150) {
      const std::string why = refusal(whole.substr(0, size));
      // The end of a file need not carry pixels.
      if (format == FileFormat::kJpeg || size < whole.size() / 2) {
        EXPECT_NE(why, "") << extension_of(format) << " " << size;
      }
    }
  }
}

TEST(DecodeImage, AThumbnailsEndIsNotThatOfItsJpeg) {
  std::string whole = small_file(FileFormat::kJpeg);
  const std::string thumbnail("\xff\xd8\xff\xd9", 4);
  whole.insert(2, std::string("\xff\xe1\x00\x06", 4) + thumbnail);
  EXPECT_EQ(refusal(whole), "");
  EXPECT_NE(refusal(whole.substr(0, whole.size() - 1)).find("cut short"), std::string::npos);
  EXPECT_EQ(refusal(whole + "and more behind it"), "");
}

// OpenEXR would make room for it first.
TEST(DecodeImage, AHeaderOfGigabytesIsRefused) {
  const std::string whole = small_file(FileFormat::kExr);
  const auto with = [&](const std::string& before, int32_t number) {
    const size_t at = whole.find(before);
    EXPECT_NE(at, std::string::npos);
    std::string broken = whole;
    std::memcpy(&broken[at + before.size()], &number, sizeof number);
    return refusal(broken);
  };
  using namespace std::string_literals;
  EXPECT_NE(with("dataWindow\0box2i\0"s, 0x7ffffff0).find("cut short or damaged"), std::string::npos);
  const std::string window = "dataWindow\0box2i\0\x10\0\0\0"s;
  EXPECT_NE(with(window + whole.substr(whole.find(window) + window.size(), 12), 0x7ffffff0), "");
}

std::string big_endian(uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

uint32_t crc32(const std::string& bytes) {
  uint32_t crc = 0xffffffffu;
  for (char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; bit++) crc = (crc & 1u) != 0 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  return ~crc;
}

std::string png_of_size(uint32_t width, uint32_t height) {
  std::string file = small_file(FileFormat::kPng);
  file.replace(16, 8, big_endian(width) + big_endian(height));
  return file.replace(29, 4, big_endian(crc32(file.substr(12, 17))));
}

TEST(DecodeImage, RefusesHugeSizesInSmallFiles) {
  EXPECT_EQ(refusal(png_of_size(24, 12)), "");
  EXPECT_NE(refusal(png_of_size(1000000000, 1000000000)), "");
  EXPECT_NE(refusal(png_of_size(40000, 1)), "");
  EXPECT_NE(refusal(png_of_size(30000, 30000)), "");
  EXPECT_NE(refusal(png_of_size(8192, 4096)), "");
  EXPECT_NE(refusal(png_of_size(0, 4)), "");

  std::string hdr = small_file(FileFormat::kHdr);
  const std::string size = "-Y 12 +X 24";
  ASSERT_NE(hdr.find(size), std::string::npos);
  EXPECT_NE(refusal(hdr.replace(hdr.find(size), size.size(), "-Y 1000000000 +X 1000000000")), "");

  std::string exr = small_file(FileFormat::kExr);
  const std::string window("box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0\x17\0\0\0\x0b\0\0\0", 26);
  for (size_t at = exr.find(window); at != std::string::npos; at = exr.find(window, at + 1)) {
    exr.replace(at + 18, 8, std::string("\xff\xff\xff\x3f\xff\xff\xff\x3f", 8));
  }
  EXPECT_NE(refusal(exr), "");
}

// Libraries quote the names of files and channels: none of them means that memory ran out.
TEST(ReadImage, NoNameIsTakenForLackOfMemory) {
  std::string exr = small_file(FileFormat::kExr);
  const size_t channel = exr.find(std::string("B\0\2\0\0\0", 6));  // its type: 2, float
  ASSERT_NE(channel, std::string::npos);
  exr[channel + 2] = 9;
  const TemporaryFolder folder;
  for (const char* name : {"a.exr", "bad_alloc.exr", "std::bad_alloc"}) {
    folder.write(name, exr);
    try {
      read_info(folder.path(name));
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput) << name;
      EXPECT_NE(std::string(error.what()).find("Pixel type"), std::string::npos) << error.what();
    }
  }
}

// Programs parse our errors: whatever bytes a file has for names, they come as text.
TEST(ReadImage, ErrorsAreUtf8) {
  std::string exr = small_file(FileFormat::kExr);
  const size_t channel = exr.find(std::string("B\0\2\0\0\0", 6));
  ASSERT_NE(channel, std::string::npos);
  exr[channel] = '\xff', exr[channel + 2] = 9;
  const std::string why = refusal(exr);
  EXPECT_NE(why.find("\xef\xbf\xbd"), std::string::npos) << why;
  EXPECT_EQ(valid_utf8(why), why);
}

TEST(ReadImage, RefusesWhatIsNoFile) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo(folder.path("pipe").c_str(), 0600), 0);
  for (const std::string& path : {folder.path("pipe"), folder.path(""), folder.path("absent"), std::string("/dev/zero"),
                                  std::string("/proc/self/mem"), std::string()}) {
    EXPECT_THROW(read_image(path), Error) << path;
  }
}

TEST(DecodeImage, SurvivesRandomDamage) {
  std::mt19937 random(7);
  for (FileFormat format : kFileFormats) {
    const std::string whole = small_file(format);
    for (int i = 0; i < 150; i++) {
      std::string file = whole;
      for (int k = 0; k <= i % 8; k++) {
        // The first bytes stay, or the file is only refused for being of no known format.
        file[12 + random() % (file.size() - 12)] = static_cast<char>(random());
      }
      refusal(file);
    }
  }
}

TEST(FileFormats, AreKnownByNameAndByContent) {
  for (FileFormat format : kFileFormats) {
    EXPECT_EQ(format_of_path(std::string("a.b/c.") + extension_of(format)), format);
    EXPECT_EQ(format_of_bytes(bytes_of(small_file(format))), format);
    EXPECT_NE(known_extensions().find(extension_of(format)), std::string::npos);
  }
  EXPECT_EQ(format_of_path("A.JPEG"), FileFormat::kJpeg);
  EXPECT_EQ(format_of_path("a.TiFf"), FileFormat::kTiff);
  for (const char* path : {"a", "a.", "png", ".png", "a.png/b", "a.gif", ""})
    EXPECT_EQ(format_of_path(path), std::nullopt);
}

}  // namespace
}  // namespace ods

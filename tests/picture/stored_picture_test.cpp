// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Every form of picture, ours and others', opened pixel by pixel; and saved by rows.
#include "ods/picture/stored_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/files/scratch.h"
#include "ods/image/tone.h"
#include "ods/picture/save.h"
#include "tests/support/exr_files.h"
#include "tests/support/picture_rows.h"
#include "tests/support/png_files.h"
#include "tests/support/saved_pictures.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiff_files.h"

namespace ods::stored_picture_test {

void expect_eye(const StoredPicture& picture, const StoredEye& eye, FileFormat format) {
  const int columns = kWidth / picture.size.width, rows = kHeight / picture.size.height;
  const int border = tolerance(format) > 0.01f ? 1 : 0;  // over which lossy codecs mix the eyes
  for (int y = border; y < picture.size.height - border; y++) {
    for (int x = border; x < picture.size.width - border; x++) {
      for (int c = 0; c < 3; c++) {
        float mean = 0.0f;
        for (int i = 0; i < columns * rows; i++) {
          mean +=
              light(eye.eye, x * columns + i % columns, y * rows + i / columns, c) / static_cast<float>(columns * rows);
        }
        ASSERT_NEAR(light_at(picture, eye, x, y, static_cast<size_t>(c)), mean, tolerance(format)) << x << " " << y;
      }
    }
  }
}

TEST(OpenPicture, GivesBackTheEyesOfEveryLayoutAndFormat) {
  for (const SavedForm& form : every_saved_form()) {
    SCOPED_TRACE(form.text());
    const TemporaryFolder folder;
    const std::string path = folder.path(form.name);
    save_picture(picture_rows({kLeft, kRight}, false, true), nullptr, options_for(form.layout), path);
    const StoredPicture picture = open_picture(path, as(form.layout));
    ASSERT_EQ(picture.eyes.size(), 2u);
    EXPECT_EQ(picture.layout, form.layout);
    EXPECT_EQ(picture.is_float, is_scene_referred(form.format));
    EXPECT_EQ(picture.eyes[0].eye, kLeft);
    EXPECT_EQ(picture.eyes[1].eye, kRight);
    for (const StoredEye& eye : picture.eyes) expect_eye(picture, eye, form.format);
  }
}

// The file is not opened again for its pixels: they are read though it has been deleted.
TEST(PictureReader, OpensEachFileOnce) {
  for (const char* name :
       {"a_TB.png", "a_TB.jpg", "a_TB.tif", "a_TB.webp", "a_TB.hdr", "a.exr", "%V.png", "a.vr.jpg"}) {
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    const std::string path = folder.path(name);
    SaveOptions options;
    if (names_eye(path)) options.layout = Layout::kSeparate;
    const StereoCamera camera;
    save_picture(picture_rows({kLeft, kRight}, false, false), &camera, options, path);
    const StoredPicture expected = open_picture(path);
    PictureReader reader(path);
    EXPECT_EQ(reader.header().layout, expected.layout);
    EXPECT_EQ(reader.header().guesses, expected.guesses);
    ASSERT_EQ(reader.header().eyes.size(), 2u);
    for (const StoredEye& eye : reader.header().eyes) EXPECT_EQ(eye.layers[0].first, nullptr);
    for (const std::string& file : folder.names()) ASSERT_TRUE(std::filesystem::remove(folder.path(file)));
    const StoredPicture picture = reader.read("");
    ASSERT_EQ(picture.eyes.size(), 2u);
    for (size_t i = 0; i < 2; i++) {
      for (int y = 0; y < kHeight; y++) {
        EXPECT_EQ(value_at(picture.eyes[i].layers[0], 5, y, 1), value_at(expected.eyes[i].layers[0], 5, y, 1));
      }
    }
  }
}

TEST(OpenPicture, LayersHaveTheirRulesAndKindsOfNumber) {
  for (Layout layout : {Layout::kTopBottom, Layout::kSideBySide, Layout::kRowInterleaved, Layout::kColumnInterleaved,
                        Layout::kMultiview}) {
    SCOPED_TRACE(layout_name(layout));
    const TemporaryFolder folder;
    save_picture(picture_rows({kLeft, kRight}, true, true), nullptr, options_for(layout), folder.path("a.exr"));
    const StoredPicture picture = open_picture(folder.path("a.exr"));
    EXPECT_EQ(picture.layout, layout) << "the file says so";
    EXPECT_EQ(picture.size.width, kWidth);
    EXPECT_EQ(picture.size.height, kHeight);
    ASSERT_EQ(picture.eyes.size(), 2u);
    for (const StoredEye& eye : picture.eyes) {
      ASSERT_EQ(eye.layers.size(), 3u);
      EXPECT_EQ(eye.layers[0].channels, (std::vector<std::string>{"R", "G", "B", "A"}));
      EXPECT_EQ(eye.layers[1].channels, (std::vector<std::string>{"N.X", "N.Y", "N.Z"}));
      EXPECT_EQ(eye.layers[2].channels, (std::vector<std::string>{"Z"}));
      EXPECT_EQ(eye.layers[0].rule, LayerRule::kLight);
      EXPECT_EQ(eye.layers[1].rule, LayerRule::kMean);
      EXPECT_EQ(eye.layers[2].rule, LayerRule::kNearest);
      EXPECT_EQ(eye.layers[2].sample, SampleType::kFloat);
      for (int y = 0; y < kHeight; y++) {
        EXPECT_EQ(value_at(eye.layers[2], 5, y, 0), 100.0f + light(eye.eye, 5, y, 0));
        EXPECT_NEAR(value_at(eye.layers[1], 7, y, 2), light(eye.eye, 7, y, 2) - 0.5f, 0.0005f);
      }
      EXPECT_EQ(value_at(eye.layers[0], 0, 3, 3), 0.5f);
      EXPECT_NEAR(value_at(eye.layers[0], 0, 3, 1), 0.5f * light(eye.eye, 0, 3, 1), 0.0005f) << "multiplied";
    }
    OpenOptions light_only;
    light_only.color_only = true;
    EXPECT_EQ(open_picture(folder.path("a.exr"), light_only).eyes[1].layers.size(), 1u);
    const StoredPicture some = PictureReader(folder.path("a.exr")).read("", [](const std::string& name) {
      return name == "Z" || name == "N.Y";
    });
    for (size_t i = 0; i < some.eyes.size(); i++) {
      const StoredEye &whole = picture.eyes[i], &eye = some.eyes[i];
      ASSERT_EQ(eye.layers.size(), 3u);
      EXPECT_EQ(eye.layers[0].first, nullptr);
      EXPECT_EQ(eye.layers[1].channels, std::vector<std::string>{"N.Y"});
      EXPECT_EQ(value_at(eye.layers[1], 7, 5, 0), value_at(whole.layers[1], 7, 5, 1));
      EXPECT_EQ(value_at(eye.layers[2], 5, 9, 0), value_at(whole.layers[2], 5, 9, 0));
    }
  }
}

TEST(SaveRows, AlphaIsKeptWhereAFileCanAndElseBeforeBlack) {
  const float seen = light(kMono, 0, 5, 1), before_black = 0.5f * seen;
  for (const char* extension : {"png", "tif", "webp", "exr", "jpg", "hdr"}) {
    SCOPED_TRACE(extension);
    const TemporaryFolder folder;
    const std::string path = folder.path(std::string("a.") + extension);
    const FileFormat format = *format_of_path(path);
    save_picture(picture_rows({kMono}, true, false), nullptr, options_for(Layout::kTopBottom), path);
    const StoredPicture picture = open_picture(path);
    const StoredEye& eye = picture.eyes[0];
    const bool keeps = format != FileFormat::kJpeg && format != FileFormat::kHdr;
    ASSERT_EQ(eye.layers[0].channels.size(), keeps ? 4u : 3u);
    EXPECT_NEAR(keeps ? value_at(eye.layers[0], 0, 5, 3) : 0.5f, 0.5f, 0.003f);
    EXPECT_EQ(keeps ? value_at(eye.layers[0], 9, 5, 3) : 1.0f, 1.0f);
    const bool multiplied = !keeps || format == FileFormat::kExr;
    EXPECT_NEAR(light_at(picture, eye, 0, 5, 1), multiplied ? before_black : seen, 1.5f * tolerance(format));
    EXPECT_NEAR(light_at(picture, eye, 9, 5, 1), light(kMono, 9, 5, 1), tolerance(format));
  }
}

// A picture that hands back what is stored, decoded and multiplied by its alpha.
PictureRows same_rows(const StoredPicture& picture) {
  PictureRows rows;
  rows.eye = picture.size;
  for (const StoredEye& eye : picture.eyes) rows.eyes.push_back(eye.eye);
  rows.layers = {{picture.eyes[0].layers[0].channels, LayerRule::kLight, SampleType::kHalf}};
  rows.fill = [&picture](int index, int y, std::span<float> row) {
    const StoredEye& eye = picture.eyes[static_cast<size_t>(index)];
    const size_t channels = eye.layers[0].channels.size();
    for (int x = 0; x < picture.size.width; x++) {
      const float alpha = channels == 4 ? value_at(eye.layers[0], x, y, 3) : 1.0f;
      float* out = &row[static_cast<size_t>(x) * channels];
      for (size_t c = 0; c < 3; c++) out[c] = alpha * light_at(picture, eye, x, y, c);
      if (channels == 4) out[3] = alpha;
    }
  };
  rows.band_done = [&picture] { picture.memory->release(); };
  return rows;
}

// Floats of 0..1 as the numbers of a TIFF.
void write_tiff_of(const std::string& path, const TiffForm& form, const std::vector<float>& values) {
  std::vector<std::byte> pixels;
  const auto put = [&](auto number) {
    const auto* bytes = reinterpret_cast<const std::byte*>(&number);
    pixels.insert(pixels.end(), bytes, bytes + sizeof number);
  };
  const bool is_float = form.format == SAMPLEFORMAT_IEEEFP;
  for (const float value : values) {
    const double code = static_cast<double>(value) * (std::exp2(form.bits) - 1.0) + 0.5;
    if (form.bits == 8) put(static_cast<uint8_t>(code));
    if (form.bits == 16) put(static_cast<uint16_t>(code));
    if (form.bits == 32) is_float ? put(value) : put(static_cast<uint32_t>(code));
    if (form.bits == 64) put(static_cast<double>(value));
  }
  write_tiff(path, form, pixels);
}

void write_png(const std::string& path, int width, int height, const std::string& channels, SampleType sample,
               const std::vector<float>& values) {
  const size_t count = channels.size();
  const Binary bytes = make_png(width, height, channels, sample, [&](int x, int y, int c) {
    return values[static_cast<size_t>(y * width + x) * count + static_cast<size_t>(c)];
  });
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
}

TEST(SaveRows, EveryCodeValueComesBack) {
  for (int channels : {3, 4}) {
    for (const char* extension : {"png", "tif"}) {
      const TemporaryFolder folder;
      const std::string path = folder.path(std::string("a_mono.") + extension);
      std::vector<uint8_t> codes;
      std::vector<float> values;
      for (int y = 0; y < 128; y++) {
        for (int x = 0; x < 256; x++) {
          for (int c = 0; c < 3; c++) codes.push_back(static_cast<uint8_t>(x + c * y));
          if (channels == 4) codes.push_back(static_cast<uint8_t>(255 - 2 * y + (y == 127)));
        }
      }
      for (const uint8_t code : codes) values.push_back(static_cast<float>(code) / 255.0f);
      TiffForm form;
      form.width = 256, form.height = 128, form.samples = static_cast<uint16_t>(channels);
      if (channels == 4) form.extra = {EXTRASAMPLE_UNASSALPHA};
      path.ends_with("tif") ? write_tiff_of(path, form, values)
                            : write_png(path, 256, 128, channels == 4 ? "RGBA" : "RGB", SampleType::kUint8, values);
      const StoredPicture first = open_picture(path);
      const std::string copy = folder.path(std::string("b_mono.") + extension);
      save_picture(same_rows(first), nullptr, options_for(Layout::kTopBottom), copy);
      const StoredPicture second = open_picture(copy);
      ASSERT_EQ(second.eyes[0].layers[0].sample, SampleType::kUint8);
      const size_t count = codes.size();
      for (size_t i = 0; i < count; i++) {
        ASSERT_EQ(static_cast<uint8_t>(first.eyes[0].layers[0].first[i]), codes[i]) << i;
        ASSERT_EQ(static_cast<uint8_t>(second.eyes[0].layers[0].first[i]), codes[i]) << extension << channels << i;
      }
    }
  }
}

TEST(OpenPicture, ReadsWhatOthersWrite) {
  const TemporaryFolder folder;
  std::vector<float> values;
  for (int i = 0; i < 100 * 50 * 4; i++) values.push_back(0.25f + 0.001f * static_cast<float>(i % 500));
  const auto values_of = [&](size_t channels) { return std::vector(values.begin(), values.begin() + 5000 * channels); };
  const auto png = [&](const std::string& name, SampleType sample, const std::string& channels) {
    write_png(folder.path(name), 100, 50, channels, sample, values_of(channels.size()));
  };
  const auto tiff = [&](uint16_t bits, uint16_t format, uint32_t tile) {
    TiffForm form;
    form.width = 100, form.height = 50, form.bits = bits, form.format = format, form.tile = tile;
    write_tiff_of(folder.path("a.tif"), form, values_of(3));
    return open_picture(folder.path("a.tif"));
  };
  const auto exr = [&](const std::vector<std::string>& channels, Imf::PixelType type, int tile) {
    ExrForm form;
    form.width = 100, form.height = 50, form.channels = channels, form.tile = tile;
    form.types.assign(channels.size(), type);
    write_exr_of(folder.path("a.exr"), form, values_of(channels.size()));
    return open_picture(folder.path("a.exr"));
  };
  const auto expect = [&](const StoredPicture& picture, SampleType sample, int channels, float tolerable) {
    const LayerPixels& layer = picture.eyes[0].layers[0];
    EXPECT_EQ(layer.sample, sample);
    for (int y : {0, 15, 16, 49}) {
      const int at = (y * 100 + 99) * channels;
      EXPECT_NEAR(value_at(layer, 99, y, 2), values[static_cast<size_t>(at + (channels < 3 ? 0 : 2))], tolerable) << y;
    }
  };
  png("16.png", SampleType::kUint16, "RGB");
  expect(open_picture(folder.path("16.png")), SampleType::kUint16, 3, 1e-4f);
  png("grey.png", SampleType::kUint8, "Y");
  expect(open_picture(folder.path("grey.png")), SampleType::kUint8, 1, 0.003f);
  expect(tiff(8, SAMPLEFORMAT_UINT, 16), SampleType::kUint8, 3, 0.003f);
  expect(exr({"R", "G", "B"}, Imf::HALF, 16), SampleType::kHalf, 3, 0.001f);
  expect(tiff(64, SAMPLEFORMAT_IEEEFP, 0), SampleType::kFloat, 3, 0.0f);
  expect(tiff(32, SAMPLEFORMAT_UINT, 0), SampleType::kUint16, 3, 1e-4f);
  expect(exr({"Y"}, Imf::FLOAT, 0), SampleType::kFloat, 1, 0.0f);
  const StoredPicture combined =
      exr({"View.Combined.R", "View.Combined.G", "View.Combined.B", "View.Depth.Z"}, Imf::FLOAT, 0);
  EXPECT_EQ(combined.eyes[0].layers[0].channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(combined.eyes[0].layers[1].rule, LayerRule::kNearest);
  png("eye_left.png", SampleType::kUint16, "RGB");
  png("eye_right.png", SampleType::kUint8, "RGB");
  EXPECT_THROW(open_picture(folder.path("eye_%V.png")), Error);  // eyes of two kinds of number
}

TEST(OpenPicture, AlphaComesAsTheFormatOfTheSamplesHasIt) {
  const TemporaryFolder folder;
  std::vector<float> values(8 * 4 * 4, 0.25f);
  for (size_t i = 3; i < values.size(); i += 4) values[i] = 0.5f;
  const auto colour = [&](uint16_t bits, uint16_t kind) {
    TiffForm form;
    form.width = 8, form.height = 4, form.samples = 4, form.bits = bits, form.extra = {kind};
    if (bits == 32) form.format = SAMPLEFORMAT_IEEEFP;
    write_tiff_of(folder.path("a.tif"), form, values);
    return value_at(open_picture(folder.path("a.tif")).eyes[0].layers[0], 3, 3, 1);
  };
  EXPECT_NEAR(colour(8, EXTRASAMPLE_ASSOCALPHA), 0.5f, 0.005f);
  EXPECT_NEAR(colour(8, EXTRASAMPLE_UNASSALPHA), 0.25f, 0.002f);
  EXPECT_NEAR(colour(16, EXTRASAMPLE_ASSOCALPHA), 0.5f, 0.0001f);
  EXPECT_EQ(colour(32, EXTRASAMPLE_ASSOCALPHA), 0.25f);
  EXPECT_EQ(colour(32, EXTRASAMPLE_UNASSALPHA), 0.125f);
}

TEST(OpenPicture, IdsAreExactOrLeftOut) {
  const TemporaryFolder folder;
  const auto write = [&](const char* name, uint32_t id) {
    ExrForm form;
    form.width = 8, form.height = 4;
    form.channels = {"R", "G", "B", "objects"};
    form.types = {Imf::HALF, Imf::HALF, Imf::HALF, Imf::UINT};
    std::string pixels;  // three halves of 1 and a number
    for (int i = 0; i < 32; i++) {
      pixels += std::string("\0\x3c\0\x3c\0\x3c", 6);
      pixels.append(reinterpret_cast<const char*>(&id), sizeof id);
    }
    const auto bytes = std::as_bytes(std::span(pixels));
    write_exr(folder.path(name), form, {bytes.begin(), bytes.end()});
  };
  write("a.exr", 16777215);
  const StoredPicture picture = open_picture(folder.path("a.exr"));
  const LayerPixels& ids = picture.eyes[0].layers[1];
  EXPECT_EQ(ids.channels, std::vector<std::string>{"objects"});
  EXPECT_EQ(ids.rule, LayerRule::kNearest);
  EXPECT_EQ(value_at(ids, 7, 3, 0), 16777215.0f);
  EXPECT_EQ(value_at(picture.eyes[0].layers[0], 7, 3, 2), 1.0f);
  write("b.exr", 16777217);
  const StoredPicture without = open_picture(folder.path("b.exr"));
  EXPECT_EQ(without.eyes[0].layers.size(), 1u);
  const std::string said = ::testing::PrintToString(without.guesses);
  EXPECT_NE(said.find("objects has the integer 16777217"), std::string::npos) << said;
  OpenOptions light_only;
  light_only.color_only = true;
  EXPECT_NO_THROW(open_picture(folder.path("b.exr"), light_only));
}

std::string write_exr(const TemporaryFolder& folder, const std::string& name,
                      const std::vector<std::string>& channels) {
  AtomicFile file(folder.path(name));
  FileHeader header;
  header.format = FileFormat::kExr;
  header.width = 4;
  header.height = 2;
  for (const std::string& channel : channels) header.channels.push_back({channel, SampleType::kFloat});
  write_image(file, header, [&](int y, std::span<float> row) {
    for (size_t i = 0; i < row.size(); i++) row[i] = static_cast<float>(10 * y + static_cast<int>(i % channels.size()));
  });
  file.commit();
  return folder.path(name);
}

TEST(OpenPicture, RulesGoByName) {
  const std::pair<const char*, LayerRule> rules[] = {{"Z", LayerRule::kNearest},
                                                     {"depth.V", LayerRule::kNearest},
                                                     {"View.Depth.Z", LayerRule::kNearest},
                                                     {"id", LayerRule::kNearest},
                                                     {"object.X", LayerRule::kNearest},
                                                     {"material", LayerRule::kNearest},
                                                     {"IndexOB.X", LayerRule::kNearest},
                                                     {"crypto00.R", LayerRule::kNearest},
                                                     {"View.CryptoObject01.r", LayerRule::kNearest},
                                                     {"variance.R", LayerRule::kNearest},
                                                     {"N.Z", LayerRule::kMean},
                                                     {"View.Normal.Z", LayerRule::kMean},
                                                     {"albedo.R", LayerRule::kMean},
                                                     {"diffuse", LayerRule::kMean}};
  for (const auto& [name, rule] : rules) {
    const TemporaryFolder folder;
    const StoredPicture picture = open_picture(write_exr(folder, "a.exr", {"R", "G", "B", name}));
    ASSERT_EQ(picture.eyes[0].layers.size(), 2u) << name;
    EXPECT_EQ(picture.eyes[0].layers[1].rule, rule) << name;
    EXPECT_EQ(picture.eyes[0].layers[1].channels, std::vector<std::string>{name});
  }
}

TEST(OpenPicture, ViewsOfOthersAndTheirLayers) {
  const TemporaryFolder folder;
  for (bool left_is_bare : {true, false}) {
    const std::string other = left_is_bare ? "right" : "left";
    const std::string path = write_exr(folder, other + ".exr",
                                       {"R", "G", "B", other + ".R", other + ".G", other + ".B", "N." + other + ".X"});
    const StoredPicture picture = open_picture(path);
    ASSERT_EQ(picture.eyes.size(), 2u);
    const size_t bare = left_is_bare ? 0 : 1;
    EXPECT_EQ(value_at(picture.eyes[bare].layers[0], 1, 1, 1), 11.0f);
    EXPECT_EQ(value_at(picture.eyes[1 - bare].layers[0], 1, 1, 1), 14.0f);
    EXPECT_EQ(picture.eyes[0].layers.size(), 1u);
    ASSERT_EQ(picture.guesses.size(), 2u);
    EXPECT_EQ(picture.guesses[1], "only one eye has N.X: left out");
  }
}

TEST(OpenPicture, BadFilesAreOneLine) {
  const TemporaryFolder folder;
  save_picture(picture_rows({kLeft, kRight}, false, true), nullptr, options_for(Layout::kTopBottom),
               folder.path("whole.exr"));
  save_picture(picture_rows({kLeft, kRight}, false, false), nullptr, options_for(Layout::kTopBottom),
               folder.path("whole.png"));
  save_picture(picture_rows({kLeft}, false, false), nullptr, options_for(Layout::kTopBottom), folder.path("l.tif"));
  write_exr(folder, "r.tif", {"R", "G", "B"});
  for (const char* name : {"whole.exr", "whole.png"}) {
    const std::string bytes = folder.read(name);
    folder.write(std::string("cut.") + name, bytes.substr(0, bytes.size() / 2));
  }
  write_exr(folder, "nothing.exr", {"Z"});
  folder.write("side.png", folder.read("whole.png"));
  folder.write("side.camera.json", "{");
  struct Case {
    const char* name;
    OpenOptions options;
  };
  OpenOptions cube = as(Layout::kSeparate);
  cube.format.projection = find_projection("cube-3x2")->setting;
  const Case cases[] = {{"absent.png", {}},    {"cut.whole.exr", {}},
                        {"cut.whole.png", {}}, {"nothing.exr", {}},
                        {"%v.tif", {}},        {"whole.png", as(Layout::kMultiview)},
                        {"whole.png", cube},   {"whole.png", as(Layout::kAnaglyph)},
                        {"side.png", {}},      {".", {}}};
  for (const Case& bad : cases) {
    try {
      open_picture(folder.path(bad.name), bad.options);
      FAIL() << bad.name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput) << bad.name;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
}

TEST(OpenPicture, OneRowAndNoNumbersAreNoTrouble) {
  const TemporaryFolder folder;
  for (const char* name : {"a_LR.png", "a_LR.exr", "a_LR.hdr", "a_LR.tif", "a_LR.jpg", "a_LR.webp"}) {
    PictureRows rows;
    rows.eye = {16, 1};
    rows.eyes = {kLeft, kRight};
    rows.layers = {{{"R", "G", "B", "A"}, LayerRule::kLight, SampleType::kFloat}};
    rows.fill = [](int, int, std::span<float> row) {
      std::fill(row.begin(), row.end(), std::numeric_limits<float>::quiet_NaN());
    };
    save_picture(rows, nullptr, options_for(Layout::kSideBySide), folder.path(name));
    const StoredPicture picture = open_picture(folder.path(name));
    EXPECT_EQ(picture.size.height, 1) << name;
    ASSERT_EQ(picture.eyes.size(), 2u) << name;
    EXPECT_EQ(light_at(picture, picture.eyes[1], 15, 0, 2), 0.0f) << name;
  }
  // Others' files may hold NaN; it is handed on, for the rules of the layer to deal with.
  std::vector<float> nothing(24, std::numeric_limits<float>::quiet_NaN());
  ExrForm form;
  form.width = 4, form.height = 2, form.types.assign(3, Imf::FLOAT);
  write_exr_of(folder.path("nan.exr"), form, nothing);
  EXPECT_TRUE(std::isnan(value_at(open_picture(folder.path("nan.exr")).eyes[0].layers[0], 3, 1, 2)));
}

// The peak memory of this process from now on, in bytes; nullopt if the system does not report it.
bool forget_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

size_t peak() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    std::istringstream words(line);
    std::string word;
    size_t kilobytes = 0;
    if (words >> word >> kilobytes && word == "VmHWM:") return kilobytes * 1024;
  }
  return 0;
}

TEST(OpenPicture, ALargePictureIsNeverInMemory) {
#ifdef ODS_SANITIZED
  GTEST_SKIP() << "skipped: sanitizers keep memory of their own";
#endif
  const TemporaryFolder folder;
  const int side = 2560;
  PictureRows rows;
  rows.eye = {side, side / 2};
  rows.eyes = {kLeft, kRight};
  rows.layers = {{{"R", "G", "B"}, LayerRule::kLight, SampleType::kHalf}};
  rows.fill = [](int, int y, std::span<float> row) {
    std::fill(row.begin(), row.end(), static_cast<float>(y) / static_cast<float>(side));
  };
  for (const char* name : {"a.exr", "a.tif"}) {
    save_picture(rows, nullptr, options_for(Layout::kTopBottom), folder.path(name));
    if (!forget_peak()) GTEST_SKIP() << "skipped: /proc/self/clear_refs cannot be written";
    const size_t before = peak();
    OpenOptions options;
    options.scratch_folder = folder.path("");
    options.max_in_memory = 1 << 20;
    const StoredPicture picture = open_picture(folder.path(name), options);
    save_picture(same_rows(picture), nullptr, options_for(Layout::kTopBottom), folder.path(std::string("b_") + name));
    const size_t pixels = size_t{side} * side * 3 * bytes_of(picture.eyes[0].layers[0].sample);
    EXPECT_EQ(picture.memory->size() / pixels, 1u);
    EXPECT_LT(peak() - before, size_t{48} << 20) << name << ": as floats it would take 79 MB";
  }
}

}  // namespace ods::stored_picture_test

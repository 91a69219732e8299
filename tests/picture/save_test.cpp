// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/save.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>

#include "ods/base/error.h"
#include "ods/image/format/file_format.h"
#include "ods/image/image_file.h"
#include "ods/image/tone.h"
#include "ods/picture/stored_picture.h"
#include "tests/support/temporary_folder.h"

namespace ods::save_test {

const int kWidth = 32, kHeight = 16;
const char* const kExtensions[] = {"png", "jpg", "jpeg", "tif", "tiff", "webp", "hdr", "exr"};

// Smooth, so that JPEG and WebP can follow; no value is repeated in another eye.
float light(int eye, int x, int y, int c) {
  const float across = static_cast<float>(x + 1) / kWidth, down = static_cast<float>(y + 1) / kHeight;
  const float side = eye == kLeft ? 0.15f : 0.75f;
  return side + 0.1f * (c == 0 ? across : c == 1 ? down : across * down);
}

EyeImage make_eye(int eye) {
  EyeImage result{
      eye, Image(kWidth, kHeight, 3), Image(kWidth, kHeight, 1), Image(kWidth, kHeight, 3), Image(kWidth, kHeight, 3),
      {}};
  for (int y = 0; y < kHeight; y++) {
    for (int x = 0; x < kWidth; x++) {
      for (int c = 0; c < 3; c++) {
        result.radiance.at(x, y)[c] = light(eye, x, y, c);
        result.normal.at(x, y)[c] = 10.0f + light(eye, x, y, c);
        result.albedo.at(x, y)[c] = 20.0f + light(eye, x, y, c);
      }
      *result.depth.at(x, y) = 1000.0f + light(eye, x, y, 0);
    }
  }
  return result;
}

Picture stereo() {
  return {{make_eye(kLeft), make_eye(kRight)}};
}
Picture single(int eye) {
  return {{make_eye(eye)}};
}

// The light that a file of this format gives back for some light.
vec3 expected(FileFormat format, int eye, int x, int y) {
  const vec3 value(light(eye, x, y, 0), light(eye, x, y, 1), light(eye, x, y, 2));
  return is_scene_referred(format) ? value : tone_map(value, 0.0f, ToneCurve::kNeutral);
}

// In codes of 0..255, which is how far half steps of a rounding and lossy codecs may be off.
float code_error(float a, float b) {
  return 255.0f * std::abs(srgb_encode(a) - srgb_encode(b));
}

float code_tolerance(FileFormat format) {
  switch (format) {
    case FileFormat::kPng:
    case FileFormat::kTiff:
      return 0.502f;
    case FileFormat::kJpeg:
      return 3.0f;
    case FileFormat::kWebp:
      return 10.0f;  // its chroma is always halved
    case FileFormat::kHdr:
      return 0.6f;
    case FileFormat::kExr:
      return 0.05f;
    case FileFormat::kHeif:
      break;  // is read only
  }
  return 0.0f;
}

// One eye's rectangle of a file.
void expect_eye(const Image& image, FileFormat format, int eye, int left, int top) {
  for (int y = 0; y < kHeight; y++) {
    for (int x = 0; x < kWidth; x++) {
      // Lossy codecs mix the eyes along their border.
      const bool border = (top > 0 || image.height > kHeight) && (y < 2 || y >= kHeight - 2);
      const bool side = (left > 0 || image.width > kWidth) && (x < 2 || x >= kWidth - 2);
      if (code_tolerance(format) > 1.0f && (border || side)) continue;
      const vec3 value = expected(format, eye, x, y);
      for (int c = 0; c < 3; c++) {
        ASSERT_LE(code_error(image.at(left + x, top + y)[c], value[c]), code_tolerance(format))
            << "eye " << eye << " x " << x << " y " << y << " channel " << c;
      }
    }
  }
}

TEST(Save, EveryFormatInEveryLayout) {
  for (const char* extension : kExtensions) {
    SCOPED_TRACE(extension);
    const FileFormat format = *format_of_path(std::string("a.") + extension);
    const TemporaryFolder folder;
    const auto save = [&](const Picture& picture, Layout layout, const std::string& name) {
      SaveOptions options;
      options.layout = layout;
      return save_picture(picture, {}, options, folder.path(name + "." + extension));
    };
    const auto read = [&](const std::string& name) { return read_image(folder.path(name + "." + extension)); };

    EXPECT_EQ(save(stereo(), Layout::kTopBottom, "tb").size(), 1u);
    const Image top_bottom = read("tb");
    ASSERT_EQ(top_bottom.width, kWidth);
    ASSERT_EQ(top_bottom.height, 2 * kHeight);
    expect_eye(top_bottom, format, kLeft, 0, 0);
    expect_eye(top_bottom, format, kRight, 0, kHeight);

    save(stereo(), Layout::kSideBySide, "sbs");
    const Image side_by_side = read("sbs");
    ASSERT_EQ(side_by_side.width, 2 * kWidth);
    ASSERT_EQ(side_by_side.height, kHeight);
    expect_eye(side_by_side, format, kLeft, 0, 0);
    expect_eye(side_by_side, format, kRight, kWidth, 0);

    const std::vector<std::string> names = save(stereo(), Layout::kTopBottom, "%V/a.%v");
    EXPECT_EQ(names[0], folder.path(std::string("left/a.l.") + extension));
    EXPECT_EQ(names[1], folder.path(std::string("right/a.r.") + extension));
    expect_eye(read("left/a.l"), format, kLeft, 0, 0);
    expect_eye(read("right/a.r"), format, kRight, 0, 0);

    for (int eye : {kLeft, kRight, kMono}) {
      save(single(eye), Layout::kTopBottom, "one");
      const Image image = read("one");
      ASSERT_EQ(image.height, kHeight);
      expect_eye(image, format, eye, 0, 0);
    }
    EXPECT_EQ(folder.names().size(), 5u);  // nothing temporary is left
  }
}

// The shape of a window whose projection the caller states is that of its pixels.
TEST(Save, AStatedWindowHasSquarePixels) {
  const TemporaryFolder folder;
  save_picture(stereo(), {}, folder.path("a_TB.png"));
  OpenOptions options;
  options.format.projection = find_projection("perspective")->setting;
  const StoredPicture read = open_picture(folder.path("a_TB.png"), options);
  EXPECT_EQ(read.camera.projection.aspect, static_cast<float>(kWidth) / static_cast<float>(kHeight));
  EXPECT_NE(kWidth, kHeight);
}

// The message of the error with which a picture is not saved.
std::string refused(const Picture& picture, const StereoCamera* camera, const std::string& path) {
  try {
    camera ? save_picture(picture, *camera, {}, path) : save_picture(picture, SaveOptions{}, path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Save, ASpatialPhotoIsReadAgain) {
  if (const std::string why = lacks_encoder(FileFormat::kHeif); !why.empty()) GTEST_SKIP() << "skipped: " << why;
  const TemporaryFolder folder;
  const Picture picture = stereo();
  StereoCamera window;
  window.projection = find_projection("perspective")->setting;
  window.projection.fov = 71.5f, window.ipd = 0.0234f;
  const std::string path = folder.path("a.heic");
  SaveOptions options;
  options.tone = ToneCurve::kLinear;
  save_picture(picture, window, options, path);
  const StoredPicture pair = open_picture(path);
  ASSERT_EQ(pair.eyes.size(), 2u);
  EXPECT_EQ(pair.camera.projection.kind, kPerspective);
  EXPECT_NEAR(pair.camera.projection.fov, 71.5f, 1e-4f);
  EXPECT_NEAR(pair.camera.ipd, 0.0234f, 1e-6f);
  EXPECT_TRUE(pair.has_ipd);
  EXPECT_TRUE(pair.guesses.empty());
  // Which eye is which: x265 keeps their mean colour.
  for (const int index : {0, 1}) {
    const Image& made = picture.eyes[static_cast<size_t>(index)].radiance;
    double sum = 0.0, expected = 0.0;
    const std::unique_ptr<RowReader> rows = open_rows(path, index);
    std::vector<std::byte> bytes(made.pixels.size());
    rows->read(0, made.height, 3, bytes.data());
    for (size_t i = 0; i < bytes.size(); i++) {
      sum += static_cast<double>(bytes[i]) / 255.0;
      expected += double{srgb_encode(std::clamp(made.pixels[i], 0.0f, 1.0f))};
    }
    EXPECT_NEAR(sum / static_cast<double>(bytes.size()), expected / static_cast<double>(bytes.size()), 0.01) << index;
  }
  StereoCamera front = window, toed = window, mono = window;
  front.projection = find_projection("vr180")->setting;
  toed.convergence = kToeIn, mono.ipd = 0.0f;
  const std::string other = folder.path("b.heic");
  EXPECT_NE(refused(picture, &front, other).find("`perspective`"), std::string::npos);
  EXPECT_NE(refused(picture, &toed, other).find("`convergence`"), std::string::npos);
  EXPECT_NE(refused(picture, &mono, other).find("eye distance is 0"), std::string::npos);
  EXPECT_NE(refused(picture, nullptr, other).find("camera is unknown"), std::string::npos);
  EXPECT_NE(refused({{picture.eyes[0]}}, &window, other).find("of two eyes"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(other));
}

// The kinds of files for two eyes are read as they were written.
TEST(Save, FilesForTwoEyesAreReadAgain) {
  const TemporaryFolder folder;
  const Picture picture = stereo();
  StereoCamera window;
  window.projection = find_projection("perspective")->setting;
  StereoCamera front;
  front.projection = find_projection("vr180")->setting;
  for (const StereoCamera& camera : {window, front}) {
    save_picture(picture, camera, {}, folder.path("a.mpo"));
    const StoredPicture pair = open_picture(folder.path("a.mpo"), {});
    EXPECT_EQ(pair.eyes.size(), 2u);
    EXPECT_EQ(pair.camera.projection.kind, camera.projection.kind);
  }
  for (const Layout layout : {Layout::kCrossEyed, Layout::kTopBottom, Layout::kRowInterleaved}) {
    SaveOptions options;
    options.layout = layout;
    save_picture(picture, window, options, folder.path("a.jps"));
    EXPECT_EQ(open_picture(folder.path("a.jps"), {}).layout, layout);
  }
  StereoCamera fisheye;
  fisheye.projection = find_projection("fisheye")->setting;
  EXPECT_THROW(save_picture(picture, fisheye, {}, folder.path("b.mpo")), Error);
  SaveOptions checkerboard;
  checkerboard.layout = Layout::kCheckerboard;
  EXPECT_THROW(save_picture(picture, window, checkerboard, folder.path("b.jps")), Error);
}

TEST(Save, SqueezedPixelsAreTheMeanButOfDepthTheNearest) {
  const TemporaryFolder folder;
  SaveOptions options;
  options.layout = Layout::kTopBottomHalf;
  Picture picture = stereo();
  *picture.eyes[1].depth.at(3, 5) = 2.0f;
  save_picture(picture, {}, options, folder.path("a.exr"));
  const Image image = read_channels(folder.path("a.exr"), {"N.Y", "Z"});
  ASSERT_EQ(image.height, kHeight);
  const float mean = 10.0f + 0.5f * (light(kRight, 3, 4, 1) + light(kRight, 3, 5, 1));
  EXPECT_NEAR(image.at(3, kHeight / 2 + 2)[0], mean, 0.005f);
  EXPECT_EQ(image.at(3, kHeight / 2 + 2)[1], 2.0f);
  EXPECT_EQ(image.at(4, kHeight / 2 + 2)[1], 1000.0f + light(kRight, 4, 4, 0));
}

TEST(Save, APictureOfNoKnownCameraSaysNothingOfOne) {
  const TemporaryFolder folder;
  Picture picture = single(kMono);
  picture.eyes[0].depth = picture.eyes[0].normal = picture.eyes[0].albedo = Image();
  for (const char* name : {"a.exr", "a.png", "a.jpg"}) {
    save_picture(picture, {}, folder.path(name));
    EXPECT_EQ(folder.read(name).find("ods:ipd"), std::string::npos) << name;
    EXPECT_EQ(folder.read(name).find("GPano"), std::string::npos) << name;
    EXPECT_EQ(folder.read(name).find("envmap"), std::string::npos) << name;
  }
  EXPECT_EQ(read_info(folder.path("a.exr")).channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(read_info(folder.path("a.exr")).text.at("ods:layout"), "mono");
}

TEST(Save, DisplayFormatsAreExposedAndSceneFormatsAreNot) {
  const TemporaryFolder folder;
  SaveOptions options;
  options.exposure = -2.0f;
  options.tone = ToneCurve::kLinear;
  for (const char* extension : {"png", "tif", "hdr", "exr"}) {
    const std::string path = folder.path(std::string("a.") + extension);
    save_picture(single(kMono), {}, options, path);
    const float shown = read_image(path).at(5, 5)[1];
    const float seen = light(kMono, 5, 5, 1);
    if (is_scene_referred(*format_of_path(path))) {
      EXPECT_NEAR(shown, seen, seen / 128.0f);
    } else {
      EXPECT_NEAR(srgb_encode(shown), srgb_encode(seen / 4.0f), 0.6f / 255.0f);
    }
  }
}

TEST(Save, NoFileHoldsNanOrInfinity) {
  const float inf = std::numeric_limits<float>::infinity();
  const float odd[] = {NAN, inf, -inf, 1e30f, -1e30f, -1.0f, 1e-40f};
  Picture picture = stereo();
  for (EyeImage& eye : picture.eyes) {
    for (Image* image : {&eye.radiance, &eye.depth, &eye.normal, &eye.albedo}) {
      for (size_t i = 0; i < std::size(odd); i++) image->pixels[9 * i] = odd[i];
    }
  }
  for (const char* extension : kExtensions) {
    const TemporaryFolder folder;
    save_picture(picture, {}, {}, folder.path(std::string("a.") + extension));
    for (float value : read_image(folder.path(std::string("a.") + extension)).pixels) {
      ASSERT_TRUE(std::isfinite(value)) << extension;
    }
  }
}

// The same bytes at any time: files do not record when they were made.
TEST(Save, SamePictureSameBytes) {
  const std::time_t now = std::time(nullptr);
  char month[16];
  std::strftime(month, sizeof month, "%Y:%m:", std::gmtime(&now));
  for (const char* extension : kExtensions) {
    const TemporaryFolder folder;
    for (const char* name : {"a.", "b."}) save_picture(stereo(), {}, {}, folder.path(std::string(name) + extension));
    EXPECT_EQ(folder.read(std::string("a.") + extension), folder.read(std::string("b.") + extension)) << extension;
    EXPECT_EQ(folder.read(std::string("a.") + extension).find(month), std::string::npos) << extension;
  }
}

std::string refusal(const std::string& path, const SaveOptions& options, const Picture& picture,
                    ErrorKind kind = ErrorKind::kUsage) {
  std::vector<int> eyes;
  for (const EyeImage& eye : picture.eyes) eyes.push_back(eye.eye);
  std::string checked, saved;
  try {
    check_output(path, options, eyes, {picture.eyes[0].radiance.width, picture.eyes[0].radiance.height});
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind);
    checked = error.what();
  }
  try {
    save_picture(picture, {}, options, path);
  } catch (const Error& error) {
    saved = error.what();
  }
  EXPECT_EQ(checked, saved) << "check_output() says what save_picture() would";
  EXPECT_EQ(checked.find('\n'), std::string::npos);
  return checked;
}

TEST(CheckOutput, RefusesWhatCannotBeSaved) {
  const TemporaryFolder folder;
  const auto with = [](Layout layout) {
    SaveOptions options;
    options.layout = layout;
    return options;
  };
  EXPECT_NE(refusal(folder.path("a.gif"), {}, stereo()).find("known are png, jpg"), std::string::npos);
  EXPECT_NE(refusal(folder.path("a"), {}, stereo()), "");
  EXPECT_NE(refusal(folder.path(""), {}, stereo()), "");
  EXPECT_NE(refusal(folder.path("a.png"), with(Layout::kMultiview), stereo()), "");
  EXPECT_NE(refusal(folder.path("a.exr"), with(Layout::kMultiview), single(kMono)), "");
  EXPECT_NE(refusal(folder.path("a.exr"), with(Layout::kSeparate), stereo()), "");
  EXPECT_NE(refusal(folder.path("%V.exr"), {}, single(kMono)), "");
  EXPECT_NE(refusal(folder.path("a.exr"), with(Layout::kAnaglyph), stereo()), "");
  EXPECT_NE(refusal(folder.path("a.hdr"), with(Layout::kAnaglyphDubois), stereo()), "");
  EXPECT_NE(refusal(folder.path("a.png"), with(Layout::kAnaglyphHalf), single(kLeft)), "");
  EXPECT_THROW(check_output(folder.path("a.png"), with(Layout::kTopBottomHalf), {kLeft, kRight}, {34, 17}), Error);
  EXPECT_NO_THROW(check_output(folder.path("a.png"), with(Layout::kSideBySideHalf), {kLeft, kRight}, {34, 17}));
  EXPECT_NO_THROW(check_output(folder.path("a.png"), with(Layout::kTopBottomHalf), {kMono}, {34, 17}));
  EXPECT_NE(refusal("/dev/null/a.png", {}, stereo(), ErrorKind::kOutput), "");
  // Nothing that could not be read: 268 million pixels in a file.
  for (const char* name : {"a.png", "a.exr", "a.jpg", "a.tif", "a.hdr"}) {
    EXPECT_NO_THROW(check_output(folder.path(name), {}, {kLeft, kRight}, {16384, 8192}));
    EXPECT_THROW(check_output(folder.path(name), {}, {kLeft, kRight}, {16386, 8193}), Error);
    EXPECT_THROW(check_output(folder.path(name), {}, {kMono}, {32768, 16384}), Error);
    EXPECT_THROW(check_output(folder.path(name), {}, {kMono}, {32770, 2}), Error);
  }
  EXPECT_TRUE(folder.names().empty());

  std::filesystem::create_directory(folder.path("left.png"));
  EXPECT_NE(refusal(folder.path("left.png"), {}, stereo(), ErrorKind::kOutput), "");
  EXPECT_NE(refusal(folder.path("%V.png"), {}, stereo(), ErrorKind::kOutput), "");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"left.png"}) << "no right eye without a left one";

  EXPECT_THROW(check_output(folder.path("a.webp"), {}, {kLeft, kRight}, {16384, 8192}), Error);
  EXPECT_THROW(check_output(folder.path("a.jpg"), with(Layout::kSideBySide), {kLeft, kRight}, {32768, 16384}), Error);

  EXPECT_EQ(refusal(folder.path("new/a.exr"), with(Layout::kMultiview), stereo()), "");
  EXPECT_EQ(refusal(folder.path("%v.png"), with(Layout::kSeparate), single(kRight)), "");
}

TEST(Save, AFullDiskLeavesNothing) {
  const TinyDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "skipped: a small tmpfs can only be mounted by root with CAP_SYS_ADMIN";
  disk.fill();
  // Noise, so that every format fails in the middle of the work and not only in its last buffer.
  std::mt19937 random(3);
  const auto noise = [&](int eye) {
    EyeImage result{eye, Image(256, 128, 3), Image(256, 128, 1), Image(256, 128, 3), Image(256, 128, 3), {}};
    for (float& value : result.radiance.pixels) value = static_cast<float>(random() % 1024) / 1024.0f;
    return result;
  };
  const Picture picture{{noise(kLeft), noise(kRight)}};
  for (const char* extension : kExtensions) {
    for (const char* name : {"a.", "%V."}) {
      try {
        save_picture(picture, {}, {}, disk.folder().path(std::string(name) + extension));
        FAIL() << extension;
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::kOutput);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      }
      EXPECT_EQ(disk.folder().names(), std::vector<std::string>{"ballast"}) << extension;
    }
  }
}

}  // namespace ods::save_test

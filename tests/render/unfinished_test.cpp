// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/unfinished.h"

#include <gtest/gtest.h>

#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "ods/files/file_input.h"
#include "ods/image/format/exr_header.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/render/cpu/render.h"
#include "ods/render/part_file.h"
#include "ods/scene/load/load.h"
#include "tests/support/pictures.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

RenderOptions options_with(bool everything) {
  RenderOptions options = small_render(24, 20);
  options.height = 12;
  options.eyes = everything ? Eyes::kBothEyes : Eyes::kRightEye;
  options.layers = options.statistics = options.transparent = everything;
  return options;
}

PictureSamples samples_with(const RenderOptions& options) {
  const Scene scene = load_scene("toys");
  const StereoCamera camera;
  PictureSamples samples = no_samples(options);
  CpuRenderer(scene).sample({&camera, 1}, options, samples);
  return samples;
}

SampledPicture about(const RenderOptions& options) {
  return {{{"seed", "7", ""}},
          write_sidecar({StereoCamera(), {options.width, options.height}}),
          1.5f,
          ToneCurve::kLinear,
          options};
}

void expect_same(const PictureSamples& a, const PictureSamples& b) {
  EXPECT_EQ(a.noisy, b.noisy);
  EXPECT_EQ(std::vector({a.width, a.height, a.done, a.pass_to, a.blocks_done}),
            std::vector({b.width, b.height, b.done, b.pass_to, b.blocks_done}));
  ASSERT_EQ(a.eyes.size(), b.eyes.size());
  for (size_t i = 0; i < a.eyes.size(); i++) {
    EXPECT_EQ(a.eyes[i].eye, b.eyes[i].eye);
    std::vector<std::string> left, right;
    const auto bytes_into = [](std::vector<std::string>& list) {
      return [&list](const char*, const auto& plane) {
        const auto bytes = std::as_bytes(std::span(plane));
        list.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      };
    };
    each_plane(a.eyes[i], bytes_into(left));
    each_plane(b.eyes[i], bytes_into(right));
    EXPECT_EQ(left, right);
  }
}

TEST(Unfinished, ComesBackBitForBit) {
  const TemporaryFolder folder;
  for (const bool everything : {true, false}) {
    const RenderOptions options = options_with(everything);
    PictureSamples samples = samples_with(options);
    samples.done = 3, samples.pass_to = 17, samples.blocks_done = 2;
    write_unfinished(folder.path("a"), about(options), samples);
    EXPECT_TRUE(is_unfinished(folder.path("a")));
    PictureSamples again;
    const SampledPicture picture = read_unfinished(folder.path("a"), again);
    expect_same(again, samples);
    EXPECT_EQ(settings_difference(picture.settings, about(options).settings), "");
    EXPECT_EQ(picture.camera, about(options).camera);
    EXPECT_EQ(picture.exposure, 1.5f);
    EXPECT_EQ(picture.tone, ToneCurve::kLinear);
    EXPECT_EQ(samples_bytes(picture.options), samples_bytes(options));
  }
}

// Every byte matters: a changed one is noticed, and so is a shorter file or a longer one.
TEST(Unfinished, DamageIsNoticed) {
  const TemporaryFolder folder;
  RenderOptions options = options_with(false);
  options.width = 4, options.height = 2;
  write_unfinished(folder.path("a"), about(options), samples_with(options));
  const std::string whole = folder.read("a");
  const auto expect_refused = [&](const std::string& bytes, size_t at) {
    folder.write("b", bytes);
    PictureSamples samples;
    try {
      read_unfinished(folder.path("b"), samples);
      ADD_FAILURE() << at;
    } catch (const Error& error) {
      EXPECT_TRUE(error.kind() == ErrorKind::kInput || error.kind() == ErrorKind::kMemory) << at << error.what();
    }
  };
  for (size_t at = 0; at < whole.size(); at++) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x41);
    expect_refused(bytes, at);
    if (at % 5 == 0) expect_refused(whole.substr(0, at), at);
  }
  expect_refused(whole + '\0', whole.size());
}

TEST(PartFile, HoldsTheExactSums) {
  const TemporaryFolder folder;
  for (const bool everything : {true, false}) {
    const RenderOptions options = options_with(everything);
    PictureSamples samples = samples_with(options);
    samples.eyes[0].light[5] = (int64_t{1} << 62) + 12345;  // beyond what floats and doubles hold
    SampledPicture picture = about(options);
    picture.options.part = {2, 3};
    save_part(folder.path("part.exr"), picture, samples);
    const SampledPicture header = read_part_header(folder.path("part.exr"));
    EXPECT_EQ(header.options.part.number, 2);
    EXPECT_EQ(header.options.part.count, 3);
    EXPECT_EQ(settings_difference(header.settings, picture.settings), "");
    EXPECT_EQ(header.camera, picture.camera);
    EXPECT_EQ(samples_bytes(header.options), samples_bytes(options));
    PictureSamples again = PartsReader({folder.path("part.exr")}, options).sum(0, options.height);
    again.done = samples.done, again.pass_to = samples.pass_to;
    expect_same(again, samples);
  }
}

// Bands of 16 rows, the last of which has fewer, of parts whose eyes, layers and statistics are all there, or few.
TEST(PartFile, BandsMakeThePictureOfTheWholeSum) {
  const TemporaryFolder folder;
  for (const bool everything : {true, false}) {
    RenderOptions options = options_with(everything);
    options.height = 41;
    const PictureSamples samples = samples_with(options);
    PictureSamples sum = samples;
    for (EyeSamples& eye : sum.eyes) {
      each_plane(eye, [](const char* name, auto& plane) {
        if (std::string_view(name) == "depth") return;
        for (auto& number : plane) number *= 3;
      });
    }
    std::vector<std::string> parts;
    for (const char* name : {"1.exr", "2.exr", "3.exr"}) {
      parts.push_back(save_part(folder.path(name), about(options), samples));
    }
    double done = 0.0;
    const Picture picture = merge_parts(parts, options, {[&](double now) { done = now; }, {}});
    EXPECT_EQ(digest(picture), digest(develop(sum, options)));
    EXPECT_EQ(picture.samples_taken, 3.0 * static_cast<double>(count_samples(samples)));
    EXPECT_GT(done, 0.5);
    RenderOptions bare = options;
    bare.layers = bare.statistics = false;
    const Picture light = merge_parts(parts, bare);
    EXPECT_EQ(light.eyes.back().radiance.pixels, picture.eyes.back().radiance.pixels);
    EXPECT_TRUE(light.eyes[0].depth.pixels.empty() && light.eyes[0].variance.pixels.empty());
    EXPECT_THROW(merge_parts(parts, options, {{}, [] { return true; }}), Error);
  }
}

// By the header's checksum or the row's. A flipped bit of a row may change nothing: the colour that programs show is
// not among the sums.
TEST(PartFile, AFlippedBitIsNoticedOrChangesNothing) {
  const TemporaryFolder folder;
  RenderOptions options = options_with(true);
  options.width = 4, options.height = 2;
  const std::string part = save_part(folder.path("part.exr"), about(options), samples_with(options));
  const PictureSamples sums = PartsReader({part}, options).sum(0, options.height);
  const std::string whole = folder.read("part.exr");
  const size_t end = read_exr_header(FileInput(part)).end;
  size_t headers = 0, refused_headers = 0;
  for (size_t at = 0; at < whole.size(); at += at < end ? 7 : 37) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (at % 8)));
    folder.write("flipped.exr", bytes);
    if (at < end) headers++;
    try {
      const SampledPicture header = read_part_header(folder.path("flipped.exr"));
      EXPECT_EQ(settings_text(header.settings), settings_text(about(options).settings)) << at;
      EXPECT_EQ(samples_bytes(header.options), samples_bytes(options)) << at;
      const PictureSamples read = PartsReader({folder.path("flipped.exr")}, options).sum(0, options.height);
      expect_same(read, sums);
    } catch (const Error& error) {
      EXPECT_TRUE(error.kind() == ErrorKind::kInput) << at << error.what();
      EXPECT_TRUE(is_quotable(error.what())) << at;
      if (at < end) refused_headers++;
    }
    ASSERT_FALSE(HasFailure()) << "byte " << at << " of " << whole.size() << ", header " << end;
  }
  EXPECT_GE(refused_headers + 2, headers) << "only bits of the version may mean nothing";
}

TEST(PartFile, PartsWithoutAChecksumSayWhatToDo) {
  const TemporaryFolder folder;
  const RenderOptions options = options_with(false);
  const FileInput part(save_part(folder.path("part.exr"), about(options), samples_with(options)));
  ExrHeader header = read_exr_header(part);
  std::erase_if(header.attributes, [](const ExrAttribute& each) { return each.name == kExrChecksum; });
  AtomicFile old(folder.path("old.exr"));
  write_exr_header(part, old, header);
  old.commit();
  try {
    read_part_header(folder.path("old.exr"));
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("render it again"), std::string::npos) << error.what();
  }
}

TEST(PartFile, OtherPicturesAreRefused) {
  const TemporaryFolder folder;
  const RenderOptions options = options_with(true);
  const RenderOptions small = options_with(false);
  const std::string part = save_part(folder.path("small.exr"), about(small), samples_with(small));
  EXPECT_THROW(merge_parts({part}, options), Error);
  RenderOptions other = small;
  other.height--;
  EXPECT_THROW(merge_parts({part}, other), Error);
  other = small;
  other.statistics = true;
  EXPECT_THROW(merge_parts({part}, other), Error);
  EXPECT_EQ(merge_parts({part}, small).eyes.size(), 1u);
  folder.write("no.exr", "nothing of the kind");
  EXPECT_THROW(read_part_header(folder.path("no.exr")), Error);
  EXPECT_THROW(merge_parts({folder.path("no.exr")}, options), Error);
}

}  // namespace
}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The statistics in a file, under our names and others', and the layers saved beside the denoised colour.
#include "ods/denoise/stored_noise.h"

#include <gtest/gtest.h>

#include <limits>

#include "ods/base/error.h"
#include "ods/picture/load_eyes.h"
#include "tests/support/temporary_folder.h"

namespace ods::stored_noise_test {

constexpr int kWidth = 8, kHeight = 4;

using Value = std::function<float(int index, int x, int y, size_t channel)>;

struct Layer {
  std::vector<std::string> channels;
  Value value;
};

Value all(float number) {
  return [=](int, int, int, size_t) { return number; };
}

// A picture of two eyes with these layers.
void save(const std::string& path, const std::vector<Layer>& layers, Layout layout = Layout::kTopBottom) {
  PictureRows rows;
  rows.eye = {kWidth, kHeight};
  rows.eyes = {kLeft, kRight};
  for (const Layer& layer : layers) rows.layers.push_back({layer.channels, LayerRule::kMean, SampleType::kFloat});
  rows.fill = [&](int index, int y, std::span<float> row) {
    size_t to = 0;
    for (int x = 0; x < kWidth; x++) {
      for (const Layer& layer : layers) {
        for (size_t c = 0; c < layer.channels.size(); c++) row[to++] = layer.value(index, x, y, c);
      }
    }
  };
  SaveOptions options;
  options.layout = layout;
  const StereoCamera camera;
  save_picture(rows, &camera, options, path);
}

std::vector<std::string> rgb(const std::string& layer) {
  return {layer + ".R", layer + ".G", layer + ".B"};
}

const Layer kColour{{"R", "G", "B"}, [](int index, int x, int y, size_t c) {
                      return static_cast<float>(index * 100 + y * 10 + x) + 0.25f * static_cast<float>(c);
                    }};

class StoredNoiseOf : public ::testing::Test {
 protected:
  StoredNoise read(const std::vector<Layer>& layers, const NoiseLayers& names = {},
                   Layout layout = Layout::kTopBottom) {
    save(folder_.path("p.exr"), layers, layout);
    stored_ = open_picture(folder_.path("p.exr"));
    return read_noise(stored_, names, "p.exr");
  }
  ErrorKind kind_of_error(const std::vector<Layer>& layers, const NoiseLayers& names, const std::string& says) {
    try {
      read(layers, names);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
      return error.kind();
    }
    ADD_FAILURE();
    return ErrorKind::kMemory;
  }

  TemporaryFolder folder_;
  StoredPicture stored_;
};

TEST_F(StoredNoiseOf, OurOwnPictures) {
  for (const Layout layout : {Layout::kTopBottom, Layout::kSideBySide, Layout::kMultiview}) {
    const StoredNoise noise =
        read({kColour,
              {rgb("variance"), [](int, int, int, size_t c) { return 1.0f + static_cast<float>(c); }},
              {{"samples"}, all(16.0f)},
              {{"Z"}, all(2.0f)},
              {{"N.X", "N.Y", "N.Z"}, [](int, int, int, size_t c) { return static_cast<float>(c); }},
              {rgb("albedo"), all(0.5f)}},
             {}, layout);
    ASSERT_EQ(noise.picture.eyes.size(), 2u);
    EXPECT_TRUE(noise.has_features);
    EXPECT_EQ(noise.unusable, 0);
    for (int i : {0, 1}) {
      const EyeImage& eye = noise.picture.eyes[static_cast<size_t>(i)];
      EXPECT_EQ(eye.eye, i);
      for (int c = 0; c < 3; c++) {
        EXPECT_EQ(eye.radiance.at(3, 2)[c], kColour.value(i, 3, 2, static_cast<size_t>(c)));
        EXPECT_EQ(eye.variance.at(3, 2)[c], 1.0f + static_cast<float>(c));
        EXPECT_EQ(eye.normal.at(3, 2)[c], static_cast<float>(c));
        EXPECT_EQ(eye.albedo.at(3, 2)[c], 0.5f);
      }
      EXPECT_EQ(*eye.samples.at(3, 2), 16.0f);
      EXPECT_EQ(*eye.depth.at(3, 2), 2.0f);
    }
  }
}

// Cycles puts a view layer's name before all others.
TEST_F(StoredNoiseOf, LayersOfAnotherRenderer) {
  const StoredNoise noise = read(
      {kColour,
       {rgb("ViewLayer.Even"), [](int i, int x, int y, size_t c) { return kColour.value(i, x, y, c) + 0.5f; }},
       {rgb("ViewLayer.Odd"), [](int i, int x, int y, size_t c) { return kColour.value(i, x, y, c) - 0.5f; }},
       {{"ViewLayer.Denoising Normal.X", "ViewLayer.Denoising Normal.Y", "ViewLayer.Denoising Normal.Z"}, all(0.1f)},
       {rgb("ViewLayer.Denoising Albedo"), all(0.75f)}},
      {.half_a = "even", .half_b = "ViewLayer.odd"});
  const EyeImage& eye = noise.picture.eyes[1];
  EXPECT_FLOAT_EQ(eye.variance.at(5, 1)[1], 0.25f);
  EXPECT_EQ(eye.albedo.at(5, 1)[2], 0.75f);
  EXPECT_EQ(eye.normal.at(5, 1)[2], 0.1f);
  EXPECT_TRUE(eye.samples.pixels.empty());
}

TEST_F(StoredNoiseOf, HalvesByTheirUsualNames) {
  for (const auto& [a, b] : {std::pair{"halfA", "halfB"}, {"View.half1", "View.half2"}, {"Buffer_A", "buffer_b"}}) {
    const StoredNoise noise = read({kColour, {rgb(a), all(2.0f)}, {rgb(b), all(1.0f)}});
    EXPECT_EQ(noise.picture.eyes[0].variance.at(1, 1)[0], 0.25f) << a;
  }
  EXPECT_EQ(kind_of_error({kColour, {rgb("halfA"), all(2.0f)}}, {}, "`half-a`"), ErrorKind::kInput);
  const StoredNoise both =
      read({kColour, {rgb("halfA"), all(2.0f)}, {rgb("halfB"), all(1.0f)}, {rgb("variance"), all(7.0f)}});
  EXPECT_EQ(both.picture.eyes[0].variance.at(1, 1)[0], 7.0f);
}

TEST_F(StoredNoiseOf, NothingIsNeededForOtherDenoisers) {
  NoiseLayers names;
  names.needed = false;
  const StoredNoise noise = read({kColour, {rgb("albedo"), all(0.5f)}}, names);
  EXPECT_TRUE(noise.picture.eyes[0].variance.pixels.empty());
  EXPECT_EQ(noise.picture.eyes[0].albedo.at(1, 1)[0], 0.5f);
  EXPECT_EQ(noise.unusable, 0);
}

TEST_F(StoredNoiseOf, AVarianceOfOneChannel) {
  const StoredNoise noise = read({kColour, {{"noise"}, all(3.0f)}}, {.variance = "noise"});
  for (int c = 0; c < 3; c++) EXPECT_EQ(noise.picture.eyes[0].variance.at(1, 1)[c], 3.0f);
  EXPECT_FALSE(noise.has_features);
}

TEST_F(StoredNoiseOf, PixelsWithoutUsableStatisticsAreCounted) {
  const StoredNoise noise = read({kColour, {rgb("variance"), [](int index, int x, int y, size_t c) {
                                              return index == 0 && y == 1 && x < 3 && c == 1 ? -1.0f : 1.0f;
                                            }}});
  EXPECT_EQ(noise.unusable, 3);
}

TEST_F(StoredNoiseOf, WhatIsMissingIsSaid) {
  EXPECT_EQ(kind_of_error({kColour, {rgb("variance"), all(0.0f)}, {{"samples"}, all(1.0f)}}, {}, "2 samples"),
            ErrorKind::kInput);
  EXPECT_EQ(kind_of_error({kColour, {{"Z"}, all(1.0f)}}, {}, "`half-a`"), ErrorKind::kInput);
  EXPECT_EQ(kind_of_error({kColour, {{"Z"}, all(1.0f)}}, {.variance = "mse"}, "no layer 'mse'"), ErrorKind::kUsage);
  EXPECT_EQ(kind_of_error({kColour, {{"a.X", "a.Q"}, all(1.0f)}}, {.half_a = "a", .half_b = "a"}, "no layer 'a'"),
            ErrorKind::kUsage);
  save_picture({{{kLeft, Image(8, 4, 3), {}, {}, {}}}}, SaveOptions(), folder_.path("p.png"));
  const StoredPicture png = open_picture(folder_.path("p.png"));
  EXPECT_THROW(read_noise(png, {}, "p.png"), Error);
}

// The noisy colour stays beside the denoised one, alpha and all other layers as they were; done again from `raw`.
TEST_F(StoredNoiseOf, TheFileKeepsWhatItHad) {
  Layer colour = kColour;
  colour.channels.push_back("A");
  StoredNoise noise = read({colour, {rgb("variance"), all(1.0f)}, {{"id"}, all(7.0f)}});
  for (EyeImage& eye : noise.picture.eyes) std::fill(eye.radiance.pixels.begin(), eye.radiance.pixels.end(), 0.125f);
  const std::string path = folder_.path("clean.exr");
  save_picture(denoised_rows(stored_, noise.picture), &stored_.camera, {}, path);

  const StoredPicture clean = open_picture(path);
  std::vector<std::string> names;
  for (const LayerPixels& layer : clean.eyes[0].layers) {
    names.insert(names.end(), layer.channels.begin(), layer.channels.end());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"R", "G", "B", "A", "id", "raw.R", "raw.G", "raw.B", "variance.R",
                                             "variance.G", "variance.B"}));
  EXPECT_EQ(load_eyes(path).eyes[1].at(6, 3)[2], 0.125f);
  const StoredNoise again = read_noise(clean, {}, path);
  EXPECT_EQ(again.picture.eyes[1].radiance.at(6, 3)[2], kColour.value(1, 6, 3, 2));
  EXPECT_EQ(denoised_rows(clean, again.picture).layers.size(), 4u);  // not a second `raw`
}

}  // namespace ods::stored_noise_test

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The denoiser on pictures whose truth is known.
#include "ods/denoise/denoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "ods/base/error.h"
#include "ods/kernel/camera/camera.h"
#include "ods/kernel/random.h"
#include "tests/support/pictures.h"

namespace ods {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kWidth = 128;

using Truth = std::function<float(int x, int y)>;

// Two eyes, lat-long: `truth` with normal noise of this standard deviation, and its variance.
Picture noisy_picture(float deviation, const Truth& truth, int width = kWidth, unsigned seed = 7) {
  std::mt19937 engine(seed);
  std::normal_distribution<float> noise(0.0f, 1.0f);
  Picture picture;
  for (const int which : {kLeft, kRight}) {
    EyeImage eye;
    eye.eye = which;
    eye.radiance = eye.variance = Image(width, width / 2, 3);
    eye.samples = Image(width, width / 2, 1);
    for (int y = 0; y < width / 2; y++) {
      for (int x = 0; x < width; x++) {
        for (int c = 0; c < 3; c++) {
          eye.radiance.at(x, y)[c] = truth(x, y) + deviation * noise(engine);
          eye.variance.at(x, y)[c] = deviation * deviation;
        }
        *eye.samples.at(x, y) = 16.0f;
      }
    }
    picture.eyes.push_back(eye);
  }
  return picture;
}

double rmse(const Picture& picture, const Truth& truth, const std::function<bool(int x, int y)>& where) {
  double sum = 0.0;
  int count = 0;
  for (const EyeImage& eye : picture.eyes) {
    for (int y = 0; y < eye.radiance.height; y++) {
      for (int x = 0; x < eye.radiance.width; x++) {
        if (!where(x, y)) continue;
        for (int c = 0; c < 3; c++) {
          const double off = double{eye.radiance.at(x, y)[c]} - double{truth(x, y)};
          sum += off * off, count++;
        }
      }
    }
  }
  return std::sqrt(sum / count);
}

bool everywhere(int, int) {
  return true;
}

TEST(Denoise, ANoisyConstantBecomesFlat) {
  const Truth one = [](int, int) { return 1.0f; };
  Picture picture = noisy_picture(0.2f, one);
  denoise(picture, {});
  EXPECT_LT(rmse(picture, one, everywhere), 0.2 / 8.0);
}

// Neither the seam of the panorama nor a pole is noisier than the middle: windows go on there.
TEST(Denoise, SeamAndPolesAreAsCleanAsTheMiddle) {
  const Truth one = [](int, int) { return 1.0f; };
  Picture picture = noisy_picture(0.2f, one, 256);
  denoise(picture, {});
  const double all = rmse(picture, one, everywhere);
  EXPECT_LT(rmse(picture, one, [](int x, int) { return x < 2 || x >= 254; }), 1.5 * all);
  EXPECT_LT(rmse(picture, one, [](int, int y) { return y < 2 || y >= 126; }), 1.5 * all);
}

// A step of light at the seam, and one at the pole, where the left eye continues in the right one half a turn away.
TEST(Denoise, NeighboursAcrossThePoleAreTheOtherEyes) {
  const Truth truth = [](int x, int) { return x < kWidth / 2 ? 1.0f : 3.0f; };
  Picture picture = noisy_picture(0.0f, truth);
  // One noisy pixel in the top row of each eye; its neighbours above are in the other eye, where it is brighter.
  for (EyeImage& eye : picture.eyes) {
    for (int c = 0; c < 3; c++) eye.variance.at(kWidth / 4, 0)[c] = 4.0f;
  }
  denoise(picture, {});
  for (const EyeImage& eye : picture.eyes) EXPECT_GT(eye.radiance.at(kWidth / 4, 0)[0], 1.2f);
}

TEST(Denoise, ASignificantEdgeStays) {
  const Truth truth = [](int x, int) { return x >= 32 && x < 96 ? 2.0f : 1.0f; };
  Picture picture = noisy_picture(0.05f, truth);
  denoise(picture, {});
  const auto beside = [](int x, int) { return x == 31 || x == 32 || x == 95 || x == 96; };
  EXPECT_LT(rmse(picture, truth, beside), 0.03);
}

TEST(Denoise, LightWithoutVarianceKeepsItsBits) {
  const Truth truth = [](int x, int y) { return 0.1f + static_cast<float>((x * 7 + y * 13) % 11); };
  Picture picture = noisy_picture(0.0f, truth);
  for (EyeImage& eye : picture.eyes) eye.albedo = Image(kWidth, kWidth / 2, 3);
  const uint64_t before = digest(picture);
  denoise(picture, {});
  EXPECT_EQ(digest(picture), before);
}

// Fireflies are spread, not lost: the sum is the same within one of its own standard deviations.
TEST(Denoise, EnergyIsKept) {
  const Truth truth = [](int x, int) { return x % 64 < 32 ? 1.0f : 0.5f; };
  Picture picture = noisy_picture(0.1f, truth);
  std::mt19937 engine(3);
  for (EyeImage& eye : picture.eyes) {
    for (int i = 0; i < 60; i++) {
      const size_t at = engine() % (eye.radiance.pixels.size() / 3);
      for (size_t c = 0; c < 3; c++) {  // one sample of 16 has met a lamp
        eye.radiance.pixels[3 * at + c] += 5.0f;
        eye.variance.pixels[3 * at + c] += 25.0f;
      }
    }
  }
  const auto sum_of = [](const Picture& of) {
    double sum = 0.0;
    for (const EyeImage& eye : of.eyes) {
      for (float value : eye.radiance.pixels) sum += double{value};
    }
    return sum;
  };
  double variance = 0.0;
  for (const EyeImage& eye : picture.eyes) {
    for (float value : eye.variance.pixels) variance += double{value};
  }
  const double before = sum_of(picture);
  denoise(picture, {});
  EXPECT_NEAR(sum_of(picture), before, std::sqrt(3.0 * variance));  // the three channels are the same fireflies
  for (const EyeImage& eye : picture.eyes) {
    for (float value : eye.radiance.pixels) EXPECT_LT(value, 3.5f);
  }
}

// One sample of 16 has met a lamp.
void add_firefly(EyeImage& eye, int x, int y, float light) {
  for (int c = 0; c < 3; c++) eye.radiance.at(x, y)[c] += light, eye.variance.at(x, y)[c] += light * light;
}

double light_of(const EyeImage& eye) {
  double sum = 0.0;
  for (float value : eye.radiance.pixels) sum += double{value};
  return sum;
}

// The largest difference between a pixel and the mean of the eight around it.
float roughest(const EyeImage& eye) {
  float maximum = 0.0f;
  for (int y = 1; y + 1 < eye.radiance.height; y++) {
    for (int x = 1; x + 1 < eye.radiance.width; x++) {
      float ring = 0.0f;
      for (int i = 0; i < 9; i++) {
        if (i != 4) ring += 0.125f * eye.radiance.at(x + i % 3 - 1, y + i / 3 - 1)[0];
      }
      maximum = std::max(maximum, std::abs(eye.radiance.at(x, y)[0] - ring));
    }
  }
  return maximum;
}

// Neither a lattice nor a blotch, but a faint glow, with all the light; also beside another firefly, at the seam, and
// on a pixel whose albedo no other has.
TEST(Denoise, AFireflyLeavesNoPattern) {
  const Truth one = [](int, int) { return 1.0f; };
  struct Place {
    int x, y;
  };
  const Place places[][2] = {{{128, 64}, {40, 20}}, {{128, 64}, {129, 65}}, {{0, 64}, {255, 100}}};
  for (const bool is_edge : {false, true}) {
    for (const auto& [first, second] : places) {
      Picture clean = noisy_picture(0.1f, one, 256);
      EyeImage& eye = clean.eyes[0];
      eye.albedo = Image(256, 128, 3);
      std::fill(eye.albedo.pixels.begin(), eye.albedo.pixels.end(), 0.5f);
      if (is_edge) {  // the same light on it
        std::fill_n(eye.albedo.at(first.x, first.y), 3, 0.25f);
        std::fill_n(eye.radiance.at(first.x, first.y), 3, (0.25f + 0.05f) / (0.5f + 0.05f));
      }
      clean.eyes[1].albedo = eye.albedo;
      Picture picture = clean;
      add_firefly(picture.eyes[0], first.x, first.y, 200.0f);
      add_firefly(picture.eyes[0], second.x, second.y, 100.0f);
      denoise(clean, {});
      denoise(picture, {});
      const std::string where = "beside " + std::to_string(second.x) + (is_edge ? ", edge" : "");
      EyeImage glow = picture.eyes[0];
      for (size_t i = 0; i < glow.radiance.pixels.size(); i++) {
        glow.radiance.pixels[i] -= clean.eyes[0].radiance.pixels[i];
      }
      // A pixel like no other keeps its own noise.
      EXPECT_LT(roughest(glow), is_edge ? 0.1f : 0.05f) << where;
      EXPECT_LT(*std::max_element(glow.radiance.pixels.begin(), glow.radiance.pixels.end()), 0.15f) << where;
      EXPECT_NEAR(light_of(glow), 3.0 * 300.0, 9.0) << where;
    }
  }
}

// The other eye sees the same place, and glows as much.
TEST(Denoise, AFireflyOfOneEyeIsSharedByBoth) {
  Picture picture = noisy_picture(
      0.1f, [](int, int) { return 1.0f; }, 256);
  for (EyeImage& eye : picture.eyes) {
    eye.depth = Image(256, 128, 1);
    std::fill(eye.depth.pixels.begin(), eye.depth.pixels.end(), 50.0f);
  }
  Picture clean = picture;
  add_firefly(picture.eyes[0], 128, 64, 300.0f);
  denoise(clean, {});
  denoise(picture, {});
  for (size_t eye : {0, 1}) {
    EXPECT_NEAR(light_of(picture.eyes[eye]) - light_of(clean.eyes[eye]), 3.0 * 150.0, 9.0) << eye;
  }
}

// The silhouette of a lamp at a rough wall: pixels that one sample of six on the lamp made bright. Wide windows must
// not repeat them on the wall.
TEST(Denoise, TheSilhouetteOfALampIsNotRepeated) {
  const auto is_lamp = [](int x, int y) { return x >= 50 && x < 70 && y >= 25 && y < 40; };
  Picture picture = noisy_picture(0.004f, [](int, int) { return 0.02f; });
  for (EyeImage& eye : picture.eyes) {
    eye.normal = eye.albedo = Image(kWidth, kWidth / 2, 3);
    for (int y = 0; y < kWidth / 2; y++) {
      for (int x = 0; x < kWidth; x++) {
        const bool edge = x == 71 && y == 24;
        eye.normal.at(x, y)[0] = x % 8 == 7 && y % 8 == 0 ? 0.6f : 0.0f;
        eye.normal.at(x, y)[1] = -1.0f;
        for (int c = 0; c < 3; c++) {
          eye.albedo.at(x, y)[c] = is_lamp(x, y) ? 0.0f : edge ? 0.35f : 0.42f;
          if (is_lamp(x, y)) eye.radiance.at(x, y)[c] = 40.0f, eye.variance.at(x, y)[c] = 0.0f;
          if (edge) eye.radiance.at(x, y)[c] = 40.0f / 6.0f, eye.variance.at(x, y)[c] = 44.0f;
        }
      }
    }
  }
  denoise(picture, {});
  float maximum = 0.0f;
  for (const EyeImage& eye : picture.eyes) {
    for (int y = 0; y < kWidth / 2; y++) {
      for (int x = 0; x < kWidth; x++) {
        const bool is_far = x < 46 || x > 74 || y < 21 || y >= 44;
        if (is_far) maximum = std::max(maximum, eye.radiance.at(x, y)[0]);
      }
    }
  }
  EXPECT_LT(maximum, 0.04f);
}

// All samples are bright: that is not a firefly, however small the lamp.
TEST(Denoise, ALampOfOnePixelStays) {
  Picture picture = noisy_picture(0.1f, [](int x, int y) { return x == 50 && y == 30 ? 50.0f : 1.0f; });
  for (EyeImage& eye : picture.eyes) {
    for (int c = 0; c < 3; c++) eye.variance.at(50, 30)[c] = 100.0f;
  }
  denoise(picture, {});
  for (const EyeImage& eye : picture.eyes) EXPECT_NEAR(eye.radiance.at(50, 30)[0], 50.0f, 5.0f);
}

TEST(Denoise, TexturesInTheAlbedoStay) {
  const Truth texture = [](int x, int y) { return (x + y) % 2 == 0 ? 0.8f : 0.7f; };
  Picture picture = noisy_picture(0.0f, texture);
  std::mt19937 engine(5);
  std::normal_distribution<float> noise(0.0f, 0.2f);
  for (EyeImage& eye : picture.eyes) {
    eye.albedo = eye.radiance;
    for (float& value : eye.radiance.pixels) value *= 1.0f + noise(engine);
    for (float& value : eye.variance.pixels) value = 0.0225f;
  }
  denoise(picture, {});
  EXPECT_LT(rmse(picture, texture, everywhere), 0.02);
}

TEST(Denoise, PixelsWithoutUsableStatisticsAreFilledOrTested) {
  const Truth one = [](int, int) { return 1.0f; };
  Picture picture = noisy_picture(0.1f, one);
  EyeImage& eye = picture.eyes[0];
  eye.radiance.at(5, 20)[1] = kNaN;
  eye.variance.at(5, 20)[1] = kNaN;
  eye.radiance.at(9, 30)[0] = std::numeric_limits<float>::infinity();
  eye.variance.at(20, 30)[2] = kNaN;
  eye.variance.at(21, 31)[2] = -1.0f;
  eye.variance.at(22, 32)[0] = std::numeric_limits<float>::infinity();
  *eye.samples.at(30, 30) = 1.0f;
  denoise(picture, {});
  EXPECT_LT(rmse(picture, one, everywhere), 0.03);
}

TEST(Denoise, APictureWithoutAnyUsableVarianceIsAnError) {
  Picture picture = noisy_picture(0.1f, [](int, int) { return 1.0f; });
  for (EyeImage& eye : picture.eyes) {
    for (float& value : eye.variance.pixels) value = kNaN;
  }
  const uint64_t before = digest(picture);
  EXPECT_THROW(denoise(picture, {}), Error);
  EXPECT_EQ(digest(picture), before);
}

TEST(Denoise, ItCanBeStopped) {
  Picture picture = noisy_picture(0.1f, [](int, int) { return 1.0f; });
  Progress progress;
  progress.cancelled = [] { return true; };
  const uint64_t before = digest(picture);
  try {
    denoise(picture, {}, {}, progress);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kCancelled);
  }
  EXPECT_EQ(digest(picture), before);
}

// A pixel that cannot be told from its neighbours may be wrong by a part of the noise: far less than the noise itself.
TEST(Denoise, ItConverges) {
  const Truth truth = [](int x, int y) {
    return 1.0f + 0.5f * std::sin(static_cast<float>(x) * 0.2f) * std::cos(static_cast<float>(y) * 0.3f);
  };
  for (const float deviation : {0.1f, 0.01f, 0.001f}) {
    Picture picture = noisy_picture(deviation, truth);
    const double raw = rmse(picture, truth, everywhere);
    denoise(picture, {});
    EXPECT_LT(rmse(picture, truth, everywhere), raw) << deviation;
  }
}

TEST(Denoise, EveryProjectionIsTaken) {
  const Truth one = [](int, int) { return 1.0f; };
  for (const NamedProjection& projection : named_projections()) {
    StereoCamera camera;
    camera.projection = projection.setting;
    Picture picture = noisy_picture(0.2f, one, 96);
    for (EyeImage& eye : picture.eyes) {
      eye.depth = Image(96, 48, 1);
      std::fill(eye.depth.pixels.begin(), eye.depth.pixels.end(), 2.0f);
      eye.normal = eye.albedo = Image(96, 48, 3);
      std::fill(eye.normal.pixels.begin(), eye.normal.pixels.end(), 0.5f);
      std::fill(eye.albedo.pixels.begin(), eye.albedo.pixels.end(), 0.5f);
    }
    denoise(picture, camera);
    // Outside an image circle there is nothing to be averaged.
    const Projection seen = make_projection(projection.setting);
    const auto inside = [&](int x, int y) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / 96.0f, (static_cast<float>(y) + 0.5f) / 48.0f);
      return !has_image_circle(seen.kind) || look_of(seen, uv, uv).seen;
    };
    EXPECT_LT(rmse(picture, one, inside), 0.2 / 5.0) << projection.name;
  }
}

// Both eyes look at one wall of a sphere: what they see of it becomes more alike together than alone.
TEST(Denoise, TheEyesGetTheSameLight) {
  const Truth one = [](int, int) { return 1.0f; };
  double difference[2];
  for (const bool both : {false, true}) {
    Picture picture = noisy_picture(0.2f, one);
    for (EyeImage& eye : picture.eyes) {
      eye.depth = Image(kWidth, kWidth / 2, 1);
      std::fill(eye.depth.pixels.begin(), eye.depth.pixels.end(), 50.0f);  // far: the eyes see it at the same place
    }
    DenoiseOptions options;
    options.both_eyes = both;
    denoise(picture, {}, options);
    double sum = 0.0;
    for (size_t i = 0; i < picture.eyes[0].radiance.pixels.size(); i++) {
      sum += std::pow(double{picture.eyes[0].radiance.pixels[i]} - double{picture.eyes[1].radiance.pixels[i]}, 2.0);
    }
    difference[both] = std::sqrt(sum);
  }
  EXPECT_LT(difference[1], 0.7 * difference[0]);
}

// --- frames of a video -----------------------------------------------------------------------------------------------

// Light that no pixel shares with those beside it.
float speckle(int x, int y) {
  return 1.0f + 8.0f *
                    static_cast<float>(hash_pair(static_cast<uint>((x + kWidth) % kWidth), static_cast<uint>(y)) >> 8) *
                    0x1p-24f;
}

// Speckles on a far sphere, turned to the right by some columns; each frame with other noise.
Picture speckled_frame(int columns, unsigned seed) {
  Picture frame = noisy_picture(
      0.05f, [=](int x, int y) { return speckle(x - columns, y); }, kWidth, seed);
  for (EyeImage& eye : frame.eyes) {
    eye.depth = Image(kWidth, kWidth / 2, 1);
    std::fill(eye.depth.pixels.begin(), eye.depth.pixels.end(), 1000.0f);
  }
  return frame;
}

StereoCamera turned_left(int columns) {
  StereoCamera camera;
  camera.yaw = 360.0f * static_cast<float>(-columns) / kWidth;
  return camera;
}

double error_with(std::span<const FrameBeside> beside) {
  Picture frame = speckled_frame(0, 1);
  denoise(frame, {}, {false, 0, beside});
  return rmse(frame, speckle, everywhere);
}

// Three pictures of the same light have 0.6 of the noise, with weights of 1, 2 and 2.
TEST(Denoise, FramesDrawOnThoseBesideThem) {
  const double alone = error_with({});
  EXPECT_NEAR(alone, 0.05, 0.005);
  const Picture before = speckled_frame(3, 2), after = speckled_frame(-5, 3);
  EXPECT_NEAR(error_with(std::vector<FrameBeside>{{before, turned_left(3), {}}, {after, turned_left(-5), {}}}),
              0.6 * alone, 0.05 * alone);
  // Frames of the same random numbers are of use where the picture moves.
  EXPECT_LT(error_with(std::vector<FrameBeside>{{before, turned_left(3), {}, true}}), 0.8 * alone);
  const Picture still = speckled_frame(0, 1);
  EXPECT_EQ(error_with(std::vector<FrameBeside>{{still, {}, {}, true}}), alone);
  // Layers that do not fit are left out.
  EXPECT_NEAR(error_with(std::vector<FrameBeside>{{before, {}, {}}, {after, {}, {}}}), alone, 0.05 * alone);
}

// The sphere turns instead of the camera.
TEST(Denoise, FramesFollowWhatMoves) {
  const Picture before = speckled_frame(3, 2), after = speckled_frame(-5, 3);
  std::vector<FrameBeside> beside{{before, {}, {}}, {after, {}, {}}};
  std::vector<std::vector<vec3>> all[2];
  const Camera camera = make_camera(StereoCamera());
  for (size_t i = 0; i < 2; i++) {
    const int columns = i == 0 ? 3 : -5;
    for (const int eye : {kLeft, kRight}) {
      std::vector<vec3>& places = all[i].emplace_back();
      for (int pixel = 0; pixel < kWidth * kWidth / 2; pixel++) {
        const vec2 uv((static_cast<float>(pixel % kWidth + columns) + 0.5f) / kWidth,
                      (static_cast<float>(pixel / kWidth) + 0.5f) / (kWidth / 2));
        const Ray ray = camera_ray(camera, eye, vec2(uv.x - std::floor(uv.x), uv.y));
        places.push_back(ray.origin + 1000.0f * ray.direction);
      }
    }
  }
  for (size_t i = 0; i < 2; i++) beside[i].places = all[i];
  EXPECT_NEAR(error_with(beside), 0.6 * error_with({}), 0.0025);
}

TEST(Denoise, TheNumberOfThreadsChangesNoBit) {
  const Truth truth = [](int x, int y) { return x * y % 3 == 0 ? 1.0f : 2.0f; };
  uint64_t digests[3];
  for (size_t i = 0; i < 3; i++) {
    Picture picture = noisy_picture(0.3f, truth, 320);
    for (EyeImage& eye : picture.eyes) {
      eye.depth = Image(320, 160, 1);
      std::fill(eye.depth.pixels.begin(), eye.depth.pixels.end(), 3.0f);
    }
    DenoiseOptions options;
    options.threads = std::array{1, 2, 5}[i];
    denoise(picture, {}, options);
    digests[i] = digest(picture);
  }
  EXPECT_EQ(digests[0], digests[1]);
  EXPECT_EQ(digests[0], digests[2]);
}

}  // namespace
}  // namespace ods

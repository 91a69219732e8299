// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/convert.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ods/image/compare.h"
#include "ods/image/tone.h"
#include "tests/stored_pictures.h"

namespace ods {
namespace {

const std::vector<int> kBoth{kLeft, kRight};

CameraRig rig_of(const std::string& projection) {
  CameraRig rig;
  rig.projection = projection_named(projection);
  return rig;
}

Extent extent_of(const ProjectionSetting& projection, int face) {
  const int width = face * width_step(projection);
  return {width, natural_height(projection, width)};
}

// About 4 texels to the degree in every projection.
Extent even_extent(const ProjectionSetting& projection, double per_radian) {
  const double width = per_radian / pixels_per_radian(projection, 1.0);
  const int step = width_step(projection);
  const int rounded = static_cast<int>(std::lround(width / step)) * step;
  return {rounded, natural_height(projection, rounded)};
}

// A smooth world that differs between the eyes, as seen along a direction.
void smooth_world(int eye, vec3 d, float* out) {
  const float phase = eye == kRight ? 0.7f : 0.0f;
  out[0] = 0.5f + 0.4f * std::sin(3.0f * d.x + 2.0f * d.y + phase);
  out[1] = 0.5f + 0.4f * std::sin(4.0f * d.z - 3.0f * d.x * d.y + phase);
  out[2] = 0.5f + 0.4f * std::cos(5.0f * d.y + d.x + phase);
}

PixelFunction seen_by(const Camera& camera) {
  return [camera](int eye, vec2 uv, float* out) {
    const vec3 d = camera_ray(camera, eye, uv).direction;
    if (d == vec3(0.0f)) {
      out[0] = out[1] = out[2] = 0.0f;
    } else {
      smooth_world(eye, d, out);
    }
  };
}

MadePicture smooth_picture(const CameraRig& rig, Extent size, const std::vector<int>& eyes = kBoth) {
  MadePicture made = make_picture(rig, size, eyes);
  add_colour(made, seen_by(make_camera(rig)));
  return made;
}

PixelFunction noise(int seed) {
  auto engine = std::make_shared<std::mt19937>(seed);
  return [engine](int, vec2, float* out) {
    for (int c = 0; c < 3; c++) out[c] = static_cast<float>((*engine)() >> 24);
  };
}

MadePicture noise_picture(const CameraRig& rig, Extent size, const std::vector<int>& eyes = kBoth) {
  MadePicture made = make_picture(rig, size, eyes);
  add_layer<uint8_t>(made, {"R", "G", "B"}, LayerRule::kLight, Sample::kUint8, noise(1));
  return made;
}

float code_at(const MadePicture& made, size_t eye, int x, int y, int c) {
  const LayerPixels& layer = made.picture.eyes[eye].layers[0];
  const std::byte code = layer.first[y * layer.row_stride + x * layer.pixel_stride + c];
  return srgb_decode(static_cast<float>(code) / 255.0f);
}

// The largest difference of the colours of pixels that both have; infinite where only one has any.
float largest_difference(const Image& made, const Image& expected) {
  float largest = 0.0f;
  for (int y = 0; y < made.height; y++) {
    for (int x = 0; x < made.width; x++) {
      for (int c = 0; c < 3; c++) {
        largest = std::max(largest, std::abs(made.at(x, y)[c] - expected.at(x, y)[c]));
      }
    }
  }
  return largest;
}

TEST(Convert, ToItselfIsTheSamePictureBitForBit) {
  for (const NamedProjection& named : named_projections()) {
    const CameraRig rig = rig_of(std::string(named.name));
    for (const int face : {20, 37}) {
      const MadePicture made = noise_picture(rig, extent_of(rig.projection, face));
      const ConvertTarget target = target_of(made, rig.projection, made.picture.size);
      ASSERT_EQ(conversion_fault(made.picture, target), "");
      const Conversion conversion = convert(made.picture, target);
      const std::vector<Image> images = images_of(conversion.rows);
      EXPECT_EQ(*conversion.empty, 0) << named.name;
      int differences = 0;
      for (size_t eye = 0; eye < 2; eye++) {
        for (int y = 0; y < target.eye.height; y++) {
          for (int x = 0; x < target.eye.width; x++) {
            const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(target.eye.width),
                          (static_cast<float>(y) + 0.5f) / static_cast<float>(target.eye.height));
            const bool seen = look_of(make_projection(rig.projection), uv, uv).seen;
            for (int c = 0; c < 3; c++) {
              differences += images[eye].at(x, y)[c] != (seen ? code_at(made, eye, x, y, c) : 0.0f);
            }
          }
        }
      }
      EXPECT_EQ(differences, 0) << named.name << " of " << target.eye.width << "x" << target.eye.height;
    }
  }
}

TEST(Convert, TurnsByWholePixelsBitForBit) {
  CameraRig rig = rig_of("lat-long");
  rig.yaw = 30.0f;
  const MadePicture made = noise_picture(rig, {720, 360});
  ConvertTarget target = target_of(made, rig.projection, made.picture.size);
  for (const int pixels : {1, 100, 719, -60}) {
    target.rig.yaw = 30.0f + 0.5f * static_cast<float>(pixels);
    const std::vector<Image> images = images_of(convert(made.picture, target).rows);
    int differences = 0;
    for (size_t eye = 0; eye < 2; eye++) {
      for (int i = 0; i < 720 * 360; i++) {
        const int x = i % 720, y = i / 720;
        for (int c = 0; c < 3; c++) {
          differences += images[eye].at(x, y)[c] != code_at(made, eye, (x + pixels + 720) % 720, y, c);
        }
      }
    }
    EXPECT_EQ(differences, 0) << pixels;
  }
}

// From every projection to every projection, against the world itself.
TEST(Convert, AnyProjectionToAnyOther) {
  for (const NamedProjection& from : named_projections()) {
    const CameraRig rig = rig_of(std::string(from.name));
    const MadePicture made = smooth_picture(rig, even_extent(rig.projection, 60.0));
    for (const NamedProjection& to : named_projections()) {
      ConvertTarget target = target_of(made, to.setting, even_extent(to.setting, 50.0));
      target.rig.yaw = 20.0f;
      const Camera camera = make_camera(target.rig);
      const std::vector<Image> images = images_of(convert(made.picture, target).rows);
      float largest = 0.0f;
      int seen = 0;
      for (size_t eye = 0; eye < 2; eye++) {
        const Image& image = images[eye];
        for (int i = 0; i < image.width * image.height; i++) {
          const int x = i % image.width, y = i / image.width;
          const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(image.width),
                        (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height));
          const float* pixel = image.at(x, y);
          if (pixel[0] == 0.0f && pixel[1] == 0.0f) continue;  // what one of them does not show
          float expected[3];
          seen_by(camera)(target.eyes[eye], uv, expected);
          for (int c = 0; c < 3; c++) largest = std::max(largest, std::abs(pixel[c] - expected[c]));
          seen++;
        }
      }
      EXPECT_LT(largest, 0.01f) << from.name << " to " << to.name;
      EXPECT_GT(seen, 0) << from.name << " to " << to.name;
    }
  }
}

}  // namespace
}  // namespace ods

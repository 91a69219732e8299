// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/convert.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ods/convert/panorama.h"
#include "ods/image/tone.h"
#include "tests/support/stored_pictures.h"

namespace ods::convert_test {

constexpr std::array kWideLens = {0.0f, -0.08f, 0.0f, 0.0f, 0.0f};  // else small pictures are all edge
const std::vector<int> kBoth{kLeft, kRight};

StereoCamera camera_of(const std::string& projection) {
  StereoCamera stereo;
  stereo.projection = projection_named(projection);
  return stereo;
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

MadePicture smooth_picture(const StereoCamera& stereo, Extent size, const std::vector<int>& eyes = kBoth) {
  MadePicture made = make_picture(stereo, size, eyes);
  add_colour(made, seen_by(make_camera(stereo)));
  return made;
}

PixelFunction noise(int seed) {
  auto engine = std::make_shared<std::mt19937>(seed);
  return [engine](int, vec2, float* out) {
    for (int c = 0; c < 3; c++) out[c] = static_cast<float>((*engine)() >> 24);
  };
}

MadePicture noise_picture(const StereoCamera& stereo, Extent size, const std::vector<int>& eyes = kBoth) {
  MadePicture made = make_picture(stereo, size, eyes);
  add_layer<uint8_t>(made, {"R", "G", "B"}, LayerRule::kLight, SampleType::kUint8, noise(1));
  return made;
}

float code_at(const MadePicture& made, size_t eye, int x, int y, int c) {
  const LayerPixels& layer = made.picture.eyes[eye].layers[0];
  const std::byte code = layer.first[y * layer.row_stride + x * layer.pixel_stride + c];
  return srgb_decode(static_cast<float>(code) / 255.0f);
}

TEST(Convert, ToItselfIsTheSamePictureBitForBit) {
  for (const NamedProjection& named : named_projections()) {
    const StereoCamera stereo = camera_of(std::string(named.name));
    for (const int face : {20, 37}) {
      const MadePicture made = noise_picture(stereo, extent_of(stereo.projection, face));
      const ConvertTarget target = target_of(made, stereo.projection, made.picture.size);
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
            const bool seen = look_of(make_projection(stereo.projection), uv, uv).seen;
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
  StereoCamera stereo = camera_of("lat-long");
  stereo.yaw = 30.0f;
  const MadePicture made = noise_picture(stereo, {720, 360});
  ConvertTarget target = target_of(made, stereo.projection, made.picture.size);
  for (const int pixels : {1, 100, 719, -60}) {
    target.camera.yaw = 30.0f + 0.5f * static_cast<float>(pixels);
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

vec2 home_of(Extent size, int x, int y) {
  return {(static_cast<float>(x) + 0.5f) / static_cast<float>(size.width),
          (static_cast<float>(y) + 0.5f) / static_cast<float>(size.height)};
}

// Mean square and largest distance of what was made from what the camera would see, where it was made at all.
struct Distance {
  double squares = 0.0;
  int count = 0;
  float largest = 0.0f;
  double psnr() const { return -10.0 * std::log10(squares / count); }
};

Distance distance(const std::vector<Image>& images, const ConvertTarget& target, const PixelFunction& expected) {
  Distance all;
  for (size_t eye = 0; eye < images.size(); eye++) {
    for (int i = 0; i < target.eye.width * target.eye.height; i++) {
      const int x = i % target.eye.width, y = i / target.eye.width;
      const float* pixel = images[eye].at(x, y);
      float seen[3];
      expected(target.eyes[eye], home_of(target.eye, x, y), seen);
      if (std::abs(pixel[0]) + std::abs(pixel[1]) + std::abs(pixel[2]) == 0.0f) continue;
      for (int c = 0; c < 3; c++) {
        const float error = std::abs(pixel[c] - seen[c]);
        all.largest = std::max(all.largest, error);
        all.squares += double{error} * double{error};
        all.count++;
      }
    }
  }
  return all;
}

// The circle is merged at the poles, so that each eye's world is its own all over. Half a texel at a picture's edge is
// not in the picture. The last 20 degrees behind so small a mirror ball lie within its outermost texels.
TEST(Convert, AnyProjectionToAnyOther) {
  for (const NamedProjection& from : named_projections()) {
    StereoCamera stereo = camera_of(std::string(from.name));
    stereo.projection.polynomial = kWideLens;
    stereo.top.mode = stereo.bottom.mode = kMergeCosine;
    const MadePicture made = smooth_picture(stereo, even_extent(stereo.projection, 20.0));
    const bool has_edge = !is_cube(stereo.projection.kind) && from.name != "lat-long";
    for (NamedProjection to : named_projections()) {
      to.setting.polynomial = kWideLens;
      ConvertTarget target = target_of(made, to.setting, even_extent(to.setting, 15.0));
      target.camera.yaw = 20.0f;
      const std::vector<Image> images = images_of(convert(made.picture, target).rows);
      const Distance error = distance(images, target, seen_by(make_camera(target.camera)));
      const bool is_ball = from.name == "mirror-ball" || to.name == "mirror-ball";
      EXPECT_LT(error.largest, is_ball ? 0.5f : has_edge ? 0.15f : 0.03f) << from.name << " to " << to.name;
      EXPECT_GT(error.psnr(), is_ball ? 30.0 : has_edge ? 42.0 : 45.0) << from.name << " to " << to.name;
      EXPECT_GT(error.count, 100) << from.name << " to " << to.name;
    }
  }
}

// Wide enough for the stretches of fill().
TEST(Convert, LargePicturesAreAsExact) {
  StereoCamera stereo = camera_of("lat-long");
  stereo.top.mode = stereo.bottom.mode = kMergeCosine;
  const MadePicture made = smooth_picture(stereo, {1024, 512});
  for (const char* name : {"cube-3x2", "eac", "fisheye", "lat-long"}) {
    const ProjectionSetting to = projection_named(name);
    ConvertTarget target = target_of(made, to, fitting_extent(made.picture, to));
    target.camera.yaw = -33.3f;
    const Distance error =
        distance(images_of(convert(made.picture, target).rows), target, seen_by(make_camera(target.camera)));
    EXPECT_LT(error.largest, 0.001f) << name;
    EXPECT_GT(error.psnr(), 85.0) << name;
  }
}

TEST(Convert, MonoTiltsAnyWay) {
  const StereoCamera stereo = camera_of("lat-long");
  const MadePicture made = smooth_picture(stereo, {512, 256}, {kMono});
  ConvertTarget target = target_of(made, projection_named("eac"), {192, 128});
  target.camera.yaw = 100.0f, target.camera.pitch = 50.0f, target.camera.roll = -30.0f;
  const Distance error =
      distance(images_of(convert(made.picture, target).rows), target, seen_by(make_camera(target.camera)));
  EXPECT_LT(error.largest, 0.004f);
}

TEST(Convert, OneEyeOfTwo) {
  const MadePicture made = smooth_picture(camera_of("lat-long"), {128, 64});
  ConvertTarget target = target_of(made, made.picture.camera.projection, {128, 64});
  for (const int eye : kBoth) {
    target.eyes = {eye};
    const Image single = images_of(convert(made.picture, target).rows)[0];
    target.eyes = {kMono};
    target.mono_from = eye;
    const Image mono = images_of(convert(made.picture, target).rows)[0];
    float expected[3];
    seen_by(make_camera(made.picture.camera))(eye, home_of({128, 64}, 40, 30), expected);
    EXPECT_EQ(single.at(40, 30)[0], expected[0]);
    EXPECT_EQ(mono.at(40, 30)[0], expected[0]);
  }
}

// Rings of all frequencies up to one texel: those that the small picture cannot hold become grey.
TEST(Convert, ReducingEightfoldDoesNotAlias) {
  const MadePicture made = [] {
    MadePicture zone = make_picture(camera_of("perspective"), {512, 512}, {kMono});
    add_colour(zone, [](int, vec2 uv, float* out) {
      const vec2 p = (uv - 0.5f) * 512.0f;
      out[0] = out[1] = out[2] = 0.5f + 0.5f * std::cos(kPi / 512.0f * dot(p, p));
    });
    return zone;
  }();
  const ConvertTarget target = target_of(made, made.picture.camera.projection, {64, 64});
  const Image small = images_of(convert(made.picture, target).rows)[0];
  float worst = 0.0f, middle = 0.0f;
  for (int y = 0; y < 64; y++) {
    for (int x = 0; x < 64; x++) {
      const float r = 8.0f * std::hypot(static_cast<float>(x) - 31.5f, static_cast<float>(y) - 31.5f);
      const float contrast = std::abs(small.at(x, y)[0] - 0.5f);
      if (r > 64.0f) worst = std::max(worst, contrast);
      if (r < 16.0f) middle = std::max(middle, contrast);
    }
  }
  EXPECT_LT(worst, 0.03f);
  EXPECT_GT(middle, 0.3f);  // and those that it can hold stay
}

TEST(Convert, EyesDoNotBleed) {
  for (const NamedProjection& from : named_projections()) {
    StereoCamera stereo = camera_of(std::string(from.name));
    stereo.top.mode = stereo.bottom.mode = kMergeLinear;
    MadePicture made = make_picture(stereo, even_extent(stereo.projection, 20.0), kBoth);
    add_colour(made, [](int eye, vec2, float* out) { out[0] = eye == kLeft, out[1] = eye == kRight, out[2] = 1.0f; });
    for (const char* to : {"lat-long", "cube-3x2", "fisheye"}) {
      const ConvertTarget target = target_of(made, projection_named(to), even_extent(projection_named(to), 9.0));
      const std::vector<Image> images = images_of(convert(made.picture, target).rows);
      for (size_t eye = 0; eye < 2; eye++) {
        for (int i = 0; i < target.eye.width * target.eye.height; i++) {
          EXPECT_EQ(images[eye].at(0, 0)[images[eye].channels * i + (eye == 0 ? 1 : 0)], 0.0f) << from.name << to;
        }
      }
    }
  }
}

// The opposite face never shows, wherever the file has it.
TEST(Convert, FacesDoNotBleed) {
  for (const char* name : {"cube-3x2", "cube-6x1", "cube-1x6", "eac"}) {
    const StereoCamera stereo = camera_of(name);
    const Camera camera = make_camera(stereo), all = make_camera(camera_of("lat-long"));
    for (const vec3 face : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, -1)}) {
      MadePicture made = make_picture(stereo, even_extent(stereo.projection, 20.0), {kMono});
      add_colour(made, [&](int eye, vec2 uv, float* out) {
        const vec3 d = camera_ray(camera, eye, uv).direction;
        const vec3 a = abs(d);
        const bool red = dot(d, face) >= max(a.x, max(a.y, a.z)) - 1e-6f;
        out[0] = red, out[1] = !red, out[2] = 0.0f;
      });
      ConvertTarget target = target_of(made, projection_named("lat-long"), {150, 75});
      const Image image = images_of(convert(made.picture, target).rows)[0];
      for (int i = 0; i < 150 * 75; i++) {
        const vec3 d = camera_ray(all, kMono, home_of(target.eye, i % 150, i / 150)).direction;
        const vec3 a = abs(d);
        const float red = image.at(i % 150, i / 150)[0], off = max(a.x, max(a.y, a.z)) - dot(d, face);
        const bool inside = off == 0.0f && dot(d, face) > 0.85f;
        EXPECT_TRUE(off <= 0.25f || red == 0.0f) << name << " " << i;
        EXPECT_TRUE(!inside || red == 1.0f) << name << " " << i;
      }
    }
  }
}

// A ball of stripes around the camera, seen from where the ray starts.
PixelFunction ball_seen_by(const StereoCamera& stereo) {
  const Camera camera = make_camera(stereo);
  return [camera](int eye, vec2 uv, float* out) {
    const Ray ray = camera_ray(camera, eye, uv);
    const float b = dot(ray.origin, ray.direction), kRadius = 2.0f;
    const vec3 p =
        ray.origin + ray.direction * (std::sqrt(b * b + kRadius * kRadius - dot(ray.origin, ray.origin)) - b);
    out[0] = 0.5f + 0.45f * std::sin(5.0f * p.x);
    out[1] = 0.5f + 0.45f * std::sin(5.0f * p.z);
    out[2] = 0.5f + 0.45f * std::sin(4.0f * p.y);
  };
}

// Across a pole that is not merged the other eye's picture continues (a line of sight that passed the pole is the other
// eye's, half a turn away).
TEST(Convert, CrossesThePoleIntoTheOtherEye) {
  StereoCamera stereo = camera_of("lat-long");
  stereo.ipd = 0.6f;
  MadePicture made = make_picture(stereo, {256, 128}, kBoth);
  add_colour(made, ball_seen_by(stereo));
  ConvertTarget target = target_of(made, stereo.projection, {200, 100});
  target.camera.yaw = 12.0f;
  const Distance error = distance(images_of(convert(made.picture, target).rows), target, ball_seen_by(target.camera));
  EXPECT_LT(error.largest, 0.01f);
  // One eye alone has nothing to read there but itself, and that is not it.
  made.picture.eyes.pop_back();
  target.eyes = {kLeft};
  const Distance alone = distance(images_of(convert(made.picture, target).rows), target, ball_seen_by(target.camera));
  EXPECT_GT(alone.largest, 2.0f * error.largest);
}

TEST(Convert, DepthAndIdsAreNeverMixed) {
  MadePicture made = smooth_picture(camera_of("lat-long"), {64, 32});
  const PixelFunction ids = [](int eye, vec2 uv, float* out) {
    out[0] = std::floor(uv.x * 64.0f) + 64.0f * std::floor(uv.y * 32.0f) + 4096.0f * static_cast<float>(eye);
  };
  add_layer<float>(made, {"Z"}, LayerRule::kNearest, SampleType::kFloat, ids);
  const PixelFunction normals = [](int, vec2 uv, float* out) { out[0] = uv.x, out[1] = uv.y, out[2] = -1.0f; };
  add_layer<float>(made, {"N.X", "N.Y", "N.Z"}, LayerRule::kMean, SampleType::kFloat, normals);
  ConvertTarget target = target_of(made, projection_named("cube-3x2"), {33, 22});
  const Conversion conversion = convert(made.picture, target);
  ASSERT_EQ(channels_of(conversion.rows), 7);
  EXPECT_EQ(conversion.rows.layers[1].rule, LayerRule::kNearest);
  EXPECT_EQ(conversion.rows.layers[2].channels[0], "N.X");
  const std::vector<Image> images = images_of(conversion.rows);
  const Source source = make_source(made.picture);
  for (int eye = 0; eye < 2; eye++) {
    for (int i = 0; i < 33 * 22; i++) {
      const vec2 uv = home_of(target.eye, i % 33, i / 33);
      const Place place = place_of_line(source, eye, camera_ray(make_camera(target.camera), eye, uv).direction);
      float expected;
      ids(eye, min(place.at / vec2(64.0f, 32.0f), vec2(0.999f)), &expected);
      const float* pixel = images[static_cast<size_t>(eye)].at(i % 33, i / 33);
      EXPECT_EQ(pixel[3], expected);
      EXPECT_NEAR(pixel[6], -1.0f, 1e-6f);
    }
  }
}

// A world at infinity, where a line's direction is all.
TEST(Convert, ConvergenceAfterTheFact) {
  for (const int from : kConvergences) {
    StereoCamera stereo = camera_of("lat-long");
    stereo.ipd = 0.2f;
    stereo.top.mode = stereo.bottom.mode = kMergeCosine;
    stereo.convergence = from;
    const auto sky = [](const StereoCamera& camera) {
      return [camera = make_camera(camera)](int eye, vec2 uv, float* out) {
        smooth_world(kMono, camera_ray(camera, eye, uv).direction, out);
      };
    };
    MadePicture made = make_picture(stereo, {360, 180}, kBoth);
    add_colour(made, sky(stereo));
    for (const int to : kConvergences) {
      ConvertTarget target = target_of(made, stereo.projection, {300, 150});
      target.camera.convergence = to;
      target.camera.convergence_distance = 1.5f;
      ASSERT_EQ(conversion_fault(made.picture, target), "");
      const Distance error = distance(images_of(convert(made.picture, target).rows), target, sky(target.camera));
      EXPECT_LT(error.largest, 0.004f) << convergence_name(from) << " to " << convergence_name(to);
    }
  }
}

// On the ball at the distance of convergence the eyes' pictures fall together, at the horizon.
TEST(Convert, ToeInAndShiftTakeTheParallaxAway) {
  StereoCamera stereo = camera_of("lat-long");
  MadePicture made = make_picture(stereo, {512, 256}, kBoth);
  add_colour(made, ball_seen_by(stereo));
  for (const int to : kConvergences) {
    ConvertTarget target = target_of(made, stereo.projection, {512, 256});
    target.camera.convergence = to;
    target.camera.convergence_distance = 2.0f;
    const std::vector<Image> images = images_of(convert(made.picture, target).rows);
    float parallax = 0.0f;
    for (int x = 0; x < 512; x++)
      parallax = std::max(parallax, std::abs(images[0].at(x, 128)[0] - images[1].at(x, 128)[0]));
    EXPECT_TRUE(to == kParallel ? parallax > 0.05f : parallax < 0.001f) << convergence_name(to) << " " << parallax;
  }
}

TEST(Convert, WhereThePictureEndsIsNothing) {
  const MadePicture made = smooth_picture(camera_of("fisheye"), {64, 64});
  const ConvertTarget target = target_of(made, projection_named("lat-long"), {64, 32});
  const Conversion conversion = convert(made.picture, target);
  ASSERT_EQ(conversion.rows.layers[0].channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  const Image left = images_of(conversion.rows)[0];
  EXPECT_EQ(left.at(32, 16)[3], 1.0f);
  EXPECT_GT(left.at(32, 16)[0], 0.0f);
  for (int c = 0; c < 4; c++) EXPECT_EQ(left.at(2, 16)[c], 0.0f);
  EXPECT_NEAR(static_cast<double>(*conversion.empty), 64.0 * 32.0, 64.0);  // half of either eye
  // Areas that the target itself leaves empty are not missing.
  const Conversion same = convert(made.picture, target_of(made, made.picture.camera.projection, {40, 40}));
  EXPECT_EQ(same.rows.layers[0].channels.size(), 3u);
  images_of(same.rows);
  EXPECT_EQ(*same.empty, 0);
}

TEST(Convert, ColoursAreMixedByTheirAlpha) {
  MadePicture made = make_picture(camera_of("lat-long"), {64, 32}, {kMono});
  add_layer<uint8_t>(made, {"R", "G", "B", "A"}, LayerRule::kLight, SampleType::kUint8, [](int, vec2 uv, float* out) {
    const bool clear = static_cast<int>(uv.x * 64.0f) % 2 == 0;
    out[0] = 255.0f, out[1] = clear ? 255.0f : 0.0f, out[2] = 0.0f, out[3] = clear ? 0.0f : 255.0f;
  });
  const Image image =
      images_of(convert(made.picture, target_of(made, made.picture.camera.projection, {16, 8})).rows)[0];
  EXPECT_NEAR(image.at(5, 4)[3], 0.5f, 0.01f);
  EXPECT_NEAR(image.at(5, 4)[0], image.at(5, 4)[3], 1e-5f);
  EXPECT_EQ(image.at(5, 4)[1], 0.0f);  // what is clear has no colour
}

// Squeezed eyes are eyes whose pixels are not square.
TEST(Convert, SqueezedEyesNeedNoSpecialCase) {
  const MadePicture made = smooth_picture(camera_of("lat-long"), {360, 90});
  const ConvertTarget target = target_of(made, projection_named("cube-3x2"), {120, 80});
  const Distance error =
      distance(images_of(convert(made.picture, target).rows), target, seen_by(make_camera(target.camera)));
  EXPECT_GT(error.psnr(), 50.0);
  EXPECT_EQ(fitting_extent(made.picture, projection_named("lat-long")).width, 360);
}

TEST(Convert, SizesAreAsSharp) {
  const MadePicture made = make_picture(camera_of("lat-long"), {4096, 2048}, kBoth);
  const auto fitting = [&](const char* name) { return fitting_extent(made.picture, projection_named(name)); };
  EXPECT_EQ(fitting("lat-long").width, 4096);
  EXPECT_EQ(fitting("lat-long").height, 2048);
  EXPECT_EQ(fitting("vr180").width, 2048);
  EXPECT_EQ(fitting("vr180").height, 2048);
  EXPECT_EQ(fitting("cube-3x2").width, 3 * 1304);
  EXPECT_EQ(fitting("cube-3x2").height, 2 * 1304);
  EXPECT_EQ(fitting("cube-1x6").width, 1304);
  EXPECT_EQ(fitting("eac").width, 3 * 1024);
  EXPECT_EQ(fitting("fisheye").width, 2048);
}

TEST(Convert, SaysWhatItCannotDo) {
  const MadePicture stereo = make_picture(camera_of("lat-long"), {64, 32}, kBoth);
  const MadePicture mono = make_picture(camera_of("lat-long"), {64, 32}, {kMono});
  const auto fault = [](const MadePicture& made, const std::vector<int>& eyes, const auto& change) {
    ConvertTarget target = target_of(made, made.picture.camera.projection, {64, 32});
    target.eyes = eyes;
    change(target.camera);
    return conversion_fault(made.picture, target);
  };
  const auto nothing = [](StereoCamera&) {};
  EXPECT_EQ(fault(stereo, kBoth, nothing), "");
  EXPECT_EQ(fault(stereo, kBoth, [](StereoCamera& camera) { camera.yaw = 77.0f; }), "");
  EXPECT_NE(fault(stereo, kBoth, [](StereoCamera& camera) { camera.pitch = 5.0f; }).find("yaw"), std::string::npos);
  EXPECT_NE(fault(stereo, kBoth, [](StereoCamera& camera) { camera.roll = 5.0f; }).find("yaw"), std::string::npos);
  EXPECT_EQ(fault(stereo, {kMono}, [](StereoCamera& camera) { camera.roll = 5.0f; }), "");
  EXPECT_EQ(fault(mono, {kMono}, [](StereoCamera& camera) { camera.pitch = 5.0f; }), "");
  EXPECT_NE(fault(mono, kBoth, nothing).find("depth"), std::string::npos);
  EXPECT_NE(fault(stereo, kBoth, [](StereoCamera& camera) { camera.ipd = 0.1f; }).find(".exr"), std::string::npos);
  EXPECT_NE(fault(stereo, kBoth, [](StereoCamera& camera) { camera.top.mode = kMergeLinear; }).find("depth"),
            std::string::npos);
  EXPECT_NE(fault(stereo, kBoth, [](StereoCamera& camera) { camera.neck = 0.1f; }).find("depth"), std::string::npos);
  EXPECT_NE(fault(stereo, {kMono}, [](StereoCamera& camera) { camera.mirrored = true; }), "");
}

// Numbers that no picture should have, and pictures of a single pixel.
TEST(Convert, BadInput) {
  const float bad[] = {std::nanf(""), INFINITY, -INFINITY, 3e38f};
  for (const NamedProjection& from : named_projections()) {
    MadePicture made = make_picture(camera_of(std::string(from.name)), {6, 6}, kBoth);
    add_colour(made, [&](int, vec2 uv, float* out) { std::fill(out, out + 3, bad[static_cast<int>(uv.x * 4.0f)]); });
    for (const NamedProjection& to : named_projections()) {
      const ConvertTarget target = target_of(made, to.setting, extent_of(to.setting, 3));
      for (const Image& image : images_of(convert(made.picture, target).rows)) {
        for (const float value : image.pixels) EXPECT_FALSE(std::isnan(value)) << from.name << " to " << to.name;
      }
    }
  }
  const MadePicture pixel = smooth_picture(camera_of("lat-long"), {1, 1});
  for (const Image& image : images_of(convert(pixel.picture, target_of(pixel, projection_named("eac"), {6, 4})).rows)) {
    for (const float value : image.pixels) EXPECT_TRUE(std::isfinite(value));
  }
}

}  // namespace ods::convert_test

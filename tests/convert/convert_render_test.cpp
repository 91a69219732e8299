// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures converted against pictures rendered: the same scene in the target's form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ods/image/compare.h"
#include "ods/render/cpu/render.h"
#include "tests/support/scenes.h"
#include "tests/support/stored_pictures.h"

namespace ods {
namespace {

const std::vector<int> kBoth{kLeft, kRight};

int glowing(Scene& scene, vec3 color) {
  Material material = default_material();
  material.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  material.emission = color;
  return add_material(scene, material);
}

// Boxes and balls that glow, so that only edges have noise.
Scene glowing_scene() {
  Scene scene;
  scene.environment = {vec3(0.3f, 0.35f, 0.4f), 0, 0, {}};
  for (int i = 0; i < 24; i++) {
    const float turn = 0.7f * static_cast<float>(i), height = 0.35f * static_cast<float>(i % 7) - 1.0f;
    const vec3 at(1.6f * std::sin(turn), height, 1.6f * std::cos(turn));
    const vec3 color(0.1f + 0.13f * static_cast<float>(i % 7), 0.9f - 0.17f * static_cast<float>(i % 5), 0.5f);
    const int material = glowing(scene, color);
    if (i % 2 == 0) add_sphere(scene, at, 0.25f, material, 16);
    if (i % 2 == 1) add_box(scene, at - 0.2f, at + 0.2f, material);
  }
  for (const float y : {-1.8f, 1.8f})
    add_sphere(scene, vec3(0.2f, y, 0.1f), 0.5f, glowing(scene, vec3(0.8f, 0.6f, 0.1f)));
  return scene;
}

std::vector<Image> rendered(const StereoCamera& camera, Extent size) {
  RenderOptions options;
  options.width = size.width;
  options.height = size.height;
  options.samples = 32;
  options.bounces = 0;
  options.even_noise = false;
  options.layers = false;
  std::vector<Image> images;
  for (EyeImage& eye : render_cpu(glowing_scene(), camera, options, {}).eyes) images.push_back(std::move(eye.radiance));
  return images;
}

MadePicture stored(const StereoCamera& camera, Extent size) {
  MadePicture made = make_picture(camera, size, kBoth);
  const std::vector<Image> images = rendered(camera, size);
  add_colour(made, [&](int eye, vec2 uv, float* out) {
    const int x = static_cast<int>(uv.x * static_cast<float>(size.width));
    const int y = static_cast<int>(uv.y * static_cast<float>(size.height));
    std::copy_n(images[eye == kLeft ? 0 : 1].at(x, y), 3, out);
  });
  return made;
}

std::vector<Image> colours_of(const std::vector<Image>& images) {
  std::vector<Image> all;
  for (const Image& image : images) {
    Image colour(image.width, image.height, 3);
    for (int i = 0; i < image.width * image.height; i++) {
      std::copy_n(image.pixels.data() + i * image.channels, 3, colour.pixels.data() + i * 3);
    }
    all.push_back(std::move(colour));
  }
  return all;
}

// The change of a picture from this column to the next, relative to the changes around there.
double seam(const Image& image, int column) {
  const auto step = [&](int x) {
    double sum = 0.0;
    for (int y = 0; y < image.height; y++) {
      for (int c = 0; c < 3; c++) {
        sum += std::abs(double{image.at((x + 1) % image.width, y)[c]} - double{image.at(x % image.width, y)[c]});
      }
    }
    return sum;
  };
  double around = 0.0;
  for (const int off : {-3, -2, -1, 1, 2, 3}) around += step(column + image.width + off) / 6.0;
  return step(column + image.width) / around;
}

struct Case {
  const char* from;
  const char* to;
  double floor;  // dB
};

// From twice the resolution, as one would.
TEST(ConvertRender, IsAsRendered) {
  const Case cases[] = {{"lat-long", "cube-3x2", 50.0}, {"lat-long", "eac", 50.0},      {"lat-long", "vr180", 50.0},
                        {"lat-long", "fisheye", 50.0},  {"cube-3x2", "lat-long", 50.0}, {"eac", "lat-long", 50.0}};
  for (const Case& one : cases) {
    StereoCamera from, to;
    from.projection = projection_named(one.from);
    to.projection = projection_named(one.to);
    const int width = static_cast<int>(std::lround(60.0 / pixels_per_radian(from.projection, 1.0) / 12.0)) * 12;
    const MadePicture made = stored(from, {width, natural_height(from.projection, width)});
    const Extent fit = fitting_extent(made.picture, to.projection);
    const int step = 2 * width_step(to.projection), half = (fit.width / 2 + step - 1) / step * step;
    const ConvertTarget target = target_of(made, to.projection, {half, natural_height(to.projection, half)});
    const std::vector<Image> converted = colours_of(images_of(convert(made.picture, target).rows));
    const double psnr = compare_eyes(rendered(to, target.eye), converted).whole.psnr;
    RecordProperty(std::string(one.from) + " to " + one.to, std::to_string(psnr));
    EXPECT_GT(psnr, one.floor) << one.from << " to " << one.to;
  }
}

TEST(ConvertRender, NoSeamsShow) {
  for (const char* from : {"cube-3x2", "cube-6x1", "eac"}) {
    StereoCamera camera;
    camera.projection = projection_named(from);
    const int width = 64 * width_step(camera.projection);
    const MadePicture made = stored(camera, {width, natural_height(camera.projection, width)});
    ConvertTarget target = target_of(made, projection_named("lat-long"), {256, 128});
    const std::vector<Image> converted = images_of(convert(made.picture, target).rows);
    const std::vector<Image> direct = rendered(target.camera, target.eye);
    // The turn's ends and the borders of faces.
    for (const int column : {255, 31, 95, 159, 223}) {
      EXPECT_LT(seam(converted[0], column), 0.1 + 1.3 * seam(direct[0], column)) << from << " at " << column;
    }
  }
}

}  // namespace
}  // namespace ods

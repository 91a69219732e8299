// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/cycles_passes.h"

#include <gtest/gtest.h>

#include <map>
#include <span>
#include <vector>

#include "ods/base/error.h"
#include "ods/image/image_file.h"
#include "tests/support/temporary_folder.h"

namespace ods::cycles_passes_test {

// The point at the end of the ray is as far from the centre as Cycles says, whatever the eyes and the convergence.
TEST(CyclesPasses, DepthIsMeasuredAlongTheRay) {
  for (const int convergence : {kParallel, kToeIn}) {
    StereoCamera stereo;
    stereo.ipd = 0.4f, stereo.convergence = convergence, stereo.position = {1.0f, 2.0f, 3.0f};
    const Camera camera = make_camera(stereo);
    for (const int eye : {kLeft, kRight}) {
      for (const vec2 uv : {vec2(0.5f, 0.5f), vec2(0.1f, 0.3f), vec2(0.7f, 0.9f)}) {
        const Ray ray = camera_ray(camera, eye, uv);
        const float t = along_ray(stereo, ray, 1.5f);
        EXPECT_NEAR(length(ray.origin + t * ray.direction - stereo.position), 1.5f, 1e-5f);
        EXPECT_EQ(along_ray(stereo, ray, 0.05f), 0.0f) << "inside the circle";
      }
    }
  }
}

// A file as Blender writes it, all pixels alike.
std::string write_part(const TemporaryFolder& folder, const std::string& name, const std::string& view,
                       const std::map<std::string, float>& values) {
  FileHeader header;
  header.format = FileFormat::kExr, header.width = 8, header.height = 4;
  std::vector<float> pixel;
  for (const auto& [channel, value] : values) {
    const size_t end = channel.rfind('.');
    header.channels.push_back({"ViewLayer." + channel.substr(0, end) + view + channel.substr(end), SampleType::kFloat});
    pixel.push_back(value);
  }
  folder.write(name, image_bytes(name, header, [&](int, std::span<float> row) {
                 for (size_t i = 0; i < row.size(); i++) row[i] = pixel[i % pixel.size()];
               }));
  return folder.path(name);
}

// With another radiance, alpha and albedo.
std::string write_part(const TemporaryFolder& folder, const std::string& name, const std::string& view, float red,
                       float alpha, float albedo) {
  return write_part(folder, name, view,
                    {{"Combined.R", red},
                     {"Combined.G", 2.0f},
                     {"Combined.B", 3.0f},
                     {"Combined.A", alpha},
                     {"Depth.Z", 10.0f},
                     {"Normal.X", 0.0f},
                     {"Normal.Y", 0.6f},
                     {"Normal.Z", 0.8f},
                     {"Denoising Normal.X", 1.0f},
                     {"Denoising Albedo.R", albedo},
                     {"Denoising Albedo.G", 0.5f},
                     {"Denoising Albedo.B", 0.5f}});
}

TEST(CyclesPasses, PartsBecomeTheirMeanAndItsVariance) {
  const TemporaryFolder folder;
  const std::vector<std::string> parts = {write_part(folder, "a.exr", ".left", 1.0f, 1.0f, 0.5f),
                                          write_part(folder, "b.exr", "", 3.0f, 0.5f, 0.7f)};
  CyclesPasses passes;
  passes.camera.ipd = 0.0f, passes.eye = kRight, passes.unit = 0.01f, passes.has_alpha = true;
  const EyeImage eye = read_cycles(parts, passes);
  EXPECT_EQ(eye.eye, kRight);
  EXPECT_EQ(eye.radiance.at(3, 2)[0], 2.0f);
  EXPECT_EQ(eye.radiance.at(3, 2)[1], 2.0f);
  EXPECT_EQ(eye.variance.at(3, 2)[0], 1.0f) << "the half difference squared";
  EXPECT_EQ(eye.variance.at(3, 2)[1], 0.0f);
  EXPECT_EQ(*eye.samples.at(3, 2), 2.0f);
  EXPECT_EQ(*eye.alpha.at(3, 2), 0.75f);
  EXPECT_NEAR(*eye.depth.at(3, 2), 0.1f, 1e-6f) << "centimetres";
  EXPECT_EQ(eye.normal.at(3, 2)[1], 0.8f) << "up";
  EXPECT_EQ(eye.normal.at(3, 2)[2], -0.6f) << "ahead";
  EXPECT_NEAR(eye.albedo.at(3, 2)[0], 0.6f, 1e-6f);
  EXPECT_TRUE(read_cycles(std::span(parts).first(1), passes).variance.pixels.empty());
}

TEST(CyclesPasses, AFileWithoutDepthIsRefused) {
  const TemporaryFolder folder;
  const std::vector<std::string> parts = {
      write_part(folder, "a.exr", "", {{"Combined.R", 1.0f}, {"Combined.G", 1.0f}, {"Combined.B", 1.0f}})};
  EXPECT_THROW(read_cycles(parts, {}), Error);
}

}  // namespace ods::cycles_passes_test

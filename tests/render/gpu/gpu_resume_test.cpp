// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures of a card that are interrupted, continued on another device, or rendered in parts on several.
#include "ods/base/error.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/render/cpu/render.h"
#include "ods/render/gpu/gpu_renderer.h"
#include "ods/render/gpu/shaders/shared.h"
#include "ods/render/part_file.h"
#include "ods/scene/builtin/builtin.h"
#include "tests/render/gpu/agreement.h"
#include "tests/support/temporary_folder.h"

namespace ods::gpu_resume_test {

// Continues from samples until the renderer has asked this often whether to stop; returns what it has kept, or all.
PictureSamples sampled_for(const Renderer& renderer, const RenderOptions& options, PictureSamples samples, int polls) {
  const StereoCamera camera;
  PictureSamples kept = samples;
  Progress progress;
  progress.cancelled = [&] { return --polls == 0; };
  try {
    renderer.sample({&camera, 1}, options, samples, progress, [&](const PictureSamples& now) { kept = now; });
    return samples;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kCancelled);
    return kept;
  }
}

// Large enough for several slices of blocks.
RenderOptions sliced_options() {
  RenderOptions options = small_options();
  options.width = 64, options.height = 32, options.samples = 8;
  return options;
}

class GpuResume : public OnCard {};

TEST_F(GpuResume, GivesTheBitsOfARunWithoutInterruption) {
  const Scene scene = find_builtin("mirrors")->make();
  const GpuRenderer renderer(scene, card, 4 * kGroupSize);
  const RenderOptions options = sliced_options();
  const PictureSamples whole = sampled(renderer, {}, options);
  PictureSamples pieces = no_samples(options);
  for (int i = 0; pieces.done < options.samples && i < 100; i++) pieces = sampled_for(renderer, options, pieces, 1);
  EXPECT_EQ(pieces.eyes[0].light, whole.eyes[0].light);
  EXPECT_EQ(pieces.eyes[1].light, whole.eyes[1].light);
  EXPECT_EQ(pieces.eyes[0].weights, whole.eyes[0].weights);
  EXPECT_EQ(pieces.eyes[0].depth, whole.eyes[0].depth);
}

TEST_F(GpuResume, OnAnotherDeviceGivesTheSamePicture) {
  const Scene scene = find_builtin("mirrors")->make();
  const CpuRenderer cpu(scene);
  const GpuRenderer gpu(scene, card, 4 * kGroupSize);
  const RenderOptions options = sliced_options();
  const PictureSamples whole = sampled(cpu, {}, options);
  const PictureSamples begun = sampled_for(gpu, options, no_samples(options), 1);
  ASSERT_LT(begun.done, options.samples) << "else this test shows nothing";
  expect_agreement(whole, sampled_for(cpu, options, begun, -1), "begun on a card");
  const PictureSamples begun_on_cpu = sampled_for(cpu, options, no_samples(options), 1);
  expect_agreement(whole, sampled_for(gpu, options, begun_on_cpu, -1), "begun on the CPU");
}

TEST_F(GpuResume, PartsOfBothDevicesAddUp) {
  const Scene scene = find_builtin("mirrors")->make();
  const CpuRenderer cpu(scene);
  const GpuRenderer gpu(scene, card, 4 * kGroupSize);
  const RenderOptions options = sliced_options();
  const TemporaryFolder folder;
  std::vector<std::string> parts;
  for (int i = 1; i <= 2; i++) {
    RenderOptions part = options;
    part.part = {i, 2};
    const Renderer& device = i == 1 ? static_cast<const Renderer&>(cpu) : gpu;
    const SampledPicture about{{}, write_sidecar({{}, {part.width, part.height}}), 0.0f, ToneCurve::kNeutral, part};
    parts.push_back(save_part(folder.path(std::to_string(i) + ".exr"), about, sampled(device, {}, part)));
  }
  const Picture merged = merge_parts(parts, options);
  const Picture whole = develop(sampled(cpu, {}, options), options);
  double difference = 0.0, light = 0.0;
  const Image &a = whole.eyes[0].radiance, &b = merged.eyes[0].radiance;
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  for (size_t i = 0; i < a.pixels.size(); i++) {
    difference += std::abs(double{a.pixels[i]} - double{b.pixels[i]}), light += double{a.pixels[i]};
  }
  EXPECT_LT(difference, 0.02 * light);
}

}  // namespace ods::gpu_resume_test

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture that is rendered with interruptions, or in parts, has the bits of one that is rendered at once.
#include <gtest/gtest.h>

#include "ods/base/error.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/render/cpu/render.h"
#include "ods/render/part_file.h"
#include "ods/scene/load/load.h"
#include "tests/support/pictures.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

RenderOptions options_with(int samples, float noise) {
  RenderOptions options = small_render(64, samples);
  options.height = 32;
  options.eyes = Eyes::kBothEyes;
  options.filter = PixelFilter::kBlackmanHarris;
  options.even_noise = true;
  options.statistics = true;
  options.noise = noise;
  return options;
}

// Renders in one go, or is cancelled after every slice, and resumes from the saved samples.
Picture render_in_pieces(const Scene& scene, const RenderOptions& options, int& pieces) {
  const CpuRenderer renderer(scene, options.threads);
  const StereoCamera camera;
  PictureSamples kept = no_samples(options);
  for (pieces = 1;; pieces++) {
    PictureSamples samples = kept;
    int polls = 0;
    Progress progress;
    progress.cancelled = [&] { return ++polls == 2; };
    try {
      renderer.sample({&camera, 1}, options, samples, progress, [&](const PictureSamples& now) { kept = now; });
      return develop(samples, options);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kCancelled);
    }
  }
}

TEST(Resume, GivesTheBitsOfARunWithoutInterruption) {
  const Scene scene = load_scene("toys");
  for (const float noise : {0.0f, 0.2f}) {
    const RenderOptions options = options_with(80, noise);
    const uint64_t whole = digest(render_cpu(scene, StereoCamera{}, options));
    int pieces = 0;
    EXPECT_EQ(digest(render_in_pieces(scene, options, pieces)), whole) << noise;
    EXPECT_GT(pieces, 1) << noise;
  }
}

// A picture that was clean when shown dark is sampled further when it is shown brighter, to the noise of a picture that
// was always judged at this exposure.
TEST(Resume, AtAnotherExposureBlocksAreJudgedAgain) {
  const Scene scene = load_scene("toys");
  const CpuRenderer renderer(scene);
  const StereoCamera camera;
  const auto sample = [&](PictureSamples& samples, float exposure) {
    RenderOptions options = options_with(1024, 0.01f);
    options.noise_exposure = exposure;
    renderer.sample({&camera, 1}, options, samples);
    return static_cast<double>(count_samples(samples));
  };
  PictureSamples lit = no_samples(options_with(1024, 0.01f));
  const double wanted = sample(lit, 4.0f);
  PictureSamples samples = no_samples(options_with(1024, 0.01f));
  const double dark = sample(samples, -6.0f);
  EXPECT_LT(dark, 0.8 * wanted) << "else this test shows nothing";
  EXPECT_EQ(sample(samples, -6.0f), dark);
  EXPECT_NEAR(sample(samples, 4.0f) / wanted, 1.0, 0.15);
}

TEST(Parts, AddUpToTheBitsOfOneRun) {
  const Scene scene = load_scene("toys");
  RenderOptions options = options_with(50, 0.0f);
  const uint64_t whole = digest(render_cpu(scene, StereoCamera{}, options));
  const CpuRenderer renderer(scene);
  const StereoCamera camera;
  const TemporaryFolder folder;
  std::vector<std::string> parts;
  for (const int number : {3, 1, 2}) {
    RenderOptions part = options;
    part.part = {number, 3};
    PictureSamples samples = no_samples(part);
    renderer.sample({&camera, 1}, part, samples);
    const SampledPicture about{{}, write_sidecar({camera, {part.width, part.height}}), 0.0f, ToneCurve::kNeutral, part};
    parts.push_back(save_part(folder.path(std::to_string(number) + ".exr"), about, samples));
  }
  EXPECT_EQ(digest(merge_parts(parts, options)), whole);
}

TEST(Parts, AreDisjointAndComplete) {
  RenderOptions options;
  options.samples = 50;
  int next = 0;
  for (int number = 1; number <= 7; number++) {
    options.part = {number, 7};
    const SampleRange range = samples_of_part(options);
    EXPECT_EQ(range.begin, next);
    EXPECT_GE(range.end, range.begin + 7);
    next = range.end;
  }
  EXPECT_EQ(next, 50);
}

}  // namespace
}  // namespace ods

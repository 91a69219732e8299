// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/render_passes.h"

#include <algorithm>

#include "ods/base/error.h"
#include "ods/kernel/random.h"
#include "ods/render/passes.h"
#include "ods/scene/catchers.h"

namespace ods {
namespace {

constexpr double kSliceSeconds = 2.0;  // seconds of work after which the samples can be stored

// Renders the rest of a pass.
void render_pass(PassDevice& device, const Pass& pass, PictureSamples& samples, const Progress& progress,
                 Keeper& keeper) {
  const int total = static_cast<int>(samples.noisy.size() * samples.eyes.size());
  int slice = keeper.wanted() ? device.blocks_at_once() : total;
  while (samples.blocks_done < total) {
    const double began = keeper.seconds();
    const int end = std::min(samples.blocks_done + slice, total);
    if (!device.render_blocks(pass, {samples.blocks_done, end}, progress, keeper.wanted())) {
      throw Error(ErrorKind::kCancelled, "rendering was stopped");
    }
    samples.blocks_done = end;
    const double took = std::max(keeper.seconds() - began, 1e-6);
    slice = std::clamp(static_cast<int>(slice * kSliceSeconds / took), 1 + slice / 2, 4 * slice);
    slice = std::max(slice, device.blocks_at_once());
    if (progress.cancelled && progress.cancelled()) {
      device.fetch();
      keeper.keep(samples);
      throw Error(ErrorKind::kCancelled, "rendering was stopped");
    }
    if (!keeper.is_due()) continue;
    device.fetch();
    keeper.keep(samples);
  }
  device.fetch();
  samples.done = samples.pass_to;
  samples.blocks_done = 0;
}

}  // namespace

void render_passes(PassDevice& device, const SamplingPlan& plan, const RenderOptions& options, PictureSamples& samples,
                   const Progress& progress, const KeepSamples& keep) {
  Keeper keeper(keep);
  Passes passes(options, samples.done);
  const auto judge = [&] {
    if (passes.can_judge()) passes.expect(judge_noise(plan, options, samples));
  };
  const bool has_begun = samples.pass_to > samples.done;  // an interrupted pass goes to the same blocks as it began
  if (!has_begun) judge();
  const bool stops = options.noise > 0.0f || options.time_limit > 0.0;
  while (samples.pass_to > samples.done || passes.next_step(keeper.seconds()) > 0) {
    if (samples.pass_to > samples.done) {
      passes.resume_step(samples.pass_to - samples.done);
    } else {
      samples.pass_to = samples.done + passes.step();
    }
    Progress part = progress;
    if (progress.report) part.report = [&](double done) { progress.report(passes.fraction(done, keeper.seconds())); };
    const double began = keeper.seconds();
    const SampleRange whole = stops ? SampleRange{samples.done, samples.pass_to} : SampleRange{0, options.samples};
    render_pass(device, {plan, samples.noisy, samples.done, samples.pass_to, whole}, samples, part, keeper);
    passes.finish_step(keeper.seconds() - began);
    judge();
  }
  if (progress.report) progress.report(1.0);
}

bool can_share(const StereoCamera& camera, const Scene& scene, const RenderOptions& options) {
  return shares_paths(options) && camera.lens_radius == 0.0f && !has_catchers(scene);
}

std::vector<Camera> cameras_of(std::span<const StereoCamera> path) {
  std::vector<Camera> cameras;
  for (const StereoCamera& each : path) cameras.push_back(make_camera(each));
  return cameras;
}

uint pixel_seed(const RenderOptions& options, int eye, int x, int y) {
  const uint pixel = static_cast<uint>(y * options.width + x);
  return hash_pair(hash_pair(options.seed, static_cast<uint>(eye)), pixel);
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/light/bake.h"

#include <fmt/format.h>

#include <cassert>
#include <filesystem>
#include <span>
#include <utility>

#include "ods/base/memory.h"
#include "ods/camera/stereo_camera.h"
#include "ods/denoise/denoise.h"
#include "ods/files/md5.h"
#include "ods/render/render_target.h"
#include "ods/render/unfinished.h"
#include "ods/sequence/finish_picture.h"
#include "ods/sequence/identity.h"

namespace ods {
namespace {

constexpr const char* kRemedy = "remove it to start over";

RenderOptions options_for(const BakeOptions& options, int width, int height) {
  RenderOptions render = options.render;
  render.layers = render.transparent = render.statistics = false;
  render = options_to_finish(render, options.is_denoised ? Denoiser::kOwn : Denoiser::kNone);
  return with_texels(render, width, height);
}

template <typename Value>
std::string digest(const std::vector<Value>& values) {
  const std::span bytes = std::as_bytes(std::span(values));
  return md5({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Settings identity_of(const TexelRays& rays, const BakeOptions& options, const RenderOptions& render) {
  Settings settings = options.scene;
  const Settings of_samples = render_settings(render);
  settings.insert(settings.end(), of_samples.begin(), of_samples.end());
  const vec3 viewer = options.viewer;
  settings.push_back({"viewer", fmt::format("{},{},{}", viewer.x, viewer.y, viewer.z), ""});
  settings.push_back({"rays", digest(rays.rays), ""});
  return settings;
}

// The samples that an earlier run has kept.
PictureSamples begin(const SampledPicture& about, const std::string& path) {
  std::error_code ignored;
  if (path.empty() || !std::filesystem::exists(path, ignored)) return no_samples(about.options);
  PictureSamples samples;
  expect_same_settings(path, read_unfinished(path, samples).settings, about.settings, kRemedy);
  return samples;
}

PictureSamples sampled(const Renderer& renderer, const StereoCamera& camera, const BakeOptions& options,
                       const RenderOptions& render, const Progress& progress) {
  SampledPicture about;
  about.options = render;
  KeepSamples keep;
  if (!options.unfinished.empty()) {
    about.settings = identity_of(*camera.texel_rays, options, render);
    keep = [&](const PictureSamples& now) { write_unfinished(options.unfinished, about, now); };
  }
  PictureSamples samples = begin(about, options.unfinished);
  renderer.sample(std::span(&camera, 1), render, samples, progress, keep, options.cells);
  if (keep && options.keeps_unfinished) keep(samples);
  return samples;
}

}  // namespace

size_t bake_bytes(int width, int height, const BakeOptions& options) {
  const size_t texels = static_cast<size_t>(width) * static_cast<size_t>(height);
  return picture_bytes(options_for(options, width, height)) + texels * (sizeof(TexelRay) + sizeof(int));
}

Image bake(const Renderer& renderer, const std::shared_ptr<const TexelRays>& rays, const BakeOptions& options,
           const Progress& progress) {
  assert(options.render.part.count == 1);
  const StereoCamera camera = texel_camera(rays, options.viewer);
  const RenderOptions render = options_for(options, rays->width, rays->height);
  check_memory(picture_bytes(render), fmt::format("a texture of {} x {}", rays->width, rays->height),
               "a smaller one needs less");
  const double rendered = options.is_denoised ? kShareOfRendering : 1.0;
  Picture picture = develop(sampled(renderer, camera, options, render, part_of(progress, 0.0, rendered)), render);
  if (options.is_denoised && has_variance(picture)) {
    denoise(picture, camera, {true, render.threads, {}, false}, part_of(progress, rendered, 1.0));
  }
  std::error_code ignored;
  if (!options.unfinished.empty() && !options.keeps_unfinished) std::filesystem::remove(options.unfinished, ignored);
  return std::move(picture.eyes[0].radiance);
}

}  // namespace ods

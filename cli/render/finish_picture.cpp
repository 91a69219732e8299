// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/finish_picture.h"

#include <algorithm>
#include <utility>

#include "cli/options/picture_options.h"
#include "ods/denoise/oidn.h"
#include "ods/picture/cryptomatte.h"
#include "ods/render/light_cache.h"

// A video's frames are .exr, but what is looked at is the video. One sample has no variance.
ods::Denoiser denoiser_of(const RenderJob& job) {
  const bool looked_at = job.time.is_video || !keeps_light(job.output);
  const auto denoiser = job.denoise.value_or(looked_at ? ods::Denoiser::kOwn : ods::Denoiser::kNone);
  return denoiser == ods::Denoiser::kOwn && job.render.samples == 1 ? ods::Denoiser::kNone : denoiser;
}

// An interrupted picture may have too few samples.
static bool has_variance(const ods::Picture& picture) {
  return std::ranges::any_of(picture.eyes, [](const ods::EyeImage& eye) {
    return std::ranges::any_of(eye.samples.pixels, [](float samples) { return samples > 1.0f; });
  });
}

ods::RenderOptions options_to_finish(const RenderJob& job) {
  ods::RenderOptions options = job.render;
  const ods::Denoiser denoiser = denoiser_of(job);
  const bool for_merge = job.part.has_value();
  options.layers |= denoiser != ods::Denoiser::kNone || for_merge;
  options.statistics |= denoiser == ods::Denoiser::kOwn || for_merge || job.save_unfinished;
  return options;
}

std::vector<std::string> finish_picture(const RenderJob& job, const ods::StereoCamera& camera, ods::Picture picture,
                                        const std::string& path, std::span<const ods::FrameBeside> beside,
                                        std::optional<ObjectLayer> objects) {
  ods::Denoiser denoiser = denoiser_of(job);
  if (denoiser == ods::Denoiser::kOwn && !has_variance(picture)) denoiser = ods::Denoiser::kNone;
  const bool keeps_raw = denoiser != ods::Denoiser::kNone && job.render.layers;
  if (keeps_raw) {
    for (ods::EyeImage& eye : picture.eyes) eye.raw = eye.radiance;
  }
  const bool keeps_statistics = job.render.statistics || (keeps_raw && denoiser == ods::Denoiser::kOwn);
  if (denoiser == ods::Denoiser::kOwn) {
    ods::denoise(picture, camera, {true, job.render.threads, beside, keeps_statistics});
  }
  if (denoiser == ods::Denoiser::kOidn) ods::denoise_with_oidn(picture, camera, job.render.threads);
  for (ods::EyeImage& eye : picture.eyes) {
    if (!job.render.layers) eye.depth = eye.normal = eye.albedo = ods::Image();
    if (!keeps_statistics) eye.variance = eye.samples = ods::Image();
  }
  ods::SaveOptions save = job.save;
  ods::RenderOptions options = job.render;
  options.width = picture.eyes[0].radiance.width, options.height = picture.eyes[0].radiance.height;
  const bool cached = ods::light_cache_paths(options) > 0;
  const ods::Indirect indirect = cached ? ods::Indirect::kCache : ods::Indirect::kPath;
  save.attributes.push_back({"ods:indirect", std::string(ods::indirect_name(indirect))});
  if (!objects) return ods::save_picture(picture, camera, save, path);
  ods::PictureRows rows = ods::rows_of(picture, true);
  ods::add_cryptomatte(rows, save, std::move(objects->numbers), objects->names);
  return ods::save_picture(rows, &camera, save, path);
}

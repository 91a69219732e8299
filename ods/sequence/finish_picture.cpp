// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/finish_picture.h"

#include <utility>

#include "ods/denoise/oidn.h"
#include "ods/picture/cryptomatte.h"
#include "ods/render/light_cache.h"

namespace ods {

RenderOptions options_to_finish(RenderOptions wanted, Denoiser denoiser) {
  wanted.layers |= denoiser != Denoiser::kNone;
  wanted.statistics |= denoiser == Denoiser::kOwn;
  return wanted;
}

std::vector<std::string> finish_picture(const FinishOptions& finish, const RenderOptions& wanted,
                                        const StereoCamera& camera, Picture picture, const std::string& path,
                                        std::span<const FrameBeside> beside, std::optional<ObjectLayer> objects) {
  Denoiser denoiser = finish.denoiser;
  if (denoiser == Denoiser::kOwn && !has_variance(picture)) denoiser = Denoiser::kNone;
  const bool keeps_raw = denoiser != Denoiser::kNone && wanted.layers;
  if (keeps_raw) {
    for (EyeImage& eye : picture.eyes) eye.raw = eye.radiance;
  }
  const bool keeps_statistics = wanted.statistics || (keeps_raw && denoiser == Denoiser::kOwn);
  if (denoiser == Denoiser::kOwn) denoise(picture, camera, {true, wanted.threads, beside, keeps_statistics});
  if (denoiser == Denoiser::kOidn) denoise_with_oidn(picture, camera, wanted.threads);
  for (EyeImage& eye : picture.eyes) {
    if (!wanted.layers) eye.depth = eye.normal = eye.albedo = Image();
    if (!keeps_statistics) eye.variance = eye.samples = Image();
  }
  SaveOptions save = finish.save;
  RenderOptions options = wanted;
  options.width = picture.eyes[0].radiance.width, options.height = picture.eyes[0].radiance.height;
  const Indirect indirect = light_cache_paths(options) > 0 ? Indirect::kCache : Indirect::kPath;
  save.attributes.push_back({"ods:indirect", std::string(indirect_name(indirect))});
  if (!objects) return save_picture(picture, camera, save, path);
  PictureRows rows = rows_of(picture, true);
  add_cryptomatte(rows, save, std::move(objects->numbers), objects->names);
  return save_picture(rows, &camera, save, path);
}

}  // namespace ods

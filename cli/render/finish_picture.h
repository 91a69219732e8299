// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// From a rendered picture to its files: denoised if the job wants it, saved.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/render/render_job.h"
#include "ods/denoise/denoise.h"
#include "ods/picture/picture.h"

// How the job's pictures are denoised: by its options, or by what they are for.
ods::Denoiser denoiser_of(const RenderJob& job);

// The options with the layers that saving the job's pictures needs, and denoising them.
ods::RenderOptions options_to_finish(const RenderJob& job);

// Which object each pixel of each eye shows; as in ods/picture/cryptomatte.h.
struct ObjectLayer {
  std::vector<ods::Image> numbers;
  std::vector<std::string> names;
};

// `picture` was rendered with options_to_finish(), or with more layers. beside: the frames beside it in a video.
// Returns the names of the files.
std::vector<std::string> finish_picture(const RenderJob& job, const ods::StereoCamera& camera, ods::Picture picture,
                                        const std::string& path, std::span<const ods::FrameBeside> beside = {},
                                        std::optional<ObjectLayer> objects = {});

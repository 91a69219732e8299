// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// From a rendered picture to its files: denoised if wanted, saved.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ods/denoise/denoise.h"
#include "ods/picture/picture.h"
#include "ods/picture/save.h"
#include "ods/render/render_options.h"

namespace ods {

struct FinishOptions {
  Denoiser denoiser = Denoiser::kOwn;
  SaveOptions save;
};

inline constexpr double kShareOfRendering = 0.97;  // of a denoised picture's time

// The options with the layers that the denoiser needs besides those that the file is to have.
RenderOptions options_to_finish(RenderOptions wanted, Denoiser denoiser);

// Which object each pixel of each eye shows; as in ods/picture/cryptomatte.h.
struct ObjectLayer {
  std::vector<Image> numbers;
  std::vector<std::string> names;
};

// `picture` was rendered with options_to_finish(), or with more layers; the files have those that are wanted. beside:
// the frames beside it in a video. Returns the names of the files. Throws as save_picture() and denoise().
std::vector<std::string> finish_picture(const FinishOptions& finish, const RenderOptions& wanted,
                                        const StereoCamera& camera, Picture picture, const std::string& path,
                                        std::span<const FrameBeside> beside = {},
                                        std::optional<ObjectLayer> objects = {});

}  // namespace ods

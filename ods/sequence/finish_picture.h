// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes the files of a rendered picture: denoises it if requested, and saves it.
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

inline constexpr double kShareOfRendering = 0.97;  // fraction of the time of a denoised picture

// Returns the options with the layers that the denoiser needs, in addition to the layers of the file.
RenderOptions options_to_finish(RenderOptions wanted, Denoiser denoiser);

// The object that each pixel of each eye shows, as in ods/picture/cryptomatte.h.
struct ObjectLayer {
  std::vector<Image> numbers;
  std::vector<std::string> names;
};

// `picture` was rendered with options_to_finish(), or with more layers; the files have the wanted layers. beside: the
// frames beside it in a video. Returns the names of the files. Throws as save_picture() and denoise() do.
std::vector<std::string> finish_picture(const FinishOptions& finish, const RenderOptions& wanted,
                                        const StereoCamera& camera, Picture picture, const std::string& path,
                                        std::span<const FrameBeside> beside = {},
                                        std::optional<ObjectLayer> objects = {});

}  // namespace ods

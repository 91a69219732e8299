// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The lights of a film in files, until all of them are finished.
#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "ods/base/progress.h"
#include "ods/layers/light/bake.h"

namespace ods {

// The files of a frame's light while a film is made: its samples so far, and the whole of it, from which the same call
// continues. path: BakeOptions::unfinished.
std::string unfinished_light(const std::string& path, size_t frame);
std::string finished_light(const std::string& path, size_t frame);

// The path for the lights of the still layers: 0 without what moves, frame + 1 of each frame.
std::string still_light_file(const std::string& path);

// Returns what bake() does. kept: a file for the result, which an interrupted film reads if it is that of the same
// rays, scene and options; no file if empty. Throws as bake() does.
Image kept_light(const Renderer& renderer, const std::shared_ptr<const TexelRays>& rays, const BakeOptions& options,
                 const std::string& kept, const Progress& progress = {});

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The light of a texture whose texels lie on a scene's surfaces, by path tracing on any device.
#pragma once
#include <memory>
#include <string>

#include "ods/base/progress.h"
#include "ods/base/settings.h"
#include "ods/camera/texel_rays.h"
#include "ods/image/image.h"
#include "ods/render/renderer.h"

namespace ods {

struct BakeOptions {
  RenderOptions render;     // size, eyes, filter and layers are set by bake()
  vec3 viewer{0.0f};        // as for texel_camera() (ods/camera/stereo_camera.h)
  bool is_denoised = true;  // each owner for itself
  // A light cache for several textures, from CpuRenderer::fill_cells() for a panorama from the viewer's place, with
  // Indirect::kCache, which only the CPU has. If not set, the texture fills a cache of its own.
  const LightCells* cells = nullptr;
  // A file for the samples so far (ods/render/unfinished.h). If it exists, bake() resumes from it, and the result has
  // the same bits as without an interruption. bake() removes it at the end, unless `keeps_unfinished`: then the same
  // call reads all of its samples. No file if empty.
  std::string unfinished;
  bool keeps_unfinished = false;
  Settings scene;  // identifies the scene and its lights for that file: scene_settings() (ods/sequence/identity.h)
};

// The memory for baking a texture, with its table of rays, bytes.
size_t bake_bytes(int width, int height, const BakeOptions& options);

// Returns the scene-linear radiance, 3 channels, of each texel: the mean over the texel, along its rays. Empty texels
// are black. Throws Error: kMemory before anything else; kUsage if the unfinished file belongs to another texture or
// other options, or for what the device cannot render (ods/render/gpu/gpu_lacks.h); kInput if that file is damaged;
// kOutput if it cannot be written; kDevice; kCancelled. Preconditions: that of texel_camera(); the options are for all
// parts of the samples; the scene has no catchers.
Image bake(const Renderer& renderer, const std::shared_ptr<const TexelRays>& rays, const BakeOptions& options,
           const Progress& progress = {});

}  // namespace ods

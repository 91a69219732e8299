// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/renderer.h"

#include "ods/render/render_target.h"

namespace ods {

Picture Renderer::render(const StereoCamera& camera, const RenderOptions& options, const Progress& progress) const {
  return render(std::span(&camera, 1), options, progress);
}

Picture Renderer::render(std::span<const StereoCamera> path, const RenderOptions& wanted,
                         const Progress& progress) const {
  const RenderOptions options = with_height(wanted, path[path.size() / 2]);
  check_picture_memory(options);
  PictureSamples samples = no_samples(options);
  sample(path, options, samples, progress);
  return develop(std::move(samples), options);
}

}  // namespace ods

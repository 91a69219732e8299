// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/comfortable_merge.h"

#include "ods/picture/picture.h"
#include "ods/render/render_target.h"

namespace ods {

static constexpr int kWidth = 512;

std::vector<float> shares_seen(const CpuRenderer& renderer, const StereoCamera& camera, float limit) {
  StereoCamera middle;
  middle.position = camera.position, middle.yaw = camera.yaw, middle.ipd = camera.ipd;
  RenderOptions options;
  options.width = kWidth;
  options.eyes = Eyes::kMonoEye;
  options = with_height(options, middle);
  const std::vector<Hit> hits = std::move(renderer.center_hits(middle, options)[0]);
  SeenDepth seen{middle, kMono, Image(options.width, options.height, 1), {}, {}};
  for (size_t i = 0; i < hits.size(); i++) seen.depth.pixels[i] = hits[i].t < 0.0f ? kFarDepth : hits[i].t;
  return comfortable_shares(seen, {}, limit);
}

}  // namespace ods

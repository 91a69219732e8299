// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods layers.
#pragma once
#include <optional>
#include <string>

#include "cli/render/render_job.h"
#include "ods/layers/file/write_layers.h"

struct LayersJob {
  RenderJob render;  // the scene, its light, the viewer's place, and the quality of the light
  std::optional<int> width;
  float box = 0.3f;
  std::string fallback;
  ods::WriteLayersOptions write;
};

LayersJob parse_layers(Options& options);

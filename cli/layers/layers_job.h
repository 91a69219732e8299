// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods layers.
#pragma once
#include <optional>
#include <string>

#include "cli/convert/depth_input.h"
#include "cli/render/render_job.h"
#include "ods/layers/file/write_layers.h"

struct LayersJob {
  RenderJob render;         // the scene, its light, the viewer's place, and the quality of the light
  bool is_picture = false;  // the scene is named by a picture with depth
  DepthInput depth;         // of the picture
  std::optional<int> width;
  float box = 0.3f;
  std::optional<int> light_every;  // frames between two lights of what moves
  std::string fallback;            // the name of the stereo picture beside the file, which is made if it does not exist
  bool is_page = false;            // the output is the folder of a web page
  std::string page_file;           // the name of its layered scene
  ods::WriteLayersOptions write;
};

LayersJob parse_layers(Options& options);

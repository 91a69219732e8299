// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods title.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/options/camera_options.h"
#include "cli/options/picture_options.h"
#include "ods/compose/title.h"
#include "ods/picture/save.h"
#include "ods/render/render_options.h"

struct TitleJob {
  std::string text;
  std::string output;
  ods::TitleSetting title;
  ods::LetteringOptions lettering;
  std::optional<std::vector<int>> frames;
  std::optional<float> fps;                // by default 30
  std::optional<float> fade_in, fade_out;  // seconds; by default 0
  PictureForm form;
  ods::RenderOptions picture;  // only its size and eyes
  ods::SaveOptions save;
  CameraOptions camera;
};

TitleJob parse_title(Options& options);

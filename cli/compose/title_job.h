// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods title.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/options/camera_options.h"
#include "ods/compose/title.h"
#include "ods/picture/save.h"
#include "ods/render/render_options.h"

struct TitleJob {
  std::string text;
  std::string output;
  ods::TitleSetting title;
  ods::LetteringOptions lettering;
  std::optional<std::vector<int>> frames;
  float fps = 30.0f;
  float fade_in = 0.0f;  // seconds
  float fade_out = 0.0f;
  ods::RenderOptions picture;
  ods::SaveOptions save;
  CameraOptions camera;
};

// False if help was requested. Throws UsageError and ods::Error.
bool read_title_job(TitleJob& job, int argc, char** argv);

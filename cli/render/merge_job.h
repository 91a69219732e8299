// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods merge.
#pragma once
#include <string>
#include <vector>

#include "cli/render/render_job.h"
#include "ods/render/unfinished.h"

struct MergeJob {
  std::vector<std::string> parts;  // files, in the order of the parts' numbers
  ods::SampledPicture picture;     // whole
  ods::PictureSamples samples;     // to which the parts are added: none, or what an interrupted run has kept
  ods::StereoCamera camera;
  ods::Layout layout = ods::Layout::kTopBottom;  // as rendered
  RenderJob render;                              // how the picture is finished
};

// False if help was requested. Opens the files. Throws UsageError and ods::Error, if the parts do not make a picture.
bool read_merge_job(MergeJob& job, int argc, char** argv);

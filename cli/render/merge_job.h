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
  std::vector<std::string> parts;  // files, in the order of the parts' numbers; none: there are samples
  ods::SampledPicture picture;     // whole, with the layers that finishing it needs
  ods::PictureSamples samples;     // that an interrupted run has kept
  ods::StereoCamera camera;
  ods::Layout layout = ods::Layout::kTopBottom;  // as rendered
  RenderJob render;                              // how the picture is finished
  bool remove_parts = false;                     // when it is saved
};

// False if help was requested, or if nothing is left to do: the parts are gone, since they were merged. Opens the
// files. Throws UsageError and ods::Error, if the parts do not make a picture.
bool read_merge_job(MergeJob& job, int argc, char** argv);

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Parts of a picture of Cycles, as ods merge reads them.
#pragma once
#include "cli/cycles/cycles_picture.h"
#include "ods/render/picture_samples.h"

// The options of the sums of N parts, and of part.number: the mean of each part counts as one sample.
ods::RenderOptions options_of_parts(const ods::RenderOptions& picture);

// Renders picture.part. parts: the names of the files of its eyes; those that exist are not rendered. Throws as
// make_picture(); UsageError if the picture would be converted.
struct CyclesPart {
  ods::PictureSamples samples;
  CyclesPose pose;
};
CyclesPart make_part(CyclesSession& session, const CyclesPicture& picture, const ods::RenderOptions& options,
                     const ods::FrameNames& parts, const std::function<void(double)>& report);

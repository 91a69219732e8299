// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Judges a picture file: by its depth, or, if it has none, by matching its eyes.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/comfort/measured_eyes.h"
#include "ods/comfort/verdict.h"
#include "ods/picture/metadata/stereo_format.h"

namespace ods {

struct JudgePictureOptions {
  ComfortOptions comfort;
  FormatHint format;
  bool wants_light = false;    // for JudgedPicture::light
  std::string scratch_folder;  // as MediaOptions::scratch_folder
};

struct JudgedPicture {
  ComfortVerdict verdict;
  StereoCamera camera;                   // as recorded or as measured
  std::vector<Image> light;              // the colours of each eye, for heat.h: 3 channels, linear. Empty if it has
                                         // depth, and JudgePictureOptions::wants_light is false
  std::optional<MeasuredEyes> measured;  // set if it has depth, but its metadata lacks the placement of its eyes
  std::string why_matched;               // why its eyes were matched although it has depth; else empty
  std::vector<std::string> hidden;       // for a scene: things inside the viewing circle, which no ray hits
  std::vector<std::string> notes;        // for messages
  std::vector<std::string> warnings;
};

// Identifies the picture by its pixels if the metadata leaves layout or projection open. Throws Error(kInput)
// as open_media() and refuse_unlikely() do, and if the picture does not show distances; Error(kOutput), Error(kMemory)
// as Scratch does.
JudgedPicture judge_picture(const std::string& path, const JudgePictureOptions& options = {});

// Converts display-encoded grey, 1 channel, to linear light of 3 channels.
Image light_of(const Image& grey);

}  // namespace ods

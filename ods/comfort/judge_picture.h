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
  std::string scratch_folder;  // as OpenOptions::scratch_folder
};

struct JudgedPicture {
  ComfortVerdict verdict;
  StereoCamera camera;                   // as recorded or as measured
  std::vector<Image> light;              // the colours of each eye, for heat.h: 3 channels, linear; may be empty
  std::optional<MeasuredEyes> measured;  // if it has depth, but its metadata do not record how its eyes were placed
  std::string why_matched;               // why it was matched although it has depth; empty: it was not
  std::vector<std::string> hidden;       // of a scene: things within the viewing circle, which no ray can hit
  std::vector<std::string> notes;        // for messages
  std::vector<std::string> warnings;
};

// Pictures whose layout and projection their metadata leave open are identified by their pixels. Throws Error(kInput)
// as open_media() and refuse_unlikely() do, and if the picture does not show distances; Error(kOutput), Error(kMemory)
// as Scratch does.
JudgedPicture judge_picture(const std::string& path, const JudgePictureOptions& options = {});

// Converts display-encoded grey, 1 channel, to linear light of 3 channels.
Image light_of(const Image& grey);

}  // namespace ods

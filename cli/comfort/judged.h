// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods comfort judges, eye by eye, and the picture of its verdicts.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/comfort/comfort_job.h"
#include "ods/comfort/matched.h"
#include "ods/comfort/measured_eyes.h"

struct Judged {
  ods::SeenDepth seen;
  ods::Image light;  // what the heat is painted over: 3 channels, linear; may be empty if no picture is wanted
};

// How well eyes could be matched; as in ods::MatchedEyes.
struct MatchQuality {
  double share = 0.0, precision = 0.0, apart = 0.0;
};

struct Looked {
  ods::StereoCamera camera;  // of the scene or picture
  std::vector<Judged> eyes;
  std::optional<MatchQuality> match;  // of a picture without depth
  std::string why_matched;            // instead of judged by the depth that it has; may be empty
  std::vector<std::string> hidden;    // of a scene: what stands within the viewing circle, where no ray begins
  std::optional<ods::MeasuredEyes> measured{};  // of a picture with depth, but without a word of its eyes
};

// Throws UsageError and ods::Error.
Looked look_at_scene(const ComfortJob& job);
Looked look_at_picture(const ComfortJob& job);

// Grey as a display shows it, 1 channel, as light of 3 channels.
ods::Image light_of(const ods::Image& grey);

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints the results of ods probe.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/lint/players.h"

struct PictureReport {
  ods::FileInfo info;
  ods::StereoFormat format;
  std::optional<ods::StereoCamera> gpano;
  std::string right_eye;  // of a Cardboard photo: "64x32", or its fault
};

// Of a video or a picture.
struct ProbeReport {
  std::string path;
  std::optional<ods::VideoFile> video;
  std::optional<PictureReport> picture;
  std::vector<std::vector<ods::PlayerView>> views;  // per video track, or of the picture
  std::vector<std::vector<std::string>> warnings;   // likewise
};

void print_text(const ProbeReport& report);
void print_json(const ProbeReport& report);

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints the results of ods probe.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/identify/identify.h"
#include "ods/lint/players.h"

struct PictureReport {
  ods::FileInfo info;
  ods::StereoFormat format;
  std::optional<ods::StereoCamera> gpano;
  std::string right_eye;  // of a VR photo: "64x32", or its fault
};

// The report on a video or a picture.
struct ProbeReport {
  std::string path;
  std::optional<ods::VideoFile> video;
  std::string joined;  // how ods joins the pictures of two tracks; empty if it does not
  std::optional<PictureReport> picture;
  std::vector<std::vector<ods::PlayerView>> views;  // per video track, or of the picture
  std::vector<std::vector<std::string>> warnings;   // per track, or of the picture
  std::vector<std::optional<ods::Identity>> seen;   // for each file: by its pixels, if nothing else does
};

void print_text(const ProbeReport& report);
void print_json(const ProbeReport& report);

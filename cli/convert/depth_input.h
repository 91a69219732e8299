// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The depth file of a picture or video that ods convert reads.
#pragma once
#include <string>
#include <vector>

#include "cli/console/options.h"
#include "ods/depth/picture_depth.h"

struct DepthInput {
  std::string path;  // empty: there is none
  ods::DepthOptions options;
};

void add_depth_options(Options& options, DepthInput& depth);

// The options that need --depth.
std::vector<std::string> depth_option_names();

// Adds the depth to a picture, and prints notes. Throws as ods::add_depth() does.
void give_depth(const DepthInput& depth, ods::StoredPicture& picture);
void note_depth(const ods::DepthReport& report);

// Merges the poles by these shares of the eye distance (ods/comfort/merge_from_depth.h), and prints a note.
void use_shares(std::vector<float> shares, ods::StereoCamera& camera);

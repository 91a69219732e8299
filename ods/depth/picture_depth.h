// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Adds the depth from a separate file to a picture: as its layer Z, metres along each pixel's ray, as a renderer
// writes it. All functions that use depth then work on the picture.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/depth/depth_file.h"
#include "ods/depth/depth_format.h"
#include "ods/picture/stored_picture.h"

namespace ods {

struct DepthOptions {
  DepthFormat format;
  DepthEdges edges = DepthEdges::kSharp;
  std::optional<float> eye_height;  // metres above the floor; determines the scale
  std::optional<double> scale;      // used instead of eye_height if already known
};

// The results of adding depth.
struct DepthReport {
  std::vector<std::string> notes, warnings;
  double scale = 1.0;  // factor by which depth was multiplied
};

// Adds a depth layer without pixels, or replaces the existing one; for headers.
void promise_depth(StoredPicture& picture);

// Reads the depth of each eye. A path with %V or %v is a file per eye; otherwise two eyes share a file in the picture's
// layout, or one above the other. Throws like read_depth_numbers().
std::vector<DepthNumbers> read_depth(const std::string& path, const StoredPicture& picture);

// Divides the depth of a file between the eyes. Throws Error(kInput) if it has one eye's depth for a picture of two.
std::vector<DepthNumbers> depth_of_eyes(DepthNumbers depth, const StoredPicture& picture);

// The factor by which depth must be multiplied so that its floor is eye_height below. Throws Error(kInput) if it shows
// no floor, and like add_depth(). Precondition: there is an eye height.
double scale_of(const DepthNumbers& depth, const StoredPicture& picture, const DepthOptions& options);

// Adds depth to a picture. Throws like nearness_of(); Error(kInput) for another aspect ratio than the picture's, or no
// floor for the eye height; Error(kUsage) for a picture of lenses, or depth along the axis for a picture without an
// axis. Precondition: a depth for each eye.
DepthReport add_depth(StoredPicture& picture, const std::vector<DepthNumbers>& depth, const DepthOptions& options);

}  // namespace ods

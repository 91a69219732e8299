// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Adds the depth from a separate file to a picture: as its layer Z, metres along each pixel's ray, as a renderer writes
// it. Everything that uses depth then works on the picture.
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
  std::optional<float> eye_height;  // metres above the floor, from which the scale follows
  std::optional<double> scale;      // known already: instead of eye_height
};

// What there is to say of it.
struct DepthReport {
  std::vector<std::string> notes, warnings;
  double scale = 1.0;  // by which depth was multiplied
};

// The picture will have depth: a layer without pixels, in place of one that it has. For headers.
void promise_depth(StoredPicture& picture);

// The depth of each eye. A path with %V or %v is a file per eye; else two eyes share a file as the picture's do, or one
// above the other. Throws as read_depth_numbers().
std::vector<DepthNumbers> read_depth(const std::string& path, const StoredPicture& picture);

// The same of a file that is read already. Throws Error(kInput): one eye's depth for a picture of two.
std::vector<DepthNumbers> depth_of_eyes(DepthNumbers depth, const StoredPicture& picture);

// By what depth must be multiplied so that its floor is eye_height below. Throws Error(kInput): it shows no floor; and
// as add_depth(). Precondition: there is an eye height.
double scale_of(const DepthNumbers& depth, const StoredPicture& picture, const DepthOptions& options);

// Throws as nearness_of(); Error(kInput): another shape than the picture's, no floor for the eye height; Error(kUsage):
// a picture of lenses, depth along the axis of a picture that has none. Precondition: a depth for each eye.
DepthReport add_depth(StoredPicture& picture, const std::vector<DepthNumbers>& depth, const DepthOptions& options);

}  // namespace ods

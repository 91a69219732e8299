// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Composites a picture with alpha over another, in linear light: titles and computer graphics over live action.
//
// The foreground is first converted to the background's projection, layout and size, as in convert(), but its eyes do
// not move: from the background's eyes it would appear at wrong distances. over_warnings() reports that.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ods/convert/convert.h"

namespace ods {

struct OverOptions {
  bool by_depth = false;  // decide per pixel by depth; else the foreground is in front
  float opacity = 1.0f;   // the foreground's opacity
};

// The reason why the pictures cannot be composited, for messages. Empty if they can.
std::string over_fault(const StoredPicture& foreground, const StoredPicture& background, const OverOptions& options);

// Differences between the two cameras, for messages: eye positions or pole merges.
std::vector<std::string> over_warnings(const StoredPicture& foreground, const StoredPicture& background);

struct Overlay {
  PictureRows rows;  // in the background's format and with its layers; Z is the depth of the visible surface
  // Numbers of pixels filled so far that the foreground covers by more than half, and of those where it is farther away
  // than the covered surface. Counted only if both have depth and by_depth is off.
  std::shared_ptr<std::atomic<int64_t>> covered = std::make_shared<std::atomic<int64_t>>(0);
  std::shared_ptr<std::atomic<int64_t>> behind = std::make_shared<std::atomic<int64_t>>(0);
};

// Both pictures must outlive the last row. Precondition: no over_fault().
Overlay lay_over(const StoredPicture& foreground, const StoredPicture& background, const OverOptions& options);

// The foreground alone, fitted to the background: R, G, B, A, premultiplied linear light, scaled by the opacity. Same
// preconditions; the background's pixels are not read, only its format.
PictureRows fitted_foreground(const StoredPicture& foreground, const StoredPicture& background,
                              const OverOptions& options);

// A warning for use after all rows are filled. Empty if nothing is farther away than the surface it covers.
std::string behind_warning(const Overlay& overlay);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture with alpha before another: titles and computer graphics over live action, in linear light.
//
// The foreground comes into the background's form first, as convert() has it, but its eyes stay where they were: seen
// from other places than the background's, it would stand at other distances than it was made for. That is said.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ods/convert/convert.h"

namespace ods {

struct OverOptions {
  bool by_depth = false;  // what is farther than the background is behind it; else all is before it
  float opacity = 1.0f;   // of the foreground
};

// Why it cannot be laid over, in words for a message; empty: it can.
std::string over_fault(const StoredPicture& foreground, const StoredPicture& background, const OverOptions& options);

// What is suspicious of their eyes, in words for people: they stand elsewhere, or are merged otherwise.
std::vector<std::string> over_warnings(const StoredPicture& foreground, const StoredPicture& background);

struct Overlay {
  PictureRows rows;  // of the background's form, with its layers; Z is that of what is seen
  // Pixels filled so far that the foreground covers by more than half, and those of them that stand behind what they
  // cover; counted where both have depth and it does not decide.
  std::shared_ptr<std::atomic<int64_t>> covered = std::make_shared<std::atomic<int64_t>>(0);
  std::shared_ptr<std::atomic<int64_t>> behind = std::make_shared<std::atomic<int64_t>>(0);
};

// Both pictures stay where they are until the last row is filled. Precondition: no over_fault().
Overlay lay_over(const StoredPicture& foreground, const StoredPicture& background, const OverOptions& options);

// The foreground alone as it comes before the background, of which only the form counts: R, G, B, A, light multiplied
// by alpha, and both by the opacity. Likewise; the background's pixels are not asked for.
PictureRows fitted_foreground(const StoredPicture& foreground, const StoredPicture& background,
                              const OverOptions& options);

// In words for people, once its rows are filled; empty: nothing stands behind what it covers.
std::string behind_warning(const Overlay& overlay);

}  // namespace ods

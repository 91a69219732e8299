// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture with alpha before another: titles and computer graphics over live action, in linear light.
//
// The foreground comes into the background's form first, as convert() has it, but its eyes stay where they were: seen
// from other places than the background's, it would stand at other distances than it was made for. That is said.
#pragma once
#include <string>
#include <vector>

#include "ods/image/convert.h"

namespace ods {

struct OverOptions {
  bool by_depth = false;  // what is farther than the background is behind it; else all is before it
  float opacity = 1.0f;   // of the foreground
};

// Why it cannot be laid over, in words for a message; empty: it can.
std::string over_fault(const StoredPicture& foreground, const StoredPicture& background, const OverOptions& options);

// What is suspicious, in words for people: eyes elsewhere, another merge, things that stand behind what they cover.
// Reads both pictures' depths, where they have any.
std::vector<std::string> over_warnings(const StoredPicture& foreground, const StoredPicture& background);

// Of the background's form, with its layers; Z is that of what is seen. Both pictures stay where they are until the
// last row is filled. Precondition: no over_fault().
PictureRows lay_over(const StoredPicture& foreground, const StoredPicture& background, const OverOptions& options);

}  // namespace ods

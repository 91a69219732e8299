// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The correction of a picture's right eye (ConvertTarget::right), except for the positions of its pixels (panorama.h).
#pragma once
#include <span>
#include <string>

#include "ods/convert/convert.h"

namespace ods {

// The reason why the target's correction is impossible, for messages. Empty if it is possible.
std::string correction_fault(const StoredPicture& picture, const ConvertTarget& target);

// Returns whether the colours of the target's eye with this index change.
bool corrects_colors(const StoredPicture& picture, const ConvertTarget& target, int index);

// Corrects pixels with this many channels, which start with red, green and blue in linear light.
void correct_colors(const EyeCorrection& correction, size_t channels, std::span<float> pixels);

}  // namespace ods

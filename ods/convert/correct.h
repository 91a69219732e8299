// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The correction of a picture's right eye (ConvertTarget::right), except where its pixels are, which panorama.h knows.
#pragma once
#include <span>
#include <string>

#include "ods/convert/convert.h"

namespace ods {

// Why the target's correction is impossible, in words for a message; empty: it is not.
std::string correction_fault(const StoredPicture& picture, const ConvertTarget& target);

// Whether the colours of the target's eye of this index change.
bool corrects_colors(const StoredPicture& picture, const ConvertTarget& target, int index);

// Pixels of so many channels, of which the first are red, green and blue: linear light.
void correct_colors(const EyeCorrection& correction, size_t channels, std::span<float> pixels);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures and frames as cameras store them: fisheye circles anywhere in the file.
#pragma once
#include <string>

#include "ods/picture/stored_picture.h"

namespace ods {

// The lens whose circle touches the closer edges of an eye's picture.
FisheyeLens inscribed_lens(Extent eye, float fov);

// Gives the picture the lenses that the caller specifies (FormatHint::lenses, front_and_back), if any: its maps, and as
// its projection the front half or, if they look ahead and back, the whole sphere of one eye. Black bars
// (FormatHint::bars) become maps of the rest of the picture. shown: the size of an eye as players show it, which the
// circles are in. Throws Error(kInput) for circles outside the picture, or not two halves if they look ahead and back.
void take_lenses(StoredPicture& picture, const FormatHint& known, Extent shown, const std::string& path);

}  // namespace ods

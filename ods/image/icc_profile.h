// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads ICC profiles (ICC.1) through Little CMS, which only icc_profile.cpp uses.
#pragma once
#include <string>

#include "ods/image/color_space.h"

namespace ods {

// The colour space of a profile that is grey or consists of three curves and a matrix, like the profiles of displays,
// cameras and working spaces. For others (CMYK, look-up tables) and for damaged ones ColorSpace::fault has the reason.
ColorSpace read_icc_profile(const std::string& profile);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ICC profiles (ICC.1), through Little CMS (icc_profile.cpp alone knows it).
#pragma once
#include <string>

#include "ods/image/color_space.h"

namespace ods {

// The colour space of a profile that is grey or consists of three curves and a matrix, as those of displays, cameras
// and working spaces do. For others (CMYK, look-up tables) and for damaged ones ColorSpace::fault says why not.
ColorSpace read_icc_profile(const std::string& profile);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ICC profiles (ICC.1), through Little CMS (icc_profile.cpp alone knows it).
#pragma once
#include <string>

#include "ods/image/color_space.h"

namespace ods {

// The colour space that a profile describes, if it is grey or made of three curves and a matrix, as those of displays,
// cameras and working spaces are. For others (CMYK, look-up tables) and for damaged ones ColorSpace::fault says why.
ColorSpace read_icc_profile(const std::string& profile);

}  // namespace ods

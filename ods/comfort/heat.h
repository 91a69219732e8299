// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Verdicts as pictures: ok in grey, other levels in yellow, orange and red.
#pragma once
#include "ods/comfort/judge_picture.h"
#include "ods/picture/picture.h"

namespace ods {

// light: the colours of an eye, 3 channels, linear; levels: EyeComfort::levels, of the same size. Returns 3 channels,
// linear.
Image heat_of(const Image& light, const Image& levels);

// Applies heat_of() to all eyes. Precondition: the picture has its light.
Picture heat_picture(const JudgedPicture& judged);

}  // namespace ods

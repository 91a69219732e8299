// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A part of a picture's samples (RenderOptions::part) as an EXR. Every program shows it as the noisy picture that it
// is: two views, linear light. Other layers hold the exact sums: layer `sum.light` has the channels R0 R1 R2 G0 ... B2,
// the 64 bits of each number as three whole numbers of at most 22 bits, which floats hold exactly; sums of 32 bits have
// two. Header: ods:part "3/8", ods:samples (of the whole picture), ods:settings, ods:sidecar.
#pragma once
#include <string>
#include <vector>

#include "ods/render/unfinished.h"

namespace ods {

// Writes the file and returns its name. Throws as save_picture() (ods/picture/save.h).
std::string save_part(const std::string& path, const SampledPicture& picture, const PictureSamples& samples);

// What a part is of, from its header. Throws Error(kInput): unreadable, or not a part.
SampledPicture read_part_header(const std::string& path);

// Adds a part to `sum`, which is no_samples() of the whole picture's options or has other parts already. Throws
// Error(kInput), also if the part has not the options' layers; then `sum` is of no use any more.
void add_part(const std::string& path, const RenderOptions& options, PictureSamples& sum);

}  // namespace ods

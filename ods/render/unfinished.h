// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture that is being rendered, as a file: an interrupted rendering goes on from it.
//
// Bytes: "ods unfinished\n", the version of the format, the fields in the order of each_field() in the .cpp (numbers as
// in memory, little-endian; lists after their length), and the CRC-32 of all these.
#pragma once
#include <string>

#include "ods/base/settings.h"
#include "ods/image/tone.h"
#include "ods/render/picture_samples.h"

namespace ods {

// What the samples are of.
struct SampledPicture {
  Settings settings;      // everything that the picture depends on, in the caller's words
  std::string camera;     // as a sidecar (ods/picture/metadata/sidecar.h)
  float exposure = 0.0f;  // how a file for the screen is to be made of it
  ToneCurve tone = ToneCurve::kNeutral;
  RenderOptions options;  // those that no_samples() and develop() read; the others have their defaults
};

// Replaces the file as a whole or not at all. Throws Error(kOutput).
void write_unfinished(const std::string& path, const SampledPicture& picture, const PictureSamples& samples);

// Whether the file begins like one of these.
bool is_unfinished(const std::string& path);

// The samples fit the options. Throws Error(kInput): no such file, of another version of ods, damaged; Error(kMemory).
SampledPicture read_unfinished(const std::string& path, PictureSamples& samples);

}  // namespace ods

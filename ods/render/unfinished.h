// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The file of a picture that is being rendered, from which an interrupted rendering resumes.
//
// Bytes: "ods unfinished\n", the version of the format, the fields in the order of each_field() in the .cpp (numbers as
// in memory, little-endian; lists after their length), and the CRC-32 of all these.
#pragma once
#include <string>

#include "ods/base/settings.h"
#include "ods/image/tone.h"
#include "ods/render/picture_samples.h"

namespace ods {

// The picture that samples belong to.
struct SampledPicture {
  Settings settings;      // everything that the picture depends on, under the caller's names
  std::string camera;     // as a sidecar (ods/picture/metadata/sidecar.h)
  float exposure = 0.0f;  // for making a display-referred file of it
  ToneCurve tone = ToneCurve::kNeutral;
  RenderOptions options;  // those that no_samples() and develop() read; the others have their defaults
};

// Writes the file atomically. Throws Error(kOutput).
void write_unfinished(const std::string& path, const SampledPicture& picture, const PictureSamples& samples);

// Returns whether a file begins like an unfinished picture.
bool is_unfinished(const std::string& path);

// Reads an unfinished picture. The samples fit the options. Throws Error(kInput) if the file does not exist, was
// written by another version of ods or is damaged; Error(kMemory).
SampledPicture read_unfinished(const std::string& path, PictureSamples& samples);

}  // namespace ods

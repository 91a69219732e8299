// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A part of a picture's samples (RenderOptions::part) as an EXR. Every program shows it as a noisy picture: two views,
// linear light. Other layers contain the exact sums: layer `sum.light` has the channels R0 R1 R2 G0 ... B2, the 64 bits
// of each number as three whole numbers of at most 22 bits, which floats represent exactly; sums of 32 bits have two.
// Layer `sum.check` has each row's CRC-32. Header: ods:part "3/8", ods:samples (of the whole picture), ods:exposure
// (stops), ods:tone, ods:settings, ods:sidecar.
#pragma once
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/render/unfinished.h"

namespace ods {

// Writes the file and returns its name. Throws the same errors as save_picture() (ods/picture/save.h).
std::string save_part(const std::string& path, const SampledPicture& picture, const PictureSamples& samples);

// The picture that a part belongs to, from its header. Throws Error(kInput) if the file is unreadable or not a part.
SampledPicture read_part_header(const std::string& path);

// Reads the parts of one picture in bands of rows: no part is in memory as a whole.
class PartsReader {
 public:
  // options: of the whole picture, with the requested layers and statistics. Throws Error(kInput) if a part is
  // unreadable, has another size or other eyes, or lacks such layers.
  PartsReader(std::vector<std::string> paths, const RenderOptions& options);
  ~PartsReader();

  // The sum of rows begin .. end - 1 of all parts, as samples of a picture with that many rows. Throws Error(kInput).
  PictureSamples sum(int begin, int end);

 private:
  struct File;
  File open(const std::string& path) const;
  void add(const File& file, int begin, PictureSamples& band);

  std::vector<std::string> paths_;
  RenderOptions options_;
  std::vector<File> open_;  // open files for the first paths_; the others are opened for each band
  std::vector<std::byte> bytes_;
};

// The picture of all these parts: develop() of their sum. Needs the memory of the picture, and of bands of 16 rows, for
// any number of parts. Throws the same errors as PartsReader; Error(kMemory), Error(kCancelled).
Picture merge_parts(const std::vector<std::string>& paths, const RenderOptions& options, const Progress& progress = {});

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A part of a picture's samples (RenderOptions::part) as an EXR. Every program shows it as the noisy picture that it
// is: two views, linear light. Other layers hold the exact sums: layer `sum.light` has the channels R0 R1 R2 G0 ... B2,
// the 64 bits of each number as three whole numbers of at most 22 bits, which floats hold exactly; sums of 32 bits have
// two. Layer `sum.check` has each row's CRC-32. Header: ods:part "3/8", ods:samples (of the whole picture),
// ods:settings, ods:sidecar.
#pragma once
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/render/unfinished.h"

namespace ods {

// Writes the file and returns its name. Throws as save_picture() (ods/picture/save.h).
std::string save_part(const std::string& path, const SampledPicture& picture, const PictureSamples& samples);

// What a part is of, from its header. Throws Error(kInput): unreadable, or not a part.
SampledPicture read_part_header(const std::string& path);

// Parts of one picture, read in bands of rows: no part is in memory as a whole.
class PartsReader {
 public:
  // options: of the whole picture, with those layers and statistics that are wanted. Throws Error(kInput): unreadable,
  // of another size or other eyes, without such layers.
  PartsReader(std::vector<std::string> paths, const RenderOptions& options);
  ~PartsReader();

  // What rows begin .. end - 1 of all parts add up to, as samples of a picture of so many rows. Throws Error(kInput).
  PictureSamples sum(int begin, int end);

 private:
  struct File;
  File open(const std::string& path) const;
  void add(const File& file, int begin, PictureSamples& band);

  std::vector<std::string> paths_;
  RenderOptions options_;
  std::vector<File> open_;  // the first paths_; the others are opened for each band
  std::vector<std::byte> bytes_;
};

// The picture that all these parts amount to: develop() of their sum. Takes the memory of the picture, and of bands of
// 16 rows, however many parts there are. Throws as PartsReader; Error(kMemory), Error(kCancelled).
Picture merge_parts(const std::vector<std::string>& paths, const RenderOptions& options, const Progress& progress = {});

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the metadata of the pictures in a HEIF file (HEIC, AVIF). Source: ISO/IEC 23008-12, "Image File Format": item
// properties, entity groups, camera properties.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ods/files/file_input.h"

namespace ods {

struct HeifItems {
  uint32_t primary = 0;        // the picture that programs display
  std::vector<uint32_t> pair;  // pictures of the left and the right eye in its stereo group (ster); or empty
  std::string icc;             // its ICC profile; empty if it has none
  // Its colour primaries and transfer curve by ITU-T H.273 (nclx), if it has no profile.
  std::optional<std::array<uint16_t, 2>> color;
  float fov = 0.0f;       // field of view of its camera (cmin), horizontal degrees; 0 if unknown
  double baseline = 0.0;  // metres between the cameras of the pair (cmex); 0 if unknown
  int others = 0;         // pictures beside the eyes that are not shown: gain maps, depth maps
};

// Throws MalformedFile, also for pictures that contain themselves or more pictures than decoders can handle;
// Error(kInput).
HeifItems read_heif_items(const FileInput& file);

// Its Exif, a TIFF directory; an empty string if it has none. Throws like read_heif_items(), also for more than `most`
// bytes.
std::string read_heif_exif(const FileInput& file, uint64_t most);

}  // namespace ods

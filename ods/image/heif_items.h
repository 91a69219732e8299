// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a HEIF file (HEIC, AVIF) says of its pictures beside their pixels. Source: ISO/IEC 23008-12, "Image File
// Format": item properties, entity groups, camera properties.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ods/files/file_input.h"

namespace ods {

struct HeifItems {
  uint32_t primary = 0;        // the picture that programs show
  std::vector<uint32_t> pair;  // of its stereo group (ster): the left eye's picture and the right one's; or empty
  std::string icc;             // its ICC profile; empty: none
  // Its colour primaries and transfer curve by ITU-T H.273 (nclx), if it has no profile.
  std::optional<std::array<uint16_t, 2>> color;
  float fov = 0.0f;  // degrees across, of its camera (cmin); 0: unknown
};

// Throws MalformedFile, also for pictures that are made of each other or of more than decoders stand; Error(kInput).
HeifItems read_heif_items(const FileInput& file);

}  // namespace ods

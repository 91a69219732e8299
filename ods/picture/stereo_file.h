// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Picture files that are made for two eyes, by the end of their names.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "ods/base/names.h"

namespace ods {

enum class StereoFile {
  kVrPhoto,  // ods/picture/metadata/vr_photo.h
  kMpo,      // two JPEGs (ods/image/format/stereo_jpeg.h); the left one has GPano, if that can express its projection
  kSpatial,  // a spatial photo (ods/image/spatial_photo.h), always of windows
  kJps,      // a JPEG with a descriptor of its layout; without it, such a file is cross-eyed by custom
};

// Returns nullopt for other names. Letter case does not matter.
std::optional<StereoFile> stereo_file(const std::string& path);

// With its point: `.vr.jpg`.
std::string_view stereo_file_extension(StereoFile kind);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes a spatial photo: a HEIC of two pictures in a stereo group, with the cameras that took them. Sources: ISO/IEC
// 23008-12, "Image File Format" (`ster`, `cmin`, `cmex`); Apple, "Writing spatial photos". The boxes are those of a file
// that Apple's Image I/O wrote, which puts the cameras into boxes `uuid` with the contents of `cmin` and `cmex`.
#pragma once
#include <string>
#include <string_view>

namespace ods {

// Two equal cameras side by side which look in the same direction, each without distortion.
struct SpatialCameras {
  double fov = 0.0;       // of the whole picture, horizontal degrees, between 0 and 180
  double baseline = 0.0;  // metres between them
};

// left, right: HEICs of one picture in HEVC (`hvc1`) each. Metres become whole micrometres. exif: a TIFF directory, or
// empty. Throws MalformedFile for a file of another kind.
std::string make_spatial_photo(std::string_view left, std::string_view right, const SpatialCameras& cameras,
                               std::string_view exif = {});

}  // namespace ods

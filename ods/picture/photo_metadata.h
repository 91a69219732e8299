// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The metadata of a photo that do not describe its pixels, for a picture that is made from it.
#pragma once
#include <string>

#include "ods/picture/save.h"

namespace ods {

// Sets the options so that the picture `to` keeps the Exif of the picture `from` (date, place, camera, author) and the
// initial view of its GPano. Returns a note for users about what is lost: the Exif, if the format of `to` has no place
// for it; gain maps, depth maps and previews beside the eyes. Otherwise returns an empty string. Throws Error(kInput) if
// `from` cannot be read.
std::string keep_photo_metadata(const std::string& from, const std::string& to, SaveOptions& options);

}  // namespace ods

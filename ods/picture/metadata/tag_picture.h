// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Tags a picture file with its format without touching the pixels: GPano in JPEG, PNG and TIFF; the attributes of
// ods/picture/metadata/metadata.h in EXR, with `envmap` and `view` for one eye and `multiView` for two views.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/picture/metadata/stereo_format.h"

namespace ods {

// The tag to write.
struct PictureTag {
  StereoCamera camera;
  std::optional<Layout> layout;  // not set for one eye
  int eye = kMono;               // the eye, if there is only one
  bool has_camera = false;       // if false, only the camera's projection and orientation are known
};

// The size, and for EXR also channels and attributes. Parses the header itself, without an image library. Throws
// Error(kInput) if the file is not one of the four formats, or damaged.
FileInfo read_picture_header(const std::string& path);

// Completes `known` like find_format(); `guesses` receives the guesses. Throws Error(kInput), also if nothing
// determines the format (an ordinary photograph must not become a sphere), or if a picture of this size cannot have the
// layout.
PictureTag complete_tag(const FormatHint& known, const std::string& path, std::vector<std::string>& guesses);

// Writes the picture with this tag to `to`, which may be `path` itself: the complete new file then replaces it. Without
// a tag, removes the camera metadata. Everything else is kept, including other XMP. A sidecar beside `to` that belongs
// to it gets the projection and the orientation, too. Throws Error(kInput), also if the format does not support the tag
// (GPano supports one eye, lat-long or a part of it); Error(kOutput).
void tag_picture(const std::string& path, const std::string& to, const std::optional<PictureTag>& tag);

}  // namespace ods

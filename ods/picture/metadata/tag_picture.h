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
  std::optional<Layout> layout;  // none: one eye
  int eye = kMono;               // which eye, if only one
  bool has_camera = false;       // else only the camera's projection and orientation are known
};

// The size, and of an EXR channels and attributes. Parses the header itself, without an image library. Throws
// Error(kInput): not one of the four formats, or damaged.
FileInfo read_picture_header(const std::string& path);

// Completes `known` as find_format() does; `guesses` lists what was guessed. Throws Error(kInput), also if nothing
// tells what the picture shows (an ordinary photograph must not become a sphere), or if a picture of this size cannot
// have the layout.
PictureTag complete_tag(const FormatHint& known, const std::string& path, std::vector<std::string>& guesses);

// Writes the picture with this tag to `to`, which may be `path` itself: the complete new file then replaces it. Without
// a tag, removes the camera metadata. Everything else stays, including other XMP. A sidecar beside `to` that belongs to
// it gets the projection and the orientation, too. Throws Error(kInput), also if the format cannot hold the tag (GPano
// holds one eye, lat-long or a part of it); Error(kOutput).
void tag_picture(const std::string& path, const std::string& to, const std::optional<PictureTag>& tag);

}  // namespace ods

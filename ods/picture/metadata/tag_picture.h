// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture file made to say what it is, without its pixels being touched: GPano in JPEG, PNG and TIFF, the attributes
// of ods/picture/metadata/metadata.h in EXR, with `envmap` and `view` of one eye and `multiView` of two views.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/picture/metadata/stereo_format.h"

namespace ods {

// What it is to say.
struct PictureTag {
  StereoCamera camera;
  std::optional<Layout> layout;  // none: one eye
  int eye = kMono;               // which
  bool has_camera = false;       // else only projection and orientation of the camera are known
};

// Size, and of an EXR channels and attributes, from a header that is read byte by byte: no image library is needed.
// Throws Error(kInput): not one of the four formats, damaged.
FileInfo read_picture_header(const std::string& path);

// What is not known as find_format() has it; `guesses` gets what was guessed. Throws Error(kInput), also where nothing
// tells what the picture shows: an ordinary photograph must not become a sphere.
PictureTag complete_tag(const FormatHint& known, const std::string& path, std::vector<std::string>& guesses);

// Writes the picture with another tag into `to`, which may be `path` itself: a complete new file takes its place. No
// tag: one that says nothing of its camera. All else in it stays as it was, also what its XMP says besides. Throws
// Error(kInput), also where the format has no words for such a tag: GPano knows one eye, lat-long or a part of it;
// Error(kOutput).
void tag_picture(const std::string& path, const std::string& to, const std::optional<PictureTag>& tag);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Cardboard Camera VR photos (*.vr.jpg), the one still picture of two eyes that other programs know: a JPEG of the left
// eye, of lat-long or a part of it as its GPano says, with a JPEG of the right eye in its XMP (GImage). Sources:
// Google, "Cardboard Camera VR Photo Format"; Adobe, "XMP Specification Part 3", 1.1.3.1 (extended XMP).
//
// The right eye stands in base64 in GImage:Data, in extended XMP: a packet that is cut into segments, each with the MD5
// of the whole, its length and where in it the segment begins.
#pragma once
#include <optional>
#include <string>

#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/files/file_input.h"

namespace ods {

// Whether a name asks for such a photo: it ends in .vr.jpg, in capitals or not.
bool names_photo(const std::string& path);

// Whether a file says that it is one. Throws Error(kInput): there is no such file.
bool is_photo(const std::string& path);

// The JPEG of the right eye. Throws Error(kInput): the file has none, or it is cut short or damaged: segments that are
// missing, overlap or do not fit their MD5.
std::string read_right_eye(const std::string& path);

// Writes such a photo of two JPEGs, the left one without XMP, `size` large each. Precondition: fits_gpano() holds for
// the camera's projection. Throws Error(kOutput); Error(kInput): the right eye has more than 3 GiB.
void write_photo(const FileInput& left, const std::string& right, const StereoCamera& camera, Extent size,
                 AtomicFile& to);

}  // namespace ods

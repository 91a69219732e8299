// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// VR photos (*.vr.jpg) of the Cardboard Camera and of VR180 cameras, the only stereo still format that other programs
// support: a JPEG of the left eye, lat-long or a part of it according to its GPano, with a JPEG of the right eye in its
// XMP (GImage). Sources: Google, "Cardboard Camera VR Photo Format", and the photo writer of its VR180 camera
// application; Adobe, "XMP Specification Part 3", 1.1.3.1 (extended XMP).
//
// The right eye is base64 text in GImage:Data, in extended XMP: a packet split into segments, each with the MD5 of the
// whole packet, its length and the segment's offset. VR180 cameras write no GPano:ProjectionType, only the crop, and
// some programs change the packet without its MD5.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/files/file_input.h"

namespace ods {

// Returns whether the file is a VR photo according to its metadata: it embeds a JPEG, and its GPano specifies lat-long
// or no projection. A photo of another focus or with a depth map (GFocus, GDepth) is not one. Throws Error(kInput) if
// there is no such file.
bool is_photo(const std::string& path);

// The JPEG of the right eye. If its MD5 does not match, it is used anyway, with a message in `warnings`. A second right
// eye is ignored, also with a message. Throws Error(kInput) if there is none, or it is truncated or damaged, because
// segments are missing or overlap.
std::string read_right_eye(const std::string& path, std::vector<std::string>& warnings);

// Writes a photo from two JPEGs of `size`, the left one without XMP. Precondition: fits_gpano() holds for the camera's
// projection. Throws Error(kOutput); Error(kInput) if the right eye has more than 3 GiB.
void write_photo(const FileInput& left, const std::string& right, const StereoCamera& camera, Extent size,
                 AtomicFile& to);

}  // namespace ods

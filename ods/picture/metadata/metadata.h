// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes and reads the camera in a picture file's header: our attributes in EXR files, and Google's "Photo Sphere XMP
// Metadata" (GPano) in display-referred formats, which has no information about eyes, merges and depth. save_picture()
// and tag_picture() write it, find_format() reads it (stereo_format.h).
//
// The attributes are those of ods/camera/camera_fields.cpp where they matter to the picture, ods:projection,
// ods:mirrored, ods:headTilt and ods:mergeCurve. All round-trip bit for bit, except head-tilt maps and merge maps that
// vary around: the file has only the word "map", and a sidecar contains them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/format/attribute.h"
#include "ods/image/image_file.h"

namespace ods {

void add_camera(std::vector<Attribute>& attributes, const StereoCamera& camera);

// The camera that a file's attributes describe, or nullopt. Invalid attributes add a message to `warnings` and are
// ignored, and so are the camera's other attributes. maps: a camera with the maps that the file only mentions, or
// nullptr.
std::optional<StereoCamera> camera_of(const FileInfo& info, std::vector<std::string>& warnings,
                                      const StereoCamera* maps = nullptr);

// Returns whether this file's camera merges by a map that is not available.
bool lacks_merge_map(const FileInfo& info, const StereoCamera& camera);

// GPano supports mono lat-long: the whole sphere, or a part that does not cross the seam.
bool fits_gpano(const ProjectionSetting& projection);

// Adds GPano for a picture of one eye of this size. Precondition: fits_gpano().
void add_gpano(std::vector<Attribute>& attributes, const StereoCamera& camera, Extent size);

// The projection and orientation in an XMP packet's GPano, as attributes or as elements. VR180 cameras omit the
// ProjectionType; then the crop's six numbers show that it is lat-long.
std::optional<StereoCamera> gpano_camera(const std::string& xmp);

// The part of a lat-long that a picture is by its place in a larger one (pixel_place.h), as panorama stitchers store it.
// Returns nullopt if it has none, or the larger one is not twice as wide as high.
std::optional<StereoCamera> placed_camera(const FileInfo& info);

// Sets the orientation in GPano, for any projection; 0 if it has none.
void read_gpano_pose(const std::string& xmp, StereoCamera& camera);

}  // namespace ods

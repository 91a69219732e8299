// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera in a picture file's header, both ways: our attributes in EXR files, and Google's "Photo Sphere XMP
// Metadata" (GPano) in those of a display.
//
// ods:projection, ods:ipd, ods:position, ods:yaw, ods:pitch, ods:roll, ods:poleMergeTop and -Bottom (with Start, End,
// Exponent) always stand there; ods:longitude and ods:latitude of a part of the sphere, ods:fov and ods:look (pan,
// tilt) of a lens, ods:aspect of a window, ods:convergence (with Distance), ods:neck, ods:axis, ods:lens (radius,
// focus), ods:mirrored where they are not those of the plain camera. All come back bit for bit, but for merge maps,
// which only a sidecar holds.
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

// The camera that the attributes of a file describe; nothing where there is none. What is wrong with them, in words for
// people, goes into `warnings`, and the rest of them are left aside.
std::optional<StereoCamera> camera_of(const FileInfo& info, std::vector<std::string>& warnings);

// GPano knows lat-long, whole or a part that does not cross the seam, and no stereo.
bool fits_gpano(const ProjectionSetting& projection);

// Of a picture of one eye, `size` large. Precondition: fits_gpano().
void add_gpano(std::vector<Attribute>& attributes, const StereoCamera& camera, Extent size);

// The projection and orientation of a packet of XMP that has GPano in it, as attributes or as elements.
std::optional<StereoCamera> gpano_camera(const std::string& xmp);

}  // namespace ods

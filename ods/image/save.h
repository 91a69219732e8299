// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A rendered picture into files. The extension decides the format.
//
// png, jpg, jpeg, tif, tiff, webp hold what a display shows: exposure, tone curve, sRGB, 8 bits. hdr and exr hold the
// light of the scene as it was rendered: linear, Rec. 709, neither exposed nor toned. Squeezed eyes are squeezed in the
// scene's light, as if rendered with larger pixels; of two depths the nearer stays. No file holds NaN (it becomes 0)
// or infinity (it becomes the largest number of the format).
//
// exr holds 16-bit floats and adds to every eye Z (32 bits; metres along the ray from its own origin), N.X N.Y N.Z and
// albedo.R G B, and says how it was taken: chromaticities, ods:version, ods:projection, ods:layout, ods:ipd,
// ods:position, ods:yaw, ods:pitch, ods:roll, ods:poleMergeTop and -Bottom (with Start, End, Exponent), ods:depthType,
// and of what differs from the plain camera ods:longitude, ods:latitude, ods:fov, ods:look, ods:convergence (with
// Distance), ods:neck, ods:axis, ods:lens (radius, focus), ods:mirrored;
// a file of one eye also envmap and view. Multi-view follows "Storing Multi-View Images in OpenEXR Files", single part:
// `left` is the default view with R G B Z bare, and the view stands before the last word elsewhere: right.R, N.left.X,
// albedo.right.G.
//
// A file of one eye that can carry GPano (png, jpg, tif) does; a stereo one does not, because GPano knows no stereo and
// viewers would wrap both eyes around one sphere.
#pragma once
#include <string>
#include <vector>

#include "ods/image/camera_rig.h"
#include "ods/image/layout.h"
#include "ods/image/picture.h"
#include "ods/image/tone.h"

namespace ods {

struct SaveOptions {
  Layout layout = Layout::kTopBottom;  // of two eyes; %V or %v in the name means kSeparate, whatever stands here
  float exposure = 0.0f;               // EV: the light is multiplied by 2^exposure
  ToneCurve tone = ToneCurve::kNeutral;
  int jpeg_quality = 95;  // of jpg and webp, 1..100
  bool sidecar = false;   // picture.camera.json too (ods/image/camera_file.h)
};

// Throws Error(kOutput) where save_picture() would, as far as that can be known before rendering: unknown extension, a
// folder that is missing its write permission, a name that is a folder, a layout that does not fit, a size too large
// for the format. `eyes` as in EyeImage, `eye` the size of one. Leaves nothing on the disk.
void check_output(const std::string& path, const SaveOptions& options, const std::vector<int>& eyes, Extent eye);

// Whether a file of this name would hold depth, normal and albedo: exr does.
bool keeps_layers(const std::string& path);

// Writes one file, or one per eye, and the sidecar behind them; all of them complete, or none. Creates missing folders.
// Returns the names written.
// Layers that are empty are left out. Throws Error(kOutput). Precondition: one eye or two, all of one size, with light.
std::vector<std::string> save_picture(const Picture& picture, const CameraRig& rig, const SaveOptions& options,
                                      const std::string& path);

// The same of a picture whose camera is not known: the file says nothing of one.
std::vector<std::string> save_picture(const Picture& picture, const SaveOptions& options, const std::string& path);

}  // namespace ods

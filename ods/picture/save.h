// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Saves a rendered picture. The file extension selects the format.
//
// png, jpg, jpeg, tif, tiff, webp and heic are display-referred: exposure, tone curve, sRGB, 8 bits. hdr and exr contain the
// scene-linear light as rendered: Rec. 709, without exposure or tone curve. Eyes are squeezed in scene-linear light, as
// if rendered with larger pixels; of two depths the smaller one is kept. Files do not contain NaN (it becomes 0) or
// infinity (it becomes the largest number of the format).
//
// exr contains 16-bit floats and adds to every eye Z (32 bits; metres along the ray from its own origin), N.X N.Y N.Z
// and albedo.R G B, or the layers of a picture made by rows. Its header has chromaticities, ods:version, ods:layout,
// ods:depthType and the camera (ods/picture/metadata/metadata.h); for one eye also envmap and view. Multi-view follows
// "Storing Multi-View Images in OpenEXR Files", single part: `left` is the default view with bare R G B Z; in other
// channels the view comes before the last component: right.R, N.left.X, albedo.right.G.
//
// Alpha: png, tif and webp store unpremultiplied colours, exr premultiplied ones; jpg, hdr, heic and anaglyphs show
// the picture over black.
//
// A png, jpg or tif of one eye carries GPano. A stereo one does not, because GPano has no stereo and viewers would wrap
// both eyes around one sphere. Two eyes in NAME.vr.jpg, NAME.mpo, NAME.heic or NAME.jps become a file of that kind
// (ods/picture/stereo_file.h): all but the last one hold the eyes as pictures of their own, whatever the layout.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/format/attribute.h"
#include "ods/image/format/file_format.h"
#include "ods/image/format/sample_type.h"
#include "ods/image/tone.h"
#include "ods/picture/picture.h"

namespace ods {

struct SaveOptions {
  Layout layout = Layout::kTopBottom;  // for two eyes; %V or %v in the name overrides it with kSeparate
  float exposure = 0.0f;               // stops: the light is multiplied by 2^exposure
  ToneCurve tone = ToneCurve::kNeutral;
  int jpeg_quality = 95;              // jpg, webp and heic, 1..100
  bool rows_alone = false;            // exr: compresses each row separately, not 16 together
  bool has_checksum = false;          // exr: a checksum of its header (ods/image/format/exr_header.h)
  std::vector<Attribute> attributes;  // extra attributes for exr and png headers; GPano:* wherever there is GPano
  std::string exif;                   // jpg, png and heic: of the picture that this one was made of (ods/image/exif.h)
  bool sidecar = false;               // also write picture.camera.json; an existing one is rewritten anyway
};

// Throws the errors of save_picture() that are known before rendering. Error(kUsage): an unknown extension, an
// unsuitable layout, a size too large for the format, a projection (if known) that a VR photo does not support.
// Error(kOutput): a folder without write permission, a name that is a folder. `eyes` as in EyeImage, `eye` the size of
// one. Leaves nothing on the disk.
void check_output(const std::string& path, const SaveOptions& options, const std::vector<int>& eyes, Extent eye,
                  const ProjectionSetting* projection = nullptr);

// Returns whether a file of this name can contain depth, normal and albedo: only exr.
bool keeps_layers(const std::string& path);

// Returns whether a file of this name can contain alpha: all but jpg, hdr and heic.
bool has_alpha(const std::string& path);

// Returns whether a picture's files, one or one per eye, exist and are not empty, because some farms create empty ones
// beforehand.
bool is_saved(const std::string& path);

// Writes one file, or one per eye, then the sidecar; either all of them complete or none. Creates missing folders.
// Returns the names written. Skips empty layers. Throws like check_output(), and Error(kOutput). Precondition: one or
// two eyes of equal size, with radiance.
std::vector<std::string> save_picture(const Picture& picture, const StereoCamera& camera, const SaveOptions& options,
                                      const std::string& path);

// Saves without a known camera: the file has no camera metadata.
std::vector<std::string> save_picture(const Picture& picture, const SaveOptions& options, const std::string& path);

// A picture whose rows are generated while it is written, so that it is never in memory as a whole.
struct RowLayer {
  std::vector<std::string> channels;  // without a view prefix: R, G, B, perhaps A; Z; N.X, N.Y, N.Z
  LayerRule rule = LayerRule::kLight;
  SampleType sample = SampleType::kHalf;  // in an exr; kHalf or kFloat
};

struct PictureRows {
  Extent eye;
  std::vector<int> eyes;         // as in EyeImage
  std::vector<RowLayer> layers;  // the first is the colour, RGB or RGBA; formats without layers write only it
  // Fills row y of the eye with this index: all channels of all layers, pixel by pixel; linear light, premultiplied.
  // Called concurrently; for anaglyphs, pairs and squeezed eyes, rows may be out of order.
  std::function<void(int index, int y, std::span<float> row)> fill;
  std::function<void()> band_done;  // called between bands of rows, to free memory; may be empty
};

// The number of channels per pixel of a row.
size_t count_channels(const std::vector<RowLayer>& layers);

// Saves a picture made by rows. Without a camera the file has no camera metadata. When eyes are squeezed, a kNearest
// layer takes the pixel with the smallest first channel. Throws like the functions above, and errors of `fill`.
std::vector<std::string> save_picture(const PictureRows& picture, const StereoCamera* camera,
                                      const SaveOptions& options, const std::string& path);

// The bytes of a file with one eye, of this index, and without camera metadata. Throws as save_picture().
std::string eye_bytes(const PictureRows& picture, int index, FileFormat format, const SaveOptions& options);

}  // namespace ods

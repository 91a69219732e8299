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
// albedo.R G B, or whatever layers a picture made by rows has. It says how it was taken: chromaticities, ods:version,
// ods:layout, ods:depthType and the camera (ods/picture/metadata/metadata.h); a file of one eye also envmap and view.
// Multi-view follows "Storing Multi-View Images in OpenEXR Files", single part: `left` is the default view with R G B Z
// bare, and the view stands before the last word elsewhere: right.R, N.left.X, albedo.right.G.
//
// Alpha goes into png, tif and webp with colours not multiplied by it, into exr with colours that are; jpg, hdr and
// anaglyphs have the picture before black.
//
// A file of one eye that can carry GPano (png, jpg, tif) does; a stereo one does not, because GPano knows no stereo and
// viewers would wrap both eyes around one sphere. But NAME.vr.jpg of two eyes is a Cardboard photo: the left eye with
// GPano, the right one in it (ods/picture/metadata/vr_photo.h), whatever the layout.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/format/attribute.h"
#include "ods/image/format/sample_type.h"
#include "ods/image/tone.h"
#include "ods/picture/picture.h"

namespace ods {

struct SaveOptions {
  Layout layout = Layout::kTopBottom;  // of two eyes; %V or %v in the name means kSeparate, whatever stands here
  float exposure = 0.0f;               // EV: the light is multiplied by 2^exposure
  ToneCurve tone = ToneCurve::kNeutral;
  int jpeg_quality = 95;              // of jpg and webp, 1..100
  std::vector<Attribute> attributes;  // more words for the header of exr and png
  bool sidecar = false;               // also write picture.camera.json; an existing one is always rewritten
};

// Throws what save_picture() would, as far as that can be known before rendering. Error(kUsage): an unknown extension,
// a layout that does not fit, a size too large for the format, a projection (where it is known) that a Cardboard photo
// cannot hold. Error(kOutput): a folder without write permission, a name that is a folder. `eyes` as in EyeImage, `eye`
// the size of one. Leaves nothing on the disk.
void check_output(const std::string& path, const SaveOptions& options, const std::vector<int>& eyes, Extent eye,
                  const ProjectionSetting* projection = nullptr);

// Whether a file of this name would hold depth, normal and albedo: exr does.
bool keeps_layers(const std::string& path);

// Whether a file of this name can hold alpha: not of jpg and hdr.
bool has_alpha(const std::string& path);

// Whether a picture's files, one or one per eye, are there and not empty: some farms make empty ones beforehand.
bool is_saved(const std::string& path);

// Writes one file, or one per eye, and the sidecar behind them; all of them complete, or none. Creates missing folders.
// Returns the names written.
// Layers that are empty are left out. Throws as check_output(), and Error(kOutput). Precondition: one eye or two, all
// of one size, with light.
std::vector<std::string> save_picture(const Picture& picture, const StereoCamera& camera, const SaveOptions& options,
                                      const std::string& path);

// The same of a picture whose camera is not known: the file says nothing of one.
std::vector<std::string> save_picture(const Picture& picture, const SaveOptions& options, const std::string& path);

// A picture whose rows are made while it is written, so that it is never in memory as a whole.
struct RowLayer {
  std::vector<std::string> channels;  // without a view: R, G, B, perhaps A; Z; N.X, N.Y, N.Z
  LayerRule rule = LayerRule::kLight;
  SampleType sample = SampleType::kHalf;  // in an exr; kHalf or kFloat
};

struct PictureRows {
  Extent eye;
  std::vector<int> eyes;         // as EyeImage has them
  std::vector<RowLayer> layers;  // the first is the colour, RGB or RGBA; formats without layers take only it
  // Row y of one eye (of the vector above): all channels of all layers, pixel by pixel; linear light, multiplied by its
  // alpha. Called by several threads at once; of anaglyphs, pairs and squeezed eyes not in the order of the rows.
  std::function<void(int index, int y, std::span<float> row)> fill;
  std::function<void()> band_done;  // called between some rows, to give memory back; may be empty
};

// Of a pixel of a row.
size_t count_channels(const std::vector<RowLayer>& layers);

// The same of such a picture. No camera: the file says nothing of one. Squeezed eyes take of a kNearest layer, of the
// pixels that become one, that whose first channel is least. Throws as above, and what `fill` throws.
std::vector<std::string> save_picture(const PictureRows& picture, const StereoCamera* camera,
                                      const SaveOptions& options, const std::string& path);

}  // namespace ods

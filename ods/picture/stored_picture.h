// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture file, ours or another program's, opened for reading its eyes pixel by pixel in any order, whatever its
// size. The samples stay as the file has them, in memory or, where that would take too much of it, in an unlinked
// scratch file. load_eyes.h is for pictures that fit into memory as floats.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/stereo_format.h"
#include "ods/picture/picture.h"

namespace ods {

class Scratch;

// Some channels of one eye. Pixels lie pixel_stride bytes apart, rows row_stride: eyes that share an image are views
// into it.
struct LayerPixels {
  std::vector<std::string> channels;  // without the name of the view: R, G, B, perhaps A; Z; N.X, N.Y, N.Z
  LayerRule rule = LayerRule::kLight;
  SampleType sample =
      SampleType::kUint8;  // kUint8, kUint16: sRGB code values but for alpha; kHalf, kFloat: light or numbers
  const std::byte* first = nullptr;
  ptrdiff_t pixel_stride = 0;
  ptrdiff_t row_stride = 0;
};

struct StoredEye {
  int eye = kMono;                  // kLeft, kRight or kMono
  std::vector<LayerPixels> layers;  // the first is the colour
};

struct StoredPicture {
  Extent size;                  // of every eye as it is stored; squeezed eyes stay squeezed
  std::vector<StoredEye> eyes;  // one, or left and right; of the same layers
  bool is_float = false;        // the file holds light; else what a display shows
  Layout layout = Layout::kSeparate;
  std::string layout_reason;         // how that is known: "its name ends in _TB"
  StereoCamera camera;               // how it was taken, as far as is known: projection, ipd, merge, convergence, pose
  bool has_ipd = false;              // by the caller, the file or its sidecar; else it is the usual one
  std::string rig_mark;              // ods:rig: the rig of slits that it is a view of; empty: not said
  std::vector<std::string> guesses;  // what the file did not say, to be said to people: "top-bottom: ..."
  std::string color_fault;           // why what it says of its colours is ignored; empty: it is honoured
  std::shared_ptr<Scratch> memory;   // where the pixels lie
};

struct OpenOptions {
  FormatHint format;
  bool color_only = false;     // no layers but the colour
  std::string scratch_folder;  // where pixels lie that take more than `most_in_memory` bytes; empty: all is memory
  size_t most_in_memory = size_t{512} << 20;
};

// Colour is R, G, B and perhaps A, grey made three; where it has no bare names, the layer that ends in Combined. The
// colours of kUint8 and kUint16 are code values that are not multiplied by alpha: who decodes them multiplies. Those of
// kHalf and kFloat are light that is. Both are of sRGB's primaries: files of other colour spaces are converted
// (image_file.h), and their 8 bits become 16.
//
// Of other channels, in EXR, those with one name before the last point are a layer. Its rule goes by name: kNearest are
// Z, depth, ids and materials, whole numbers, cryptomatte and variance (of which the nearest pixel's is an upper bound
// for a filtered one's, and a mean would be neither); all others kMean. In a file of two views, layers that only one of
// them has are left out, and a guess says so. Whole numbers are floats here, exact up to 2^24.
//
// Throws Error(kInput): a file that cannot be read or has no colour, an anaglyph, a size that the layout or the
// projection cannot have, eyes of two sizes; Error(kOutput), Error(kMemory) as Scratch.
StoredPicture open_picture(const std::string& path, const OpenOptions& options = {});

// The same without pixels: those of every layer are nullptr. Faults that only reading the pixels shows are not found.
StoredPicture open_picture_header(const std::string& path, const OpenOptions& options = {});

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture file from any program, opened for random access to its eyes' pixels, at any size. The samples keep the
// file's format, in memory or, if they need too much, in an unlinked scratch file. load_eyes.h is for pictures that fit
// into memory as floats.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/direction_map.h"
#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/stereo_format.h"
#include "ods/picture/picture.h"

namespace ods {

class Scratch;

// Some channels of one eye. Pixels are pixel_stride bytes apart, rows row_stride: eyes that share an image are views
// into it.
struct LayerPixels {
  std::vector<std::string> channels;  // without the view's name: R, G, B, perhaps A; Z; N.X, N.Y, N.Z
  LayerRule rule = LayerRule::kLight;
  SampleType sample = SampleType::kUint8;  // kUint8, kUint16: sRGB code values, linear alpha; kHalf, kFloat: linear
  const std::byte* first = nullptr;
  ptrdiff_t pixel_stride = 0;
  ptrdiff_t row_stride = 0;
};

struct StoredEye {
  int eye = kMono;                  // kLeft, kRight or kMono
  std::vector<LayerPixels> layers;  // the first is the colour
};

struct StoredPicture {
  Extent size;                  // size of each eye as stored; squeezed eyes remain squeezed
  std::vector<StoredEye> eyes;  // one, or left and right, with the same layers
  bool is_float = false;        // scene-linear; else display-encoded
  Layout layout = Layout::kSeparate;
  std::string layout_reason;  // the source of the layout: "its name ends in _TB"
  StereoCamera camera;        // the known parts: projection, ipd, merge, convergence, pose
  // The mapping of a camera's eyes if they are not in a projection: one map for each eye. `camera` then has the
  // lat-long of the same directions.
  std::vector<std::shared_ptr<const DirectionMap>> maps;
  bool front_and_back = false;       // with maps: the eyes, both kMono, are the two lenses of a camera of one eye
  bool has_ipd = false;              // known from caller, file or sidecar; else the default
  std::string rig_mark;              // ods:rig: the slit rig that this view belongs to; empty if unspecified
  std::vector<Attribute> mattes;     // cryptomatte/*: the meaning of the numbers in its layers; needed for a copy
  std::vector<std::string> guesses;  // guesses, for messages: "top-bottom: ..."
  std::string color_fault;           // the reason why the file's colour space is ignored; empty if it is used
  std::shared_ptr<Scratch> memory;   // owns the pixels
};

struct OpenOptions {
  FormatHint format;
  bool color_only = false;     // skip all other layers
  std::string scratch_folder;  // for pixels beyond `max_in_memory` bytes; if empty, all are kept in memory
  size_t max_in_memory = size_t{512} << 20;
};

// Colour is R, G, B and perhaps A, and grey is expanded to three channels; without bare names, it is the layer whose
// name ends in Combined. Integer colours are sRGB with unpremultiplied alpha; float colours are linear and
// premultiplied. Both have sRGB's primaries: files of other colour spaces are converted (image_file.h), 8 bits to 16.
//
// In an EXR the other channels form layers by the part of their names before the last dot. A layer's name determines
// its rule: kNearest for Z, depth, ids and materials, whole numbers, cryptomatte and variance (the nearest pixel's
// variance is an upper bound for a filtered pixel; the mean is not), kMean for the rest. In a file of two views, layers
// that only one view has are skipped, with a note in `guesses`. Whole numbers become floats, exact up to 2^24.
//
// Throws Error(kInput) for an unreadable file, no colour, an anaglyph, a size that does not fit the layout or
// projection, eyes of unequal size; Error(kOutput), Error(kMemory) like Scratch.
StoredPicture open_picture(const std::string& path, const OpenOptions& options = {});

// open_picture() in two steps, for callers that handle the pixels depending on the header. The file is opened and
// checked once. Both steps throw the same errors as open_picture().
class PictureReader {
 public:
  explicit PictureReader(const std::string& path, const OpenOptions& options = {});
  // Opens a file whose format is still unknown: only info(), whole() and set_format() may be called.
  static PictureReader without_format(const std::string& path, const OpenOptions& options);
  ~PictureReader();
  PictureReader(PictureReader&& other) noexcept;
  PictureReader& operator=(PictureReader&& other) noexcept;

  // The header of the file; of two files, of the left one.
  const FileInfo& info() const;

  // The picture without pixels: the pointers of every layer are nullptr. Faults that only the pixels show are not found
  // yet.
  const StoredPicture& header() const;

  // The colours of the file (of the first one of two) as one eye, whatever its layout. Decodes the picture, which
  // read() then does not do again.
  StoredPicture whole();
  bool is_decoded() const;

  // Replaces OpenOptions::format, and with it the header. Throws the same errors as open_picture(). After whole(), only
  // a VR photo is decoded again, and the format must not become Layout::kMultiview.
  void set_format(const FormatHint& known);

  // The picture with its pixels. It may have fewer layers than the header: those with numbers too large for a float are
  // left out. `scratch_folder` replaces OpenOptions::scratch_folder. Precondition: not called before.
  StoredPicture read(const std::string& scratch_folder);

  // Reads only the wanted channels, by their names in LayerPixels, as if the layers had no others: the rest needs no
  // memory. A layer without wanted channels stays as in the header. After whole(), all channels are there.
  using Wants = std::function<bool(const std::string& channel)>;
  StoredPicture read(const std::string& scratch_folder, const Wants& wants);

 private:
  struct State;
  explicit PictureReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace ods

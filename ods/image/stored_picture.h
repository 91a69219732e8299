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

#include "ods/image/camera_rig.h"
#include "ods/image/image_file.h"
#include "ods/image/layout.h"

namespace ods {

class Scratch;

enum class LayerRule {
  kLight,    // colour: averaged in linear light, alpha multiplied in
  kMean,     // numbers that may be averaged as they are: normals, albedo
  kNearest,  // never averaged: depth, ids, cryptomatte
};

// Some channels of one eye. Pixels lie pixel_stride bytes apart, rows row_stride: eyes that share an image are views
// into it.
struct LayerPixels {
  std::vector<std::string> channels;  // without the name of the view: R, G, B, perhaps A; Z; N.X, N.Y, N.Z
  LayerRule rule = LayerRule::kLight;
  Sample sample = Sample::kUint8;  // kUint8, kUint16: sRGB code values but for alpha; kHalf, kFloat: light or numbers
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
  std::vector<StoredEye> eyes;  // one, or left and right
  bool is_float = false;        // the file holds light; else what a display shows
  Layout layout = Layout::kSeparate;
  CameraRig rig;                     // how it was taken, as far as is known: projection, ipd, merge, convergence, pose
  std::vector<std::string> guesses;  // what the file did not say, to be said to people: "top-bottom, as it is square"
  std::shared_ptr<Scratch> memory;   // where the pixels lie
};

}  // namespace ods

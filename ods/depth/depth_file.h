// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The numbers of a depth picture as its file has them: any picture format, whose colour space is ignored, PFM and
// NumPy's .npy. Sources: Debevec's PFM as Netpbm documents it (netpbm.sourceforge.net/doc/pfm.html); NumPy, "NEP 1, a
// simple file format for NumPy arrays".
#pragma once
#include <string>

#include "ods/image/image.h"

namespace ods {

struct DepthNumbers {
  Image numbers;     // 1 channel, rows from the top; integers are 0..1 of their range
  int codes = 0;     // the largest integer that the file can hold; 0: floats
  std::string path;  // for messages
};

// Of an EXR the channel Z, or the one that ends in Depth.Z or Z; of others the first one. Throws Error(kInput): as
// open_picture(), a colourful picture, an array that is not of one number per pixel.
DepthNumbers read_depth_numbers(const std::string& path);

}  // namespace ods

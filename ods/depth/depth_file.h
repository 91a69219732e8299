// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The numbers of a depth picture, as stored in its file: any picture format, whose colour space is ignored, PFM and
// NumPy's .npy. Sources: Debevec's PFM as documented by Netpbm (netpbm.sourceforge.net/doc/pfm.html); NumPy, "NEP 1, a
// simple file format for NumPy arrays".
#pragma once
#include <string>

#include "ods/image/image.h"

namespace ods {

struct DepthNumbers {
  Image numbers;     // 1 channel, rows from the top; integers are 0..1 of their range
  int codes = 0;     // the maximum integer of the file; 0 for floats
  std::string path;  // for messages
};

// Reads the channel Z of an EXR, or the one that ends in Depth.Z or Z, and the first channel of other files. Throws
// Error(kInput) like open_picture(), and for a colourful picture, or an array without exactly one number per pixel.
DepthNumbers read_depth_numbers(const std::string& path);

}  // namespace ods

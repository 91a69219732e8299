// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads NumPy's .npy files with one number per pixel. Source: NumPy, "NEP 1, a simple file format for NumPy arrays".
#pragma once
#include "ods/files/file_input.h"
#include "ods/image/image.h"

namespace ods {

struct NpyArray {
  Image numbers;  // 1 channel; unsigned bytes and 16-bit words are 0..1 of their range, all others unchanged
  int codes = 0;  // the range; 0 if the numbers are unchanged
};

// Reads floats and integers of 1 to 8 bytes, in either byte order, rows or columns first. Axes of length 1 do not
// count. Throws Error(kInput) for other types, an array without exactly two axes, a damaged file.
NpyArray read_npy(const FileInput& file);

}  // namespace ods

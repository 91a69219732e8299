// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// NumPy's .npy files that hold one number per pixel. Source: NumPy, "NEP 1, a simple file format for NumPy arrays".
#pragma once
#include "ods/files/file_input.h"
#include "ods/image/image.h"

namespace ods {

struct NpyArray {
  Image numbers;  // 1 channel; unsigned bytes and 16-bit words are 0..1 of their range, all others as they are
  int codes = 0;  // that range; 0: the numbers are themselves
};

// Floats and integers of 1 to 8 bytes, in either order of bytes, rows or columns first. Axes of length 1 do not count.
// Throws Error(kInput): other types, an array that is not of two axes, a damaged file.
NpyArray read_npy(const FileInput& file);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How far one picture is from another. e is what b has more than a, in one channel of one pixel.
//
// Pixels that hold NaN or infinity in either picture are counted and left out of everything else.
#pragma once
#include <cstdint>
#include <vector>

#include "ods/image/image.h"

namespace ods {

struct LargestError {
  double error = 0.0;  // |e|; the first one in reading order
  int eye = 0;         // index in the picture
  int x = 0;
  int y = 0;
  int channel = 0;
};

// RMSE is sqrt(mean e^2), PSNR is 20 log10(1 / RMSE) dB: the signal's peak is 1, and equal pictures have infinity.
//
// WS-PSNR weighs row y of a lat-long picture of H rows by what it covers of the sphere, cos((y + 1/2 - H/2) pi / H), in
// place of the plain mean. Source: Y. Sun, A. Lu, L. Yu, "Weighted-to-Spherically-Uniform Quality Evaluation for
// Omnidirectional Video", IEEE Signal Processing Letters 24(9), 2017. It means nothing for other projections.
//
// NaN where no pixel could be compared.
struct Errors {
  double rmse = 0.0;
  double psnr = 0.0;
  double ws_psnr = 0.0;
  LargestError largest;
  int64_t not_finite = 0;  // pixels
};

struct Comparison {
  std::vector<Errors> eyes;
  Errors whole;  // every pixel of every eye
};

// Throws Error(kInput) in one line when the pictures differ in eyes, size or channels.
Comparison compare_eyes(const std::vector<Image>& a, const std::vector<Image>& b);

// b - a; 0 where a pixel is not finite. Precondition: one size.
Image difference(const Image& a, const Image& b);

// Whether e is no more than noise, for estimates whose variance is known: z = e / sqrt(variance of a + of b). Of
// unbiased pictures with independent noise mean is 0, rms 1 and beyond_3 0.0027 (for a normal distribution). Pixels of
// one picture are not quite independent where its filter is wider than a pixel; the three expectations still hold.
// Values that neither picture has variance for are left out, but counted where they differ.
struct ZTest {
  int64_t values = 0;
  double mean = 0.0;
  double rms = 0.0;
  double beyond_3 = 0.0;         // share of |z| > 3
  double largest = 0.0;          // |z|
  int64_t sure_differences = 0;  // no variance, yet e is not 0
};

// Precondition: four lists of one length, all images of one size.
ZTest z_test(const std::vector<Image>& a, const std::vector<Image>& b, const std::vector<Image>& variance_a,
             const std::vector<Image>& variance_b);

}  // namespace ods

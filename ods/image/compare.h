// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Measures the difference of two pictures: e = b - a, per channel and pixel.
//
// Pixels with NaN or infinity in either picture are counted, and excluded from everything else.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ods/image/image.h"

namespace ods {

struct LargestError {
  double error = 0.0;  // |e|; on ties the first in reading order
  int eye = 0;         // index in the picture
  int x = 0;
  int y = 0;
  int channel = 0;
};

// RMSE is sqrt(mean e^2). PSNR is 20 log10(1 / RMSE) dB, for a peak signal of 1; infinity for equal pictures.
//
// WS-PSNR replaces the plain mean by one that weights row y of a lat-long picture of H rows by the area it covers on
// the sphere, cos((y + 1/2 - H/2) pi / H). Source: Y. Sun, A. Lu, L. Yu, "Weighted-to-Spherically-Uniform Quality
// Evaluation for Omnidirectional Video", IEEE Signal Processing Letters 24(9), 2017. Not meaningful for other
// projections.
//
// NaN if no pixel could be compared.
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

// names: of the pictures, for messages. Throws Error(kInput), one line, if the pictures differ in number of eyes, size
// or channels.
Comparison compare_eyes(const std::vector<Image>& a, const std::vector<Image>& b,
                        const std::array<std::string, 2>& names = {"the first picture", "the second one"});

// b - a; 0 where a pixel is not finite. Precondition: equal sizes.
Image difference(const Image& a, const Image& b);

// Tests whether e is only noise, for estimates with known variance: z = e / sqrt(variance of a + of b). For unbiased
// pictures with independent noise, mean is 0, rms 1 and beyond_3 0.0027 (normal distribution). A filter wider than a
// pixel correlates adjacent pixels, but these three expectations still hold. Values without variance in either picture
// are excluded, but counted if they differ.
struct ZTest {
  int64_t values = 0;
  double mean = 0.0;
  double rms = 0.0;
  double beyond_3 = 0.0;         // fraction with |z| > 3
  double largest = 0.0;          // |z|
  int64_t sure_differences = 0;  // values without variance where e is not 0
};

// Precondition: four lists of equal length, all images of equal size.
ZTest z_test(const std::vector<Image>& a, const std::vector<Image>& b, const std::vector<Image>& variance_a,
             const std::vector<Image>& variance_b);

}  // namespace ods

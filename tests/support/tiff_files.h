// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// TIFF files in all variants, written by libtiff itself.
#pragma once
#include <tiffio.h>

#include <functional>
#include <string>
#include <vector>

namespace ods {

struct TiffForm {
  uint32_t width = 53;
  uint32_t height = 67;
  uint16_t samples = 3;  // per pixel
  uint16_t bits = 8;
  uint16_t format = SAMPLEFORMAT_UINT;
  uint16_t photometric = PHOTOMETRIC_RGB;
  uint16_t compression = COMPRESSION_NONE;
  uint16_t predictor = PREDICTOR_NONE;
  bool is_separate = false;
  uint32_t rows_per_strip = 16;
  uint32_t tile = 0;            // the side of its tiles; 0 for strips
  std::string mode = "w";       // and "l" or "b": its byte order, "8": BigTIFF
  std::vector<uint16_t> extra;  // the kinds of its extra samples
  std::function<void(TIFF*)> prepare;
};

size_t bytes_of_row(const TiffForm& form);  // bytes of all planes

// `pixels`: rows of packed bits, interleaved.
void write_tiff(const std::string& path, const TiffForm& form, const std::vector<std::byte>& pixels);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/tiff_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace ods {

size_t bytes_of_row(const TiffForm& form) {
  return (size_t{form.width} * form.samples * form.bits + 7) / 8;
}

static void set_fields(TIFF* tiff, const TiffForm& form) {
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, form.width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, form.height);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, form.bits);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, form.format);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, form.samples);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, form.photometric);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, form.is_separate ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, form.compression);
  if (form.predictor != PREDICTOR_NONE) TIFFSetField(tiff, TIFFTAG_PREDICTOR, form.predictor);
  if (form.compression == COMPRESSION_JPEG) TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
  if (!form.extra.empty()) {
    TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, static_cast<int>(form.extra.size()), form.extra.data());
  }
  if (form.tile > 0) {
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, form.tile);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, form.tile);
  } else {
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, form.rows_per_strip);
  }
  if (form.prepare) form.prepare(tiff);
}

// Rows of whole bytes, as libtiff requires for one plane.
static std::vector<std::byte> plane_of(const TiffForm& form, const std::byte* row, size_t plane) {
  const size_t size = form.bits / 8u;
  std::vector<std::byte> samples(form.width * size);
  for (size_t x = 0; x < form.width; x++) {
    std::memcpy(&samples[x * size], row + (x * form.samples + plane) * size, size);
  }
  return samples;
}

static void write_tiles(TIFF* tiff, const TiffForm& form, const std::vector<std::vector<std::byte>>& rows,
                        uint16_t plane) {
  const size_t pixel = rows[0].size() / form.width;
  for (uint32_t top = 0; top < form.height; top += form.tile) {
    for (uint32_t left = 0; left < form.width; left += form.tile) {
      std::vector<std::byte> tile(static_cast<size_t>(TIFFTileSize(tiff)));
      const size_t width = std::min(form.tile, form.width - left) * pixel;
      for (uint32_t y = top; y < std::min(top + form.tile, form.height); y++) {
        std::memcpy(&tile[(y - top) * form.tile * pixel], &rows[y][left * pixel], width);
      }
      ASSERT_GT(TIFFWriteTile(tiff, tile.data(), left, top, 0, plane), 0);
    }
  }
}

void write_tiff(const std::string& path, const TiffForm& form, const std::vector<std::byte>& pixels) {
  TIFFSetWarningHandler(nullptr);  // warns about old compressions
  TIFF* const tiff = TIFFOpen(path.c_str(), form.mode.c_str());
  ASSERT_NE(tiff, nullptr);
  set_fields(tiff, form);
  const size_t size = bytes_of_row(form);
  for (uint16_t plane = 0; plane < (form.is_separate ? form.samples : 1); plane++) {
    std::vector<std::vector<std::byte>> rows;
    for (size_t y = 0; y < form.height; y++) {
      const std::byte* row = &pixels[y * size];
      rows.push_back(form.is_separate ? plane_of(form, row, plane) : std::vector<std::byte>(row, row + size));
    }
    if (form.tile > 0) {
      write_tiles(tiff, form, rows, plane);
      continue;
    }
    for (uint32_t y = 0; y < form.height; y++) ASSERT_EQ(TIFFWriteScanline(tiff, rows[y].data(), y, plane), 1);
  }
  TIFFClose(tiff);
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// One picture file being decoded, whatever its format. A format's decoder is in the .cpp with its name.
#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ods/files/read_file.h"
#include "ods/image/format/file_format.h"
#include "ods/image/format/file_info.h"

namespace ods {

// The bytes of a picture, on disk or in memory.
struct PictureBytes {
  std::string name;     // for messages
  bool on_disk = true;  // then `name` is its path
  size_t size = 0;
  ByteReader read;  // may be called from several threads
};

// Throws Error(kInput), as read_file.h.
PictureBytes picture_on_disk(const std::string& path);
// The bytes must outlive what it returns.
PictureBytes picture_in_memory(std::span<const std::byte> bytes, const std::string& name);

class Decoder {
 public:
  virtual ~Decoder() = default;

  // Channels [first, first + count) of rows [begin, end), counted from the top, interleaved by pixel, in the types of
  // info.samples. Integers are the file's code values with unassociated alpha. Cheap if rows are asked for from the
  // top, each once. Throws Error(kInput).
  virtual void read(int begin, int end, size_t first, size_t count, std::byte* to) = 0;

  // What read() returns of a pixel.
  size_t bytes_of_pixel(size_t first, size_t count) const;
  // The height of bands that split nothing which the file packs together.
  int band_rows() const;

  // What the header says: color and color_fault are empty.
  FileInfo info;
  int rows_together = 1;                     // that the file packs together
  std::vector<bool> whole_numbers;           // by channel: 32-bit integers, which read() returns as floats; empty: none
  std::map<size_t, unsigned> beyond_floats;  // by channel: an integer above 2^24 that read() met
};

// Throw Error(kInput): the file is damaged or cannot be decoded. Their sizes are within image_limits.h. The first one
// finds the format by the file's first bytes.
std::unique_ptr<Decoder> open_decoder(const PictureBytes& file);
std::unique_ptr<Decoder> open_png(const PictureBytes& file);
// least_wide: reads it smaller than it is, but not narrower than this; 0: as it is.
std::unique_ptr<Decoder> open_jpeg(const PictureBytes& file, int least_wide = 0);
std::unique_ptr<Decoder> open_tiff(const PictureBytes& file);
std::unique_ptr<Decoder> open_webp(const PictureBytes& file);
std::unique_ptr<Decoder> open_hdr(const PictureBytes& file);
std::unique_ptr<Decoder> open_exr(const PictureBytes& file);
// view: 1 is the right eye of a pair (FileInfo::is_pair).
std::unique_ptr<Decoder> open_heif(const PictureBytes& file, int view);

// The picture as it is to be shown (ods/image/orientation.h).
std::unique_ptr<Decoder> turned(std::unique_ptr<Decoder> stored, int orientation);

// A picture of this size of which a part is stored, at this place, or more than all: zeros where nothing is.
std::unique_ptr<Decoder> windowed(std::unique_ptr<Decoder> stored, int left, int top, int width, int height);

// Throws Error(kInput) where a picture is larger than image_limits.h allows a file of this size to be. `tile`: the
// longer side of its tiles.
void check_picture_size(const PictureBytes& file, int width, int height, int tile = 0);

}  // namespace ods

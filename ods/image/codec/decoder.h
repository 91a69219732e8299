// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture file of any format that is being decoded. A format's decoder is in the .cpp with its name.
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
  bool on_disk = true;  // `name` is then its path
  size_t size = 0;
  ByteReader read;  // may be called from several threads
};

// Throws Error(kInput), like read_file.h.
PictureBytes picture_on_disk(const std::string& path);
// The bytes must outlive the result.
PictureBytes picture_in_memory(std::span<const std::byte> bytes, const std::string& name);

class Decoder {
 public:
  virtual ~Decoder() = default;

  // Channels [first, first + count) of rows [begin, end), counted from the top, interleaved by pixel, in the types of
  // info.samples. Integers are the file's code values with unassociated alpha. Fast if rows are read from the top, each
  // once. Throws Error(kInput).
  virtual void read(int begin, int end, size_t first, size_t count, std::byte* to) = 0;

  // The size of a pixel in the output of read().
  size_t bytes_of_pixel(size_t first, size_t count) const;
  // A height of bands that does not split rows which the file compresses together.
  int band_rows() const;

  // The header's data; color and color_fault are empty.
  FileInfo info;
  int rows_together = 1;                     // number of rows that the file compresses together
  std::vector<bool> whole_numbers;           // by channel: 32-bit integers, returned as floats; may be empty
  std::map<size_t, unsigned> beyond_floats;  // by channel: an integer above 2^24 that read() found
};

// Throw Error(kInput) if the file is damaged or cannot be decoded. Sizes are within image_limits.h. The first function
// detects the format from the file's first bytes.
std::unique_ptr<Decoder> open_decoder(const PictureBytes& file);
std::unique_ptr<Decoder> open_png(const PictureBytes& file);
// min_width: decodes it at a smaller size, but not narrower than this; 0 for full size.
std::unique_ptr<Decoder> open_jpeg(const PictureBytes& file, int min_width = 0);
std::unique_ptr<Decoder> open_tiff(const PictureBytes& file);
std::unique_ptr<Decoder> open_webp(const PictureBytes& file);
std::unique_ptr<Decoder> open_hdr(const PictureBytes& file);
std::unique_ptr<Decoder> open_exr(const PictureBytes& file);
// view: 1 is the right eye of a pair (FileInfo::is_pair).
std::unique_ptr<Decoder> open_heif(const PictureBytes& file, int view);

// The picture rotated for display (ods/image/orientation.h).
std::unique_ptr<Decoder> turned(std::unique_ptr<Decoder> stored, int orientation);

// A picture of this size, of which the stored one is a part at this position, or which is a part of the stored one.
// Zeros where nothing is stored.
std::unique_ptr<Decoder> windowed(std::unique_ptr<Decoder> stored, int left, int top, int width, int height);

// Throws Error(kInput) if a picture is larger than image_limits.h allows for a file of this size. `tile`: the longer
// side of its tiles.
void check_picture_size(const PictureBytes& file, int width, int height, int tile = 0);

}  // namespace ods

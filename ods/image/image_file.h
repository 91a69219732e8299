// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Image files of every format of file_format.h, read and written by image_codec().
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ods/files/atomic_file.h"
#include "ods/image/color_space.h"
#include "ods/image/format/attribute.h"
#include "ods/image/format/file_format.h"
#include "ods/image/format/file_info.h"
#include "ods/image/format/image_limits.h"
#include "ods/image/image.h"

namespace ods {

// Linear light of Rec. 709 in three channels, whatever the file's colour space is (color_tags.h); where the file does
// not say, integers are sRGB and floats linear Rec. 709. Grey becomes three equal channels, alpha is left out. What the
// file says of its colours and cannot be honoured goes into `color_fault`. Throws Error(kInput).
Image read_image(const std::string& path, std::string* color_fault = nullptr);

// Throws Error(kInput).
FileInfo read_info(const std::string& path);

// Reads a file in bands from the top, so that it is never in memory as a whole (except WebP, progressive JPEG and
// interlaced PNG, whose decoders know no other way). Colours of integer files are sRGB code values with unassociated
// alpha; a file of another colour space is converted to sRGB in 16 bits. Colours of float files are linear with
// associated alpha, in the primaries of the file: color_space() converts them. Whole numbers in a float file (ids,
// 32 bits) become floats.
class RowReader {
 public:
  virtual ~RowReader() = default;
  virtual const FileInfo& info() const = 0;
  virtual const ColorSpace& color_space() const = 0;

  // Reads 8-bit integers as 16-bit ones. Call it before the first read().
  virtual void widen() = 0;
  virtual bool is_whole_number(size_t channel) const = 0;

  // The height of a band, except the last: what the file packs together.
  virtual int band_rows() const = 0;

  // The first `channels` channels of rows begin..end, one sample after the other. Throws Error(kInput).
  virtual void read(int begin, int end, size_t channels, std::byte* to) = 0;

  // Channels in which a whole number above 2^24 was met, which no float can hold, and that number.
  virtual const std::map<size_t, unsigned>& beyond_floats() const = 0;
};

// Throws Error(kInput): as read_image(), and an EXR whose data window is not its whole picture.
std::unique_ptr<RowReader> open_rows(const std::string& path);

// Some channels of a file, by their names and in their order. Integers are decoded from sRGB, floats taken as they are.
// Throws Error(kInput), also where there is no such channel.
Image read_channels(const std::string& path, const std::vector<std::string>& names);

// 8 bits each of R, G, B, A with R in the low byte, rows from the top, alpha not multiplied in: the code values of the
// file, whatever colour space it says they are of: glTF wants that. What is missing is grey or opaque.
struct CodeImage {
  int width = 0;
  int height = 0;
  std::vector<uint32_t> pixels;
};

// A file in memory. `name` stands for it in messages. Throws Error(kInput).
CodeImage decode_image(std::span<const std::byte> file, const std::string& name);

struct Channel {
  std::string name;  // R, G, B; others only in EXR
  SampleType sample = SampleType::kUint8;
};

struct FileHeader {
  FileFormat format = FileFormat::kPng;
  int width = 0;
  int height = 0;
  std::vector<Channel> channels;
  std::vector<Attribute> attributes;  // names as OpenImageIO has them; GPano:* becomes XMP
};

// Fills row y with width * channels floats: 0..1 of the code range for integers, the value itself otherwise, of which
// floats_to_halves() makes halves.
// Called by several threads at once, every row once.
using RowSource = std::function<void(int y, std::span<float> row)>;

// Writes a whole image into a file that is not committed yet. Rows are made while those before them are compressed;
// between two bands of them `band_done` is called, where there is one. Throws Error(kOutput), and what `rows` throws.
void write_image(AtomicFile& file, const FileHeader& header, const RowSource& rows,
                 const std::function<void()>& band_done = {});

}  // namespace ods

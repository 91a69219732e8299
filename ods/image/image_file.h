// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads and writes image files of every format of file_format.h (ods/image/codec).
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ods/files/byte_sink.h"
#include "ods/image/color_space.h"
#include "ods/image/format/attribute.h"
#include "ods/image/format/file_format.h"
#include "ods/image/format/file_info.h"
#include "ods/image/format/image_limits.h"
#include "ods/image/image.h"

namespace ods {

// Reads an image as scene-linear Rec. 709 in three channels, for any colour space of the file (color_tags.h). If the
// file specifies none, integers are sRGB and floats are linear Rec. 709. Grey becomes three equal channels; alpha is
// dropped. `color_fault` receives the colour information of the file that is not supported. Throws Error(kInput).
Image read_image(const std::string& path, std::string* color_fault = nullptr);

// Throws Error(kInput).
FileInfo read_info(const std::string& path);

// Reads a file in bands from the top, so that it is never in memory as a whole (except WebP, HEIF, progressive JPEG and
// interlaced PNG, which must be decoded as a whole). Colours of integer files are sRGB code values with unassociated
// alpha; a file in another colour space is converted to sRGB in 16 bits. Colours of float files are linear with
// associated alpha, in the file's primaries: color_space() converts them. Integers in a float file (ids, 32 bits)
// become floats.
class RowReader {
 public:
  virtual ~RowReader() = default;
  virtual const FileInfo& info() const = 0;
  virtual const ColorSpace& color_space() const = 0;

  // Returns 8-bit integers as 16-bit ones. Call it before the first read().
  virtual void widen() = 0;
  virtual bool is_whole_number(size_t channel) const = 0;

  // The height of every band but the last: the number of rows that the file compresses together.
  virtual int band_rows() const = 0;

  // Reads the first `channels` channels of rows begin..end, interleaved by pixel. Throws Error(kInput).
  virtual void read(int begin, int end, size_t channels, std::byte* to) = 0;

  // The channels in which the reader found an integer above 2^24, which floats cannot represent exactly, with that
  // number.
  virtual const std::map<size_t, unsigned>& beyond_floats() const = 0;
};

// view: 1 reads the right eye of a file with FileInfo::is_pair. Throws Error(kInput) like read_image().
std::unique_ptr<RowReader> open_rows(const std::string& path, int view = 0);

// Reads some channels of a file, by name and in this order. Integers are decoded from sRGB, floats are returned
// unchanged. Throws Error(kInput), also if a channel does not exist.
Image read_channels(const std::string& path, const std::vector<std::string>& names);

// 8 bits each of R, G, B, A with R in the low byte, rows from the top, unassociated alpha: the code values of the file,
// regardless of its colour space, as required by glTF. Missing channels become grey or opaque.
struct CodeImage {
  int width = 0;
  int height = 0;
  std::vector<uint32_t> pixels;
  std::vector<uint16_t> deep;  // 16 bits each of R, G, B; pixels is empty then
};

// Decodes a file in memory. `name` identifies it in messages. keep_depth: a file with more than 8 bits per channel
// fills CodeImage::deep instead of pixels. Throws Error(kInput).
CodeImage decode_image(std::span<const std::byte> file, const std::string& name, bool keep_depth = false);

struct Channel {
  std::string name;  // R, G, B, A or Y, A; others only in EXR
  SampleType sample = SampleType::kUint8;
};

struct FileHeader {
  FileFormat format = FileFormat::kPng;
  int width = 0;
  int height = 0;
  std::vector<Channel> channels;      // alpha of integers is unassociated
  std::vector<Attribute> attributes;  // GPano:* becomes XMP; except in EXR, only text and GPano
  std::string exif;                   // JPEG and PNG: read_exif() (ods/image/exif.h)
  int quality = 95;                   // for JPEG (4:4:4), WebP and HEIF, 1 to 100
  bool writes_srgb = false;           // PNG: writes an sRGB chunk
  bool is_environment = false;        // EXR: marks it as a whole lat-long
  bool rows_alone = false;            // EXR: compresses each row separately, not 16 together
  bool has_checksum = false;          // EXR: has the attribute kExrChecksum (ods/image/format/exr_header.h)
};

// Fills row y with width * channels floats. For integer formats they are 0..1 of the code range; for float formats they
// are the values themselves, from which floats_to_halves() makes halves.
// Called concurrently from several threads, once for each row.
using RowSource = std::function<void(int y, std::span<float> row)>;

// Writes a whole image into memory or into a file that is not committed yet. Rows are computed while earlier ones are
// being compressed; `band_done`, unless empty, is called between bands. Throws Error(kOutput), and what `rows` throws.
void write_image(ByteSink& sink, const FileHeader& header, const RowSource& rows,
                 const std::function<void()>& band_done = {});

// Returns why this machine cannot write files of a format, and what would help; empty if it can. HEIF (HEVC) depends on
// an encoder that libheif loads.
std::string lacks_encoder(FileFormat format);

// The bytes of such a file; `name` stands for it in messages. Throws as write_image().
std::string image_bytes(const std::string& name, const FileHeader& header, const RowSource& rows);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Image files of every format of file_format.h, through OpenImageIO (image_file.cpp alone knows it).
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "ods/base/atomic_file.h"
#include "ods/image/file_format.h"
#include "ods/image/picture.h"

namespace ods {

// What is refused when read, before a pixel of it is allocated: longer sides, more pixels, and files that declare more
// than a small picture in next to no bytes.
inline constexpr int kMaxSide = 32768;
inline constexpr int64_t kMaxPixels = int64_t{1} << 28;
inline constexpr int64_t kSmallPixels = int64_t{1} << 24;
inline constexpr int64_t kMaxPixelsPerByte = 1024;
inline constexpr size_t kMaxFileBytes = size_t{1} << 32;  // of a file, before it is read

// Linear light in three channels. Files of integers are decoded from sRGB, files of floats taken as they are; grey
// becomes three equal channels, alpha is left out. Throws Error(kInput).
Image read_image(const std::string& path);

// What a file says of itself, without its pixels.
struct FileInfo {
  int width = 0;
  int height = 0;
  bool is_float = false;                    // light as it is; else code values of a display
  std::vector<std::string> channels;        // R, G, B, A first
  std::map<std::string, std::string> text;  // attributes that are words, by OpenImageIO's names
};

// Throws Error(kInput).
FileInfo read_info(const std::string& path);

// Some channels of a file, by their names and in their order. Integers are decoded from sRGB as above.
// Throws Error(kInput), also where there is no such channel.
Image read_channels(const std::string& path, const std::vector<std::string>& names);

// 8 bits each of R, G, B, A with R in the low byte, rows from the top, alpha not multiplied in: the code values of the
// file. What is missing is grey or opaque.
struct CodeImage {
  int width = 0;
  int height = 0;
  std::vector<uint32_t> pixels;
};

// A file in memory. `name` stands for it in messages. Throws Error(kInput).
CodeImage decode_image(std::span<const std::byte> file, const std::string& name);

enum class Sample { kUint8, kUint16, kHalf, kFloat };

struct Channel {
  std::string name;  // R, G, B; others only in EXR
  Sample sample = Sample::kUint8;
};

struct Attribute {
  std::string name;
  std::variant<int, float, std::string, std::vector<float>, std::vector<std::string>> value;
};

struct FileHeader {
  FileFormat format = FileFormat::kPng;
  int width = 0;
  int height = 0;
  std::vector<Channel> channels;
  std::vector<Attribute> attributes;  // names as OpenImageIO has them; GPano:* becomes XMP
};

// Fills row y with width * channels floats: 0..1 of the code range for integers, the value itself otherwise.
using RowSource = std::function<void(int y, std::span<float> row)>;

// Writes a whole image into a file that is not committed yet. Throws Error(kOutput).
void write_image(AtomicFile& file, const FileHeader& header, const RowSource& rows);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/depth/npy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <string>
#include <vector>

#include "ods/files/read_file.h"
#include "ods/image/format/image_limits.h"

namespace ods {

namespace {

struct NpyHeader {
  char order = '<', type = 'f';
  int bytes = 4;  // per number
  bool columns_first = false;
  std::vector<int> shape;
  uint64_t data = 0;  // offset
};

// The text after a key of the header's dictionary.
std::string after_key(const std::string& words, const std::string& key) {
  const size_t at = words.find("'" + key + "'");
  const size_t colon = at == std::string::npos ? at : words.find(':', at);
  if (colon == std::string::npos) return "";
  const size_t start = words.find_first_not_of(' ', colon + 1);
  return start == std::string::npos ? "" : words.substr(start);
}

std::vector<int> shape_of(const std::string& text) {
  std::vector<int> shape;
  const size_t end = std::min(text.find(')'), text.size());
  for (size_t at = 1; at < end; at = std::min(text.find(',', at), end) + 1) {
    if (text.find_first_of("0123456789", at) >= end) break;
    const long length = std::strtol(text.c_str() + at, nullptr, 10);
    if (length != 1) shape.push_back(static_cast<int>(std::clamp(length, 0l, long{kMaxSide} + 1)));
  }
  return shape;
}

NpyHeader read_header(const FileInput& file) {
  const std::string start = file.read(0, 12);
  const bool is_first = start[6] == 1;
  uint32_t length = static_cast<unsigned char>(start[8]) + 256u * static_cast<unsigned char>(start[9]);
  if (!is_first) std::memcpy(&length, start.data() + 8, sizeof length);
  NpyHeader header;
  header.data = (is_first ? 10u : 12u) + uint64_t{length};
  if (length > 65536) throw cannot_read(file.path(), "its header is damaged");
  const std::string words = file.read(header.data - length, length);
  const std::string type = after_key(words, "descr");
  if (type.size() < 5 || type[0] != '\'') throw cannot_read(file.path(), "its array is not of plain numbers");
  header.order = type[1], header.type = type[2];
  header.bytes = std::atoi(type.c_str() + 3);
  header.columns_first = after_key(words, "fortran_order").starts_with("True");
  header.shape = shape_of(after_key(words, "shape"));
  return header;
}

// Returns NaN for unknown types.
float number_at(const NpyHeader& header, const char* at) {
  unsigned char bytes[8] = {};
  std::memcpy(bytes, at, static_cast<size_t>(header.bytes));
  if (header.order == '>') std::reverse(bytes, bytes + header.bytes);
  uint64_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  if (header.type == 'f') {
    double wide;
    float narrow;
    std::memcpy(&wide, bytes, sizeof wide), std::memcpy(&narrow, bytes, sizeof narrow);
    return header.bytes == 2   ? glm::unpackHalf1x16(static_cast<uint16_t>(bits))
           : header.bytes == 4 ? narrow
                               : static_cast<float>(wide);
  }
  if (header.type == 'u') return static_cast<float>(bits);
  const int unused = 64 - 8 * header.bytes;
  return static_cast<float>(static_cast<int64_t>(bits << unused) >> unused);
}

bool is_known(const NpyHeader& header) {
  const bool power = header.bytes == 1 || header.bytes == 2 || header.bytes == 4 || header.bytes == 8;
  return power && (header.type == 'u' || header.type == 'i' || (header.type == 'f' && header.bytes > 1));
}

}  // namespace

NpyArray read_npy(const FileInput& file) {
  const NpyHeader header = read_header(file);
  if (!is_known(header)) throw cannot_read(file.path(), "its array is not of plain numbers");
  if (header.shape.size() != 2) {
    throw cannot_read(file.path(),
                      fmt::format("its array has {} axes; a depth picture has rows and columns", header.shape.size()));
  }
  const int width = header.shape[1], height = header.shape[0];
  const std::string fault = image_size_fault(width, height, std::max(width, height), file.size());
  if (!fault.empty()) throw cannot_read(file.path(), fault);
  const int rows = header.columns_first ? width : height, columns = header.columns_first ? height : width;
  const size_t line = static_cast<size_t>(columns) * static_cast<size_t>(header.bytes);
  NpyArray array{Image(width, height, 1), 0};
  if (header.type == 'u' && header.bytes <= 2) array.codes = header.bytes == 1 ? 255 : 65535;
  const float unit = array.codes > 0 ? 1.0f / static_cast<float>(array.codes) : 1.0f;
  for (int row = 0; row < rows; row++) {
    const std::string bytes = file.read(header.data + line * static_cast<size_t>(row), line);
    for (int i = 0; i < columns; i++) {
      float* to = header.columns_first ? array.numbers.at(row, i) : array.numbers.at(i, row);
      *to = unit * number_at(header, bytes.data() + i * header.bytes);
    }
  }
  return array;
}

}  // namespace ods

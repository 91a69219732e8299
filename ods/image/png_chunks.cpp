// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/png_chunks.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace ods {

using namespace std::string_view_literals;

static std::string escaped(const std::string& text) {
  std::string result;
  for (char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string gpano_packet(const std::vector<XmpProperty>& properties) {
  std::string attributes;
  for (const auto& [name, value] : properties) attributes += fmt::format(" {}=\"{}\"", name, escaped(value));
  return fmt::format(
      "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
      "<rdf:Description rdf:about=\"\" xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\"{}/>"
      "</rdf:RDF></x:xmpmeta>\n<?xpacket end=\"r\"?>",
      attributes);
}

static std::string big_endian(uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

// CRC-32 of ISO 3309, a byte at a time.
static constexpr std::array<uint32_t, 256> kCrcTable = [] {
  std::array<uint32_t, 256> table{};
  for (uint32_t i = 0; i < 256; i++) {
    uint32_t crc = i;
    for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
    table[i] = crc;
  }
  return table;
}();

static uint32_t crc32(std::string_view bytes) {
  uint32_t crc = 0xffffffffu;
  for (char c : bytes) crc = crc >> 8 ^ kCrcTable[(crc ^ static_cast<unsigned char>(c)) & 0xffu];
  return ~crc;
}

std::string xmp_chunk(const std::string& packet) {
  // Keyword, then: not compressed, method 0, no language, no translated keyword.
  const std::string body = std::string("XML:com.adobe.xmp\0\0\0\0\0"sv) + packet;
  const std::string typed = "iTXt" + body;
  return big_endian(static_cast<uint32_t>(body.size())) + typed + big_endian(crc32(typed));
}

static uint32_t read_big_endian(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; i++) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

static bool has_sane_size(std::string_view header) {
  const uint32_t kLongest = 1000000;  // of libpng
  if (header.size() != 13) return false;
  const uint32_t width = read_big_endian(header, 0), height = read_big_endian(header, 4);
  return width > 0 && width <= kLongest && height > 0 && height <= kLongest;
}

std::optional<std::vector<std::byte>> essential_png(std::span<const std::byte> file) {
  const size_t kSignature = 8, kFrame = 12;  // length, type and CRC around a chunk's data
  const std::string_view bytes(reinterpret_cast<const char*>(file.data()), file.size());
  if (bytes.size() < kSignature) return std::nullopt;
  std::vector<std::byte> result(file.begin(), file.begin() + kSignature);
  bool has_pixels = false;
  for (size_t at = kSignature; bytes.size() - at >= kFrame;) {
    const size_t length = read_big_endian(bytes, at);
    if (length > bytes.size() - at - kFrame) return std::nullopt;
    const std::string_view type = bytes.substr(at + 4, 4);
    if (at == kSignature && !(type == "IHDR" && has_sane_size(bytes.substr(at + 8, length)))) return std::nullopt;
    has_pixels = has_pixels || type == "IDAT";
    if (type == "IHDR" || type == "PLTE" || type == "tRNS" || type == "IDAT" || type == "IEND") {
      if (crc32(bytes.substr(at + 4, length + 4)) != read_big_endian(bytes, at + 8 + length)) return std::nullopt;
      const auto chunk = file.subspan(at, length + kFrame);
      result.insert(result.end(), chunk.begin(), chunk.end());
    }
    if (type == "IEND") return has_pixels ? std::optional(result) : std::nullopt;
    at += length + kFrame;
  }
  return std::nullopt;
}

}  // namespace ods

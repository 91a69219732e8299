// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/png_xmp.h"

#include <fmt/format.h>

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

// CRC-32 of ISO 3309, bit by bit; a packet is a kilobyte.
static uint32_t crc32(std::string_view bytes) {
  uint32_t crc = 0xffffffffu;
  for (char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

std::string xmp_chunk(const std::string& packet) {
  // Keyword, then: not compressed, method 0, no language, no translated keyword.
  const std::string body = std::string("XML:com.adobe.xmp\0\0\0\0\0"sv) + packet;
  const std::string typed = "iTXt" + body;
  return big_endian(static_cast<uint32_t>(body.size())) + typed + big_endian(crc32(typed));
}

}  // namespace ods

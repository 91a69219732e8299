// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What OpenImageIO does not do for PNG. ISO/IEC 15948 (PNG); Adobe, "XMP Specification Part 3" for the XMP chunk.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ods {

// Name (`GPano:FullPanoWidthPixels`) and value.
using XmpProperty = std::pair<std::string, std::string>;

// A packet of properties of Google's panorama namespace.
std::string gpano_packet(const std::vector<XmpProperty>& properties);

// The bytes of the iTXt chunk that holds a packet.
std::string xmp_chunk(const std::string& packet);

// Where a chunk may be put in a PNG: right behind its header chunk.
inline constexpr size_t kPngAfterHeader = 33;

// A PNG reduced to the chunks that make its pixels; nothing when one is cut short, damaged or missing. libpng comments
// on such files, and on common flaws of the other chunks, on stderr. (It still does on a file whose chunks are whole
// and make no picture: OpenImageIO's handler of errors returns into libpng, which then prints. Only unpacking the
// pixels twice would tell before.)
std::optional<std::vector<std::byte>> essential_png(std::span<const std::byte> file);

}  // namespace ods

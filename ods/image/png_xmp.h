// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// XMP in PNG, which OpenImageIO leaves out: the iTXt chunk `XML:com.adobe.xmp` of Adobe's XMP Specification, Part 3.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace ods {

// Name (`GPano:FullPanoWidthPixels`) and value.
using XmpProperty = std::pair<std::string, std::string>;

// A packet of properties of Google's panorama namespace.
std::string gpano_packet(const std::vector<XmpProperty>& properties);

// The bytes of the chunk that holds a packet.
std::string xmp_chunk(const std::string& packet);

// Where a chunk may be put in a PNG: right behind its header chunk.
inline constexpr size_t kPngAfterHeader = 33;

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// XMP packets as text, and Google's panorama properties (GPano) in them. Sources: Adobe, "XMP Specification Part 1";
// Google, "Photo Sphere XMP Metadata".
//
// Properties are written as attributes of the first rdf:Description, because some readers search the text for them
// instead of parsing XML.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ods/image/format/attribute.h"

namespace ods {

// The text that XML has in an element or attribute: xml_text() (ods/base/quote.h) backwards.
std::string xml_unescaped(std::string text);

// Returns whether an attribute is in Google's panorama namespace: GPano:FullPanoWidthPixels.
bool is_gpano(const Attribute& attribute);

// A packet with the properties in the namespaces GPano, GImage and xmpNote.
std::string make_xmp(const std::vector<Attribute>& properties);

// A packet with the GPano attributes. Empty if there are none.
std::string gpano_xmp(const std::vector<Attribute>& attributes);

// make_xmp() without the packet wrapper, as in extended XMP.
std::string make_xmp_body(const std::vector<Attribute>& properties);

// Replaces all GPano properties of the packet by these; everything else is kept. Returns nullopt if the packet is not
// valid XML or has no rdf:Description.
std::optional<std::string> replace_gpano(const std::string& xmp, const std::vector<Attribute>& properties);

// All GPano properties of a packet, as text. Empty if the packet cannot be parsed.
std::vector<Attribute> gpano_properties(const std::string& xmp);

// Returns whether a packet has any content.
bool has_properties(const std::string& xmp);

// The value of `name` in XMP, as name="value" or <name>value</name>; empty if absent.
std::string_view xmp_property(std::string_view xmp, std::string_view name);

}  // namespace ods

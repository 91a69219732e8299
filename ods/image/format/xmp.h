// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A packet of XMP as text, and Google's panorama properties (GPano) in it. Sources: Adobe, "XMP Specification Part 1";
// Google, "Photo Sphere XMP Metadata".
//
// Properties stand as attributes of the first rdf:Description: readers that are no readers of XML look for them there.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ods/image/format/attribute.h"

namespace ods {

// As XML has it in an element or between double quotes, and back.
std::string xml_escaped(const std::string& text);
std::string xml_unescaped(std::string text);

// Whether an attribute is one of Google's panorama namespace: GPano:FullPanoWidthPixels.
bool is_gpano(const Attribute& attribute);

// A packet with these properties, of the namespaces GPano, GImage and xmpNote; others are left out.
std::string make_xmp(const std::vector<Attribute>& properties);

// The same without the marks of a packet, as extended XMP has it.
std::string make_xmp_body(const std::vector<Attribute>& properties);

// The packet with these GPano properties in place of all that it has; everything else stays as it is. Nothing where it
// cannot be understood: it is no XML, or has no rdf:Description.
std::optional<std::string> replace_gpano(const std::string& xmp, const std::vector<Attribute>& properties);

// All GPano properties of a packet, as text. Nothing where it cannot be understood.
std::vector<Attribute> gpano_properties(const std::string& xmp);

// Whether a packet says anything at all.
bool says_something(const std::string& xmp);

// The value of `name` in XMP: name="value" or <name>value</name>; empty where there is none.
std::string_view xmp_property(std::string_view xmp, std::string_view name);

}  // namespace ods

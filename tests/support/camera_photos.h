// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// VR photos (.vr.jpg) as written by VR180 cameras, which differ from ours.
#pragma once
#include <string>

#include "ods/base/base64.h"
#include "ods/files/md5.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/xmp_file.h"

namespace ods {

// The XMP of a photo of square eyes with elements, single quotes and one description for each namespace.
inline std::string elements(const std::string& gpano, const std::string& id) {
  const auto description = [](const std::string& name, const std::string& space, const std::string& inside) {
    return "<rdf:Description rdf:about='' xmlns:" + name + "='" + space + "'>\n" + inside + "\n</rdf:Description>\n";
  };
  return "<?xpacket begin='' id='W5M0MpCehiHzreSzNTczkc9d'?>\n<x:xmpmeta xmlns:x='adobe:ns:meta/'>\n"
         "<rdf:RDF xmlns:rdf='http://www.w3.org/1999/02/22-rdf-syntax-ns#'>\n" +
         description("xmpNote", "http://ns.adobe.com/xmp/note/",
                     "<xmpNote:HasExtendedXMP>" + id + "</xmpNote:HasExtendedXMP>") +
         description("GImage", "http://ns.google.com/photos/1.0/image/", "<GImage:Mime>image/jpeg</GImage:Mime>") +
         description("GPano", "http://ns.google.com/photos/1.0/panorama/", gpano) +
         "</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end='w'?>";
}

inline std::string crop(const std::string& image, const std::string& whole, const std::string& left,
                        const std::string& top) {
  std::string text;
  const auto add = [&](const std::string& name, const std::string& value) {
    text += "<GPano:" + name + ">" + value + "</GPano:" + name + ">\n";
  };
  add("CroppedAreaImageHeightPixels", image), add("CroppedAreaImageWidthPixels", image);
  add("CroppedAreaLeftPixels", left), add("CroppedAreaTopPixels", top);
  add("FullPanoHeightPixels", whole), add("FullPanoWidthPixels", std::to_string(2 * std::stoi(whole)));
  return text;
}

// A photo with these contents in its standard and in its extended XMP.
inline std::string photo_of(const std::string& left, const std::string& gpano, const std::string& data) {
  const auto number = [](size_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
    return bytes;
  };
  const std::string body = "<x:xmpmeta xmlns:x='adobe:ns:meta/'><rdf:RDF><rdf:Description>" + data +
                           "</rdf:Description></rdf:RDF></x:xmpmeta>";
  const std::string id = md5(body);
  std::string photo = left.substr(0, 2) + jpeg_segment(kJpegApp1, std::string(kJpegXmp) + elements(gpano, id));
  for (size_t at = 0; at < body.size(); at += 3000) {
    const std::string head = std::string(kJpegExtendedXmp) + id + number(body.size()) + number(at);
    photo += jpeg_segment(kJpegApp1, head + body.substr(at, 3000));
  }
  return photo + left.substr(2);
}

// The right eye's JPEG as written by cameras, in lines.
inline std::string in_lines(const std::string& right) {
  std::string letters = encode_base64(right);
  for (size_t at = 76; at < letters.size(); at += 77) letters.insert(at, "\n");
  return "<GImage:Data>\n" + letters + "\n</GImage:Data>";
}

}  // namespace ods

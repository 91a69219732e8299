// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The metadata of a JPEG about two eyes: the second picture of an MPO, and the descriptor of a JPS (or a PNS, whose
// JPEG form it is). Sources: CIPA DC-007, "Multi-Picture Format"; VRex, "JPS file format".
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "ods/files/file_input.h"
#include "ods/image/format/file_info.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/png_chunks.h"

namespace ods {

struct StereoJpeg {
  FileRange right;     // the right eye's JPEG within the file; size 0: the file has only one picture
  std::string layout;  // the name of the layout (layout.h) of both eyes in one picture, or mono; empty if unspecified
  int others = 0;      // further pictures that its list (MPF) has, which are not eyes: gain maps, depth maps, previews
  std::string fault;   // message about damaged metadata; empty for valid metadata
};

// An MPO has two eyes if it lists two pictures of the type Disparity; other types are panoramas, previews and gain
// maps. Throws Error(kInput) like read_jpeg_headers().
StereoJpeg read_stereo_jpeg(const FileInput& file);

// The data of a segment with a list of pictures (MPF) after the first picture has grown by some bytes, behind that
// segment or before it. Returns nullopt for other segments, and a damaged list.
std::optional<std::string> grown_mpf(const JpegSegment& segment, int64_t growth, bool is_behind);

// The bytes of an MPO of two JPEGs, each a whole file without MPF.
std::string make_mpo(std::string_view left, std::string_view right);

// The bytes of a JPS of a JPEG, a whole file. layout: the name of the layout of both eyes in it. Returns nullopt if the
// descriptor of a JPS cannot express that layout.
std::optional<std::string> make_jps(std::string_view jpeg, std::string_view layout);

// Adds what it records to the header's data: FileInfo::is_pair, and the text attributes kStereoLayout and kStereoFault.
void add_stereo(FileInfo& info, const StereoJpeg& stereo);
inline constexpr const char *kStereoLayout = "stereo:layout", *kStereoFault = "stereo:fault";

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Identifies a picture of unknown origin: the number of eyes, how they share the file, and their projection.
//
// The metadata of the file, its sidecar and its name come first, as read by find_format(), which opens only the header.
// The aspect ratio alone proves nothing: a square may be two spheres, a half sphere or a fisheye. If only the aspect
// ratio is left, the pixels are examined: two eyes match with parallax, and each projection leaves specific marks in a
// picture (marks.h). docs/identify.md describes the method and how often it is right.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ods/picture/metadata/stereo_format.h"
#include "ods/picture/stored_picture.h"

namespace ods {

// One way to read a file.
struct Reading {
  std::optional<Layout> layout;  // not set for one eye
  ProjectionSetting projection;
  double certainty = 0.0;  // 0..1; the sum over all readings is below 1 by the probability of other projections
};

// "side-by-side, vr180"; "one eye, lat-long".
std::string reading_text(const Reading& reading);

struct Identity {
  std::vector<Reading> readings;  // the most certain first; empty if the pixels show nothing
  std::string reason;             // the evidence for the first one: "its halves match, its corners are empty"
  Bars bars;                      // bars around the picture that the readings are for
  // Known formats that none of the readings covers.
  bool has_other_faces = false;    // faces of a cube in an order that we do not support
  bool is_anaglyph = false;        // two eyes in the colours of one picture
  bool is_front_and_back = false;  // two fisheyes that show nothing in common: one looks ahead, one back

  const Reading& best() const { return readings.front(); }
  bool is_sure() const;    // all others are ruled out
  bool is_likely() const;  // more likely than all others together
};

// Opens a file as a picture with one eye, regardless of its layout, and reads only its colours. Throws Error(kInput)
// like open_picture().
StoredPicture open_whole(const std::string& path);

// Examines the pixels of such a file. Considers only readings that agree with `known`.
Identity identify(const StoredPicture& whole, const FormatHint& known = {});

// Returns `known` with the layout that the file's metadata, sidecar or name specifies, as a constraint for identify().
FormatHint with_words(const FormatHint& known, const StereoFormat& format);

// Identifies a file by its pixels if `known`, the metadata, the sidecar and the name leave the layout or the projection
// open. Otherwise returns nullopt and does not decode. `format` is the result of find_format() for `known`. Throws
// Error(kInput) like open_picture().
std::optional<Identity> identify_if_open(const std::string& path, const StereoFormat& format,
                                         const FormatHint& known = {});

// Returns `known`, for find_format() and open_picture(), with the result of the pixels. The result is added if it is
// likely, and if `format`, which was found without the pixels, is not based on the aspect ratio, or the result is sure
// or rules the aspect ratio's reading out.
FormatHint with_seen(const FormatHint& known, const StereoFormat& format, const Identity& identity);

// Identifies a video by its frames, regardless of its metadata. Examines frames until one is conclusive or a few
// seconds have passed. Returns nullopt if they cannot be decoded.
std::optional<Identity> identify_video(const std::string& path, uint64_t track, const FormatHint& known = {});

// Returns `known`, for commands that open a picture or a video, completed by the pixels where the metadata is
// incomplete. Appends doubts to `notes`. Throws Error(kInput) like read_info(), read_video_file() and choose_track(),
// and if the pixels are needed but none of their readings is likely.
FormatHint identified(const std::string& path, const FormatHint& known, std::vector<std::string>& notes);

// Lists the readings in doubt and the options that decide, for messages: "one eye, lat-long (0.60) or side-by-side,
// vr180 (0.38): say which with --layout and --projection". Empty if one reading is sure.
std::string doubt_text(const Identity& identity);

}  // namespace ods

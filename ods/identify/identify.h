// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a picture of unknown origin shows: how many eyes, how they share the file, and their projection.
//
// The file's own words, its sidecar and its name come first, as find_format() reads them, and nothing is opened for
// that but the header. A shape is no word: a square may be two spheres, a half or a fisheye. Where only the shape would
// tell, the pixels are looked at: two eyes match with parallax, and each projection does to a picture what no other
// does (marks.h). docs/identify.md says how, and how often it is right.
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
  std::optional<Layout> layout;  // none: one eye
  ProjectionSetting projection;
  double certainty = 0.0;  // 0..1; what all readings lack of 1 is for projections that are not ours
};

// "side-by-side, vr180"; "one eye, lat-long".
std::string reading_text(const Reading& reading);

struct Identity {
  std::vector<Reading> readings;  // the most certain first; empty: the pixels show nothing
  std::string reason;             // what speaks for the first: "its halves match, its corners are empty"
  Bars bars;                      // around what the readings are of
  // What it looks like that is none of the readings.
  bool has_other_faces = false;    // faces of a cube in an order that is none of ours
  bool is_anaglyph = false;        // two eyes in the colours of one picture
  bool is_front_and_back = false;  // two fisheyes that share nothing: one looks ahead, one behind

  const Reading& best() const { return readings.front(); }
  bool is_sure() const;    // nothing else comes into question
  bool is_likely() const;  // more likely than all others together
};

// A file read as one eye, whatever it shows; only its colours. Throws Error(kInput) as open_picture().
StoredPicture open_whole(const std::string& path);

// Looks at the pixels of such a file. Only readings that agree with `known` come into question.
Identity identify(const StoredPicture& whole, const FormatHint& known = {});

// `known`, with the layout that the file's words, sidecar or name tell: what identify() is to agree with.
FormatHint with_words(const FormatHint& known, const StereoFormat& format);

// The same for a file of which neither `known` nor its own words, its sidecar or its name tell the layout and the
// projection; nothing, without opening the pixels, if they do. `format` is what find_format() makes of `known`. Throws
// Error(kInput) as open_picture().
std::optional<Identity> identify_if_open(const std::string& path, const StereoFormat& format,
                                         const FormatHint& known = {});

// `known` for find_format() and open_picture(), with what the pixels show: if that is likely and `format`, which was
// found without them, has no shape to go by, or the pixels speak against that, or are sure.
FormatHint with_seen(const FormatHint& known, const StereoFormat& format, const Identity& identity);

// What the frames of a video show, whatever it says: one after the other is looked at, until one tells or a few seconds
// have passed. Nothing if they cannot be decoded.
std::optional<Identity> identify_video(const std::string& path, uint64_t track, const FormatHint& known = {});

// `known` for commands that open a picture or a video, with what its pixels show where no word tells. `notes` gets what
// is in doubt. Throws Error(kInput) as read_info(), read_video_file() and choose_track(), and if pixels must tell and
// nothing that they may show is likely.
FormatHint identified(const std::string& path, const FormatHint& known, std::vector<std::string>& notes);

// The readings that are in doubt, and the options of every command that decide, for messages; empty if one is sure:
// "one eye, lat-long (0.60) or side-by-side, vr180 (0.38): say which with --layout and --projection".
std::string doubt_text(const Identity& identity);

}  // namespace ods

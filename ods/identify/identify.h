// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Identifies a picture by its pixels: the number of eyes, how they share the file, and their projection.
//
// The aspect ratio alone proves nothing: a square may be two spheres, a half sphere or a fisheye. If open_media() finds
// nothing else, it examines the pixels: two eyes match with parallax, and each projection leaves specific marks in a
// picture (marks.h). docs/identify.md describes the method and how often it is right.
#pragma once
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

// Examines the pixels of a file that was opened as one eye, regardless of its layout. Considers only readings that
// agree with `known`.
Identity identify(const StoredPicture& whole, const FormatHint& known = {});

// Lists the readings in doubt and the options that decide, for messages: "one eye, lat-long (0.60) or side-by-side,
// vr180 (0.38): specify it with --layout and --projection". Empty if one reading is sure.
std::string doubt_text(const Identity& identity);

}  // namespace ods

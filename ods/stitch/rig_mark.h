// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Which rig a view was rendered for. Views of two rigs often have the same size and number, and stitch without any
// other sign that they do not fit. So whatever renders views leaves a mark: in the folder of the views, and in the
// header of each file where it can.
#pragma once
#include <string>

#include "ods/stitch/slit_rig.h"

namespace ods {

// The file in a folder of views.
inline constexpr const char* kRigMarkFile = "ods-rig.txt";

// The attribute in a view's header (exr, png): the mark without quotes.
inline constexpr const char* kRigMarkAttribute = "ods:rig";

// One line of words, "ods-rig=1 views=0C2F... slits=12 pitches=2 ...", without quotes or backslashes. The word `views`
// is an MD5 of everything that stitching takes for granted about the views: their places, directions, angles, size and
// kind of depth. It is the same for a rig and for that rig read from its file. The other words are settings, for
// messages.
std::string rig_mark(const SlitRig& rig);

// What stands in that file: two lines, of which the first is `"ods-rig=1 views=..."`, with its quotes. POV-Ray can read
// that line, and no string of more than 255 letters. The second line has the other words.
std::string mark_file_text(const std::string& mark);

// The mark in such a text; without `views`, if it is none.
std::string mark_in_file(const std::string& text);

// How the rig of one mark differs from that of another, "padding is 8, not 4"; empty: their views are the same.
std::string mark_difference(const std::string& mark, const std::string& expected);

// Throws Error(kInput) if there is such a difference. `name`: the file that has the mark.
void check_rig_mark(const std::string& mark, const std::string& expected, const std::string& name);

}  // namespace ods

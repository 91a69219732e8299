// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Identifies the rig that a view was rendered for. Views of two rigs often have the same size and numbers, and nothing
// else would show that they do not match. So programs that render views write a mark to the views' folder and, if the
// format allows it, to each file's header.
#pragma once
#include <string>

#include "ods/stitch/slit_rig.h"

namespace ods {

// The mark's file in a folder of views.
inline constexpr const char* kRigMarkFile = "ods-rig.txt";

// The mark's attribute in a view's header (exr, png), without quotes.
inline constexpr const char* kRigMarkAttribute = "ods:rig";

// One line, "ods-rig=1 views=0C2F... slits=12 pitches=2 ...", without quotes or backslashes. `views` is an MD5 of
// everything that stitching assumes about the views: positions, directions, angles, size and kind of depth. A rig and
// the same rig read from its file have the same MD5. The other fields are settings, for messages.
std::string rig_mark(const SlitRig& rig);

// The contents of the mark's file: two lines, of which the first is `"ods-rig=1 views=..."`, in quotes, because POV-Ray
// can read that, but not a string of more than 255 characters. The second line has the other fields.
std::string mark_file_text(const std::string& mark);

// Extracts the mark from such a text; the result lacks `views` if the text is not a mark.
std::string mark_in_file(const std::string& text);

// The difference between the two rigs as text, "padding is 8, not 4". Empty if their views are the same.
std::string mark_difference(const std::string& mark, const std::string& expected);

// Throws Error(kInput) if the marks differ. `name`: the file with the mark.
void check_rig_mark(const std::string& mark, const std::string& expected, const std::string& name);

}  // namespace ods

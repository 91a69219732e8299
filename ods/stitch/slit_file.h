// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A rig of slits as JSON, for ods stitch and for other renderers: each view's matrix, angles and number. docs/slits.md
// has the schema.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ods/stitch/slit_rig.h"

namespace ods {

// The number in "omnistereo_slits". It increases when older readers would misunderstand newer files.
inline constexpr int kSlitFileVersion = 1;

// Views are numbered from 1, in the rig's order. A view's matrix maps its own coordinates (+X right, +Y up, looking
// along -Z) to world space: four rows of four; the last column is its position.
std::string write_slit_rig(const SlitRig& rig);

// The matrix of a view, 16 numbers: the file's own if the rig was read from one.
std::vector<float> view_matrix(const SlitRig& rig, size_t view);

// `name` stands for the text in messages. A view's matrix alone gives its position and direction, so users may edit it,
// but not the view's number or place in the list. Unknown keys add to `warnings`. Throws Error(kInput) if the text is
// not JSON, not a rig, of a newer version, or has a value out of range, missing views, or a matrix that is not a rigid
// transform.
SlitRig read_slit_rig(std::string_view text, const std::string& name, std::vector<std::string>& warnings);
SlitRig load_slit_rig(const std::string& path, std::vector<std::string>& warnings);

// Writes the file atomically. Throws Error(kOutput).
void save_slit_rig(const SlitRig& rig, const std::string& path);

}  // namespace ods

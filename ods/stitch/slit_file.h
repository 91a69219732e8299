// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A rig of slits as JSON, for ods stitch and for every renderer that can read: each view's matrix, angles and number.
// docs/slits.md has the schema.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ods/stitch/slit_rig.h"

namespace ods {

// The number in "omnistereo_slits". It grows when a reader of the old number would misunderstand a file.
inline constexpr int kSlitFileVersion = 1;

// Views are numbered from 1, in the rig's order. A view's matrix takes its own coordinates (+X right, +Y up, looking
// along -Z) to the world's: four rows of four, the last column is where it stands.
std::string write_slit_rig(const SlitRig& rig);

// That of a view, 16 numbers: the file's own, if the rig was read from one.
std::vector<float> view_matrix(const SlitRig& rig, size_t view);

// `name` stands for the text in messages. Where a view looks and stands is what its matrix says, and may be what people
// have made of it; its number and place in the list may not. Keys that we do not know are named in `warnings`.
// Throws Error(kInput): not JSON, no rig, a newer version, a value out of range, views that are missing, a matrix that
// is no place and orientation.
SlitRig read_slit_rig(std::string_view text, const std::string& name, std::vector<std::string>& warnings);
SlitRig load_slit_rig(const std::string& path, std::vector<std::string>& warnings);

// Complete or not at all. Throws Error(kOutput).
void save_slit_rig(const SlitRig& rig, const std::string& path);

}  // namespace ods

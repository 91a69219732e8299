// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The files of a rig's views: one per view, or several views in a sheet, by number.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ods/stitch/stitch.h"

namespace ods {

// A file name pattern with the view's number (ods/files/frames.h), from 1, in the rig's order: views/####.exr. With %V
// for the eye's name, each eye's views count from 1: %V/####.exr.
//
// A sheet contains views of one size beside and above each other, without gaps: contact sheets in row order; strips,
// with a column per slit and a row per pitch, in column order. The number is then the sheet's.
struct ViewFiles {
  std::string names;
  int columns = 1;  // per sheet
  int rows = 1;
  bool by_columns = false;
  bool own_normals = false;  // the views' normals are in view space: right, up, and towards the camera
};

// The fault of the names, for messages. Empty if they have none.
std::string names_fault(const SlitRig& rig, const ViewFiles& files);

// The file that contains a view. Precondition: no names_fault().
std::string view_path(const SlitRig& rig, const ViewFiles& files, size_t view);

// The views' folders, each ending in "/"; an empty name is the current folder.
std::vector<std::string> view_folders(const SlitRig& rig, const ViewFiles& files);

// Returns whether every folder has this rig's mark (ods/stitch/rig_mark.h). Throws Error(kInput) if one has another
// rig's.
bool has_rig_marks(const SlitRig& rig, const ViewFiles& files);

// Creates the folders if necessary and marks them. A folder belongs to one rig: throws Error(kInput), before writing
// anything, if one has another rig's mark; Error(kOutput).
void mark_folders(const SlitRig& rig, const ViewFiles& files);

// Opens views for stitch(). A view whose header has another rig's mark is at fault. Depth is the layer Z, or
// NAME.Depth.Z in Blender's multilayer files. Normals, the layers N, Normal or NAME.Normal with X, Y and Z, are
// converted to world space.
OpenView open_view_files(const SlitRig& rig, const ViewFiles& files);

// The views whose files are missing or empty or, with `thorough`, cannot be opened, have another size or belong to
// another rig.
std::vector<ViewFault> missing_views(const SlitRig& rig, const ViewFiles& files, bool thorough);

// A key for a rig and its views: it changes if the rig differs, or the size or time of a view's file (views are too
// large to hash). It is the same on every machine.
uint64_t views_key(const SlitRig& rig, const ViewFiles& files);

// The file numbers of these views, of one eye or of all, as frame ranges: "12-15,80". With %V in the names: "left
// 12-15,80 right 3".
std::string view_ranges(const SlitRig& rig, const ViewFiles& files, const std::vector<ViewFault>& faults);

}  // namespace ods

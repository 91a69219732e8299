// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the views of a rig lie on the disk: a file each, or several in a sheet, by number.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ods/stitch/stitch.h"

namespace ods {

// Names with a place for the view's number (ods/files/frames.h), from 1, in the rig's order: views/####.exr. With %V,
// for the eye's name, every eye's views count from 1: %V/####.exr.
//
// A sheet has views of one size beside and above each other, without gaps: contact sheets row by row, strips, of which
// a column is a slit and its rows the pitches, column by column. Then sheets are what is numbered.
struct ViewFiles {
  std::string names;
  int columns = 1;  // of a sheet
  int rows = 1;
  bool by_columns = false;
  bool own_normals = false;  // those of the views are along a view's axes: right, up and towards its place
};

// What is wrong with such names, in words for a message; empty: nothing.
std::string names_fault(const SlitRig& rig, const ViewFiles& files);

// The file that a view is in. Precondition: no names_fault().
std::string view_path(const SlitRig& rig, const ViewFiles& files, size_t view);

// The folders of the views, each with a "/" at its end; empty: the current one.
std::vector<std::string> view_folders(const SlitRig& rig, const ViewFiles& files);

// Whether every folder has the mark of this rig (ods/stitch/rig_mark.h). Throws Error(kInput): one has that of another.
bool has_rig_marks(const SlitRig& rig, const ViewFiles& files);

// Marks the folders, which are made where they are missing. A folder belongs to one rig: throws Error(kInput) if one
// has the mark of another, before anything is written; Error(kOutput).
void mark_folders(const SlitRig& rig, const ViewFiles& files);

// Opens views for stitch(). One whose header has the mark of another rig is at fault. Their depth is the layer Z, or
// NAME.Depth.Z of Blender's files of many layers. Normals, the layers N, Normal or NAME.Normal of X, Y and Z, become
// those along the world's axes.
OpenView open_view_files(const SlitRig& rig, const ViewFiles& files);

// The views whose files are not there or are empty, or, with `thorough`, cannot be opened, have another size or are of
// another rig.
std::vector<ViewFault> missing_views(const SlitRig& rig, const ViewFiles& files, bool thorough);

// Tells rigs with their views from others: another number where the rig differs, or the size or time of a view's file
// (views are too many bytes to read them twice). The same number on every machine.
uint64_t views_key(const SlitRig& rig, const ViewFiles& files);

// The numbers of views in their files' names, of one eye or of all, as frame ranges: "12-15,80". With %V in the names:
// "left 12-15,80 right 3".
std::string view_ranges(const SlitRig& rig, const ViewFiles& files, const std::vector<ViewFault>& faults);

}  // namespace ods

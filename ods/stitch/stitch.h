// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Stitches the views of a rig of slits into its picture. Every pixel follows its own ray into the views nearest to the
// ray's origin, and averages its footprint there (ods/convert/resample.h). At the border of two slits or pitches, one
// fades into the other over a part of a slit set by the rig; their edges differ by no more than slit_error()'s step.
//
// Views with depth are reprojected as by ods/convert/reproject.h: each ray is traced against the views' surfaces, so
// points are exact at any slit width. If the point is occluded in both candidate views, the far background replaces it.
//
// Layers follow their rules: light and means are filtered; others take the nearest pixel. Depth is converted to metres
// along the picture's own rays. Normals are averaged in world space; `open` must convert them to it.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"
#include "ods/stitch/slit_rig.h"

namespace ods {

struct StitchOptions {
  // If empty, the picture is in memory until it is saved. Otherwise a journal file that contains it until then, so that
  // after a crash the next process with the same key resumes; the key must identify everything that the picture depends
  // on. The caller removes the file after saving the picture.
  std::string journal;
  uint64_t journal_key = 0;
};

struct ViewFault {
  size_t view;       // its index in the rig
  std::string what;  // for messages
};

struct Stitched {
  PictureRows rows;               // empty if a needed view is at fault
  std::vector<ViewFault> faults;  // views that could not be read, in order
  int64_t unseen = 0;             // pixels whose point was occluded in every view
};

// Opens a view by its index in the rig: one eye, in the view's own size and projection. Called concurrently, once per
// view, roughly in order. An exception is that view's fault, except Error(kMemory) and anything that is not an Error.
using OpenView = std::function<StoredPicture(size_t view)>;

// Reads all views, with few in memory at a time. Calls `done` after every slit with the fraction done; it may throw to
// stop. Throws Error(kOutput), Error(kMemory) like Scratch; Error(kInput) if no view can be read.
Stitched stitch(const SlitRig& rig, const OpenView& open, const StitchOptions& options,
                const std::function<void(double part)>& done = {});

}  // namespace ods

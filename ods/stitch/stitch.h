// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The views of a rig of slits become its picture. Every pixel looks along its own ray, into the views that stand
// nearest to where that ray starts, and averages what it covers there (ods/convert/resample.h). Where two slits or
// pitches meet, one fades into the other, over a part of a slit that the rig states: their edges stand apart by
// slit_error()'s step, no more.
//
// Views with depth are seen through as by ods/convert/reproject.h: what the ray meets is looked for on the views'
// surfaces, and so stands where it belongs, at any width of slits. Where one thing hides another for both views
// that might show it, what is far behind stands in.
//
// Layers follow their rules: light and means are filtered, others the nearest pixel's. Depth becomes that along the
// picture's own rays. Normals are means of vectors along the world's axes, which is for who opens the views to see to.
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
  // Empty: the picture is in memory until it is saved. Else a file in which it lies until then, so that a process that
  // was killed is gone on with by the next one that has the same key: whatever says what the picture is made of. Who
  // has saved the picture removes it.
  std::string journal;
  uint64_t journal_key = 0;
};

struct ViewFault {
  size_t view;       // its index in the rig
  std::string what;  // in words for people
};

struct Stitched {
  PictureRows rows;               // empty where a view at fault was to be seen
  std::vector<ViewFault> faults;  // of views that could not be read, in their order
  int64_t unseen = 0;             // pixels for which something hid what they should show
};

// A view by its index in the rig, of one eye, in its own size and form. Called by several threads at once, once a view,
// about in their order; what it throws is the view's fault, but for Error(kMemory) and what is no Error.
using OpenView = std::function<StoredPicture(size_t view)>;

// Reads all views; few are in memory at a time. `done` hears of every slit that is done, as a part of 1; it may throw,
// which ends it. Throws Error(kOutput), Error(kMemory) as Scratch; Error(kInput): no view can be read.
Stitched stitch(const SlitRig& rig, const OpenView& open, const StitchOptions& options,
                const std::function<void(double part)>& done = {});

}  // namespace ods

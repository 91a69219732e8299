// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods stitch --merge auto: a stitched picture whose eyes are moved by its depth.
#pragma once
#include <string>

#include "ods/convert/convert.h"

// Must not move: the rows read the picture.
struct MergedPicture {
  ods::StoredPicture picture;  // as it was stitched
  ods::StereoCamera camera;    // with the merge
  ods::Conversion conversion;

  // limit: minutes of arc. Notes the stereo that the depth allows. The picture passes through a file beside `output`.
  // Throws UsageError if there is no depth; ods::Error as save_picture() and open_picture() do.
  MergedPicture(const ods::PictureRows& stitched, const ods::StereoCamera& camera, float limit,
                const std::string& output);
  MergedPicture(const MergedPicture&) = delete;
  MergedPicture& operator=(const MergedPicture&) = delete;
};

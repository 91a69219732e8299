// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/camera/merged_picture.h"

#include <filesystem>
#include <utility>

#include "cli/console/console.h"
#include "cli/options/eye_options.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/convert/reproject.h"
#include "ods/files/atomic_file.h"

static ods::StoredPicture as_stored(const ods::PictureRows& rows, const ods::StereoCamera& camera,
                                    const std::string& output) {
  const std::string file = output + ".merging.exr";
  save_picture(rows, &camera, {}, file);
  ods::OpenOptions open;
  open.scratch_folder = ods::existing_folder_of(output);
  try {
    ods::StoredPicture picture = ods::open_picture(file, open);
    std::filesystem::remove(file);
    return picture;
  } catch (...) {
    std::filesystem::remove(file);
    throw;
  }
}

MergedPicture::MergedPicture(const ods::PictureRows& stitched, const ods::StereoCamera& own, float limit,
                             const std::string& output)
    : picture(as_stored(stitched, own, output)), camera(own) {
  if (!ods::depth_layer(picture)) throw UsageError("--merge auto: the views have no depth (Z), which it follows");
  ods::Image map = ods::merge_map_of(ods::comfortable_shares(ods::seen_by_eyes(picture), camera, limit));
  note(merge_by_depth_text(map));
  ods::use_merge_map(camera, std::move(map));
  ods::ConvertTarget target = same_format(picture);
  target.camera = camera;
  target.holes = ods::Holes::kFilled;
  conversion = ods::convert(picture, target);
}

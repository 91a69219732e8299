// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The samples that a still picture has so far, in a file beside it: PICTURE.unfinished. After an interruption the same
// command resumes.
#pragma once
#include <optional>
#include <string>

#include "cli/render/render_job.h"
#include "ods/render/unfinished.h"

class UnfinishedPicture {
 public:
  // options, camera, save: used to render and save the picture. The job must outlive this object.
  UnfinishedPicture(const RenderJob& job, const ods::RenderOptions& options, const ods::StereoCamera& camera,
                    const ods::SaveOptions& save);

  const ods::RenderOptions& options() const { return options_; }
  const ods::StereoCamera& camera() const { return camera_; }

  // The identity of the samples: for the file, and for parts.
  const ods::SampledPicture& about();

  // The samples that an earlier run has kept, if there are any, without --restart. Throws ods::Error(kUsage) if that
  // run had other options; Error(kInput) if the file is damaged.
  ods::PictureSamples begin();

  // Replaces the file. Warns once if it cannot be written; later calls then do nothing.
  void keep(const ods::PictureSamples& samples);

  // Returns whether a file has the samples of the last keep().
  bool is_kept() const { return kept_; }

  const std::string& path() const { return path_; }

  // Removes the file. Call it when the picture is finished.
  void remove() const;

 private:
  const RenderJob& job_;
  ods::RenderOptions options_;
  ods::StereoCamera camera_;
  ods::SaveOptions save_;
  std::string path_;
  std::optional<ods::SampledPicture> about_;
  bool kept_ = false;
  bool failed_ = false;
};

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a still picture has so far, in a file beside it: PICTURE.unfinished. After an interruption the same command goes
// on.
#pragma once
#include <optional>
#include <string>

#include "cli/render/render_job.h"
#include "ods/render/unfinished.h"

class UnfinishedPicture {
 public:
  // options, camera: with which the picture is rendered. The job must outlive this object.
  UnfinishedPicture(const RenderJob& job, const ods::RenderOptions& options, const ods::StereoCamera& camera);

  // What an earlier run has kept, if there is any, without --restart. Throws ods::Error(kUsage) if that run had other
  // options; Error(kInput) if the file is damaged.
  ods::PictureSamples begin();

  // Replaces the file. Warns once if it cannot be written, and is then of no further use.
  void keep(const ods::PictureSamples& samples);

  // Whether there is a file that has the samples of the last keep().
  bool is_kept() const { return kept_; }

  const std::string& path() const { return path_; }

  // The picture is finished.
  void remove() const;

 private:
  const ods::SampledPicture& about();

  const RenderJob& job_;
  ods::RenderOptions options_;
  ods::StereoCamera camera_;
  std::string path_;
  std::optional<ods::SampledPicture> about_;
  bool kept_ = false;
  bool failed_ = false;
};

// What the samples are of: for the file, and for parts.
ods::SampledPicture sampled_picture(const RenderJob& job, const ods::RenderOptions& options,
                                    const ods::StereoCamera& camera);

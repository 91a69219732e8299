// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/unfinished_picture.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/console/console.h"
#include "cli/render/plan.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/sequence/identity.h"

UnfinishedPicture::UnfinishedPicture(const RenderJob& job, const ods::RenderOptions& options,
                                     const ods::StereoCamera& camera, const ods::SaveOptions& save)
    : job_(job), options_(options), camera_(camera), save_(save), path_(job.output + ".unfinished") {}

const ods::SampledPicture& UnfinishedPicture::about() {
  if (about_) return *about_;
  const ods::Sidecar sidecar{camera_, {options_.width, options_.height}, save_.layout, ods::eye_list(options_.eyes)};
  const ods::Settings identity = sample_identity(identified(job_), double{job_.time.time.value_or(0.0f)});
  about_ = {identity, ods::write_sidecar(sidecar), save_.exposure, save_.tone, options_};
  return *about_;
}

ods::PictureSamples UnfinishedPicture::begin() {
  std::error_code ignored;
  if (job_.restart) std::filesystem::remove(path_, ignored);
  if (!std::filesystem::exists(path_, ignored)) return ods::no_samples(options_);
  ods::PictureSamples samples;
  const ods::SampledPicture then = ods::read_unfinished(path_, samples);
  expect_same_settings(path_, then.settings, about().settings);
  if (!ods::fit(samples, options_)) {
    throw UsageError(
        fmt::format("'{}' was made with other options: its layers differ; {}", path_, ods::kRestartRemedy));
  }
  note(fmt::format("resuming from '{}'", path_));
  kept_ = true;
  return samples;
}

void UnfinishedPicture::keep(const ods::PictureSamples& samples) {
  if (failed_) return;
  try {
    ods::write_unfinished(path_, about(), samples);
    kept_ = true;
  } catch (const ods::Error& error) {
    warn(fmt::format("cannot save the progress: {}", error.what()));
    failed_ = true;
    kept_ = false;
  }
}

void UnfinishedPicture::remove() const {
  std::error_code ignored;
  if (kept_) std::filesystem::remove(path_, ignored);
}

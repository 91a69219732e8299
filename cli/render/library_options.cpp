// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/library_options.h"

#include "cli/console/console.h"
#include "cli/options/picture_options.h"

// A video's frames are .exr, but what is looked at is the video. One sample has no variance.
ods::Denoiser denoiser_of(const RenderJob& job) {
  const bool looked_at = job.time.is_video || !keeps_light(job.output);
  const auto denoiser = job.denoise.value_or(looked_at ? ods::Denoiser::kOwn : ods::Denoiser::kNone);
  return denoiser == ods::Denoiser::kOwn && job.render.samples == 1 ? ods::Denoiser::kNone : denoiser;
}

bool draws_on_neighbours(const RenderJob& job) {
  return job.time.is_video && denoiser_of(job) == ods::Denoiser::kOwn;
}

ods::RenderOptions options_to_finish(const RenderJob& job) {
  ods::RenderOptions options = ods::options_to_finish(job.render, denoiser_of(job));
  options.layers |= job.part.has_value();
  options.statistics |= job.part.has_value() || job.save_unfinished;
  return options;
}

ods::FinishOptions finish_of(const RenderJob& job) {
  return {denoiser_of(job), job.save};
}

ods::SequenceOptions sequence_of(const RenderJob& job, const TimeOptions& time) {
  ods::SequenceOptions options;
  options.camera = [&job, &time](const ods::Scene& scene, double seconds) {
    return ods::moved(place_camera_again(job.camera, scene), time.move, seconds);
  };
  options.fps = static_cast<double>(time.fps);
  options.first_frame = time.file.first;
  const bool is_timed = asks_for_video(time) || time.time;
  options.shutter = is_timed ? static_cast<double>(time.shutter) : 0.0;
  options.render = job.render;
  options.finish = finish_of(job);
  options.draws_on_neighbours = draws_on_neighbours(job);
  options.warn = warn;
  return options;
}

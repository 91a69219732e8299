// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods denoise: removes the noise of a finished picture.
#include "ods/denoise/denoise.h"

#include <fmt/format.h>

#include <utility>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/convert/denoise_job.h"
#include "cli/options/picture_options.h"
#include "ods/convert/convert.h"
#include "ods/denoise/oidn.h"
#include "ods/files/atomic_file.h"

namespace {

ods::StoredNoise read_input(const DenoiseJob& job, const ods::StoredPicture& picture) {
  note_guesses(job.input, picture);
  ods::StoredNoise noise = ods::read_noise(picture, job.layers, job.input);
  if (noise.unusable > 0) {
    note(fmt::format(
        "{}: {} pixels without usable light or variance (NaN, infinite, negative or of one sample): taken from their "
        "neighbours",
        job.input, noise.unusable));
  }
  if (!noise.has_features)
    note(fmt::format("{}: no albedo and no normals, which would keep textures sharper", job.input));
  return noise;
}

// The header shows whether the output can be written, before the pixels are read.
ods::SaveOptions plan_output(const DenoiseJob& job, const ods::StoredPicture& header) {
  const ods::ConvertTarget same = ods::same_format(header);
  ods::SaveOptions save;
  save_as_it_was(header, header.camera.projection, job.output, job.layout, job.display, save);
  note_misleading_name(job.output, save, same.eyes.size(), header.camera.projection);
  ods::check_output(job.output, save, same.eyes, same.eye, &header.camera.projection);
  return save;
}

void denoise_file(const DenoiseJob& job, ProgressLines& lines) {
  const auto start = std::chrono::steady_clock::now();
  if (job.oidn) ods::check_oidn();
  refuse_overwriting(job.output, job.input);
  ods::OpenOptions open;
  open.format = job.known;
  std::optional<ods::PictureReader> reader(std::in_place, job.input, open);
  const ods::SaveOptions save = plan_output(job, reader->header());
  const ods::StoredPicture picture = reader->read(ods::existing_folder_of(job.output));
  reader.reset();  // it may hold a decoder's memory
  ods::StoredNoise noise = read_input(job, picture);
  ods::Progress progress;
  progress.report = [&](double done) { lines.report(0.9 * done, seconds_since(start), {"denoise", 0, 0, job.output}); };
  if (job.oidn) {
    ods::denoise_with_oidn(noise.picture, picture.camera, job.options.threads, progress);
  } else {
    ods::DenoiseOptions options = job.options;
    options.keep_statistics = false;
    ods::denoise(noise.picture, picture.camera, options, progress);
  }
  // The file has the other layers.
  for (ods::EyeImage& eye : noise.picture.eyes) eye = {eye.eye, std::move(eye.radiance), {}, {}, {}};
  const ods::PictureRows rows = ods::denoised_rows(picture, noise.picture);
  const auto files = ods::save_picture(rows, &picture.camera, save, job.output);
  lines.report(1.0, seconds_since(start), {"denoise", 0, 0, job.output});
  lines.clear();
  for (const std::string& file : files) announce_file(file);
  note(fmt::format("{} denoised in {}", files.front(), duration_text(seconds_since(start))));
}

void denoise(const DenoiseJob& job) {
  run_long_job(job.progress, job.options.threads, [&](ProgressLines& lines) { denoise_file(job, lines); });
}

}  // namespace

extern const Command kDenoise =
    make_command<parse_denoise, denoise>("denoise", "remove the noise of a rendered picture, both eyes together");

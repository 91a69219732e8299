// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/layers/layers_of_picture.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/layers/layer_files.h"
#include "cli/render/first_look.h"
#include "ods/base/error.h"
#include "ods/convert/reproject.h"
#include "ods/files/atomic_file.h"
#include "ods/layers/depth/picture_layers.h"

namespace {

constexpr double kMaking = 0.6;  // the end of that step, as a fraction of the whole time

ods::StoredPicture picture_of(const LayersJob& job) {
  const std::string& path = job.render.scene.name;
  ods::OpenOptions open;
  open.scratch_folder = ods::existing_folder_of(job.render.output);
  ods::StoredPicture picture = ods::open_picture(path, open);
  for (const std::string& guess : picture.guesses) note(fmt::format("{}: {}", path, guess));
  if (!job.depth.path.empty()) give_depth(job.depth, picture);
  if (!ods::depth_layer(picture)) {
    throw ods::Error(ods::ErrorKind::kUsage,
                     fmt::format("'{}' has no depth: render it as .exr with depth, or add --depth FILE", path));
  }
  return picture;
}

ods::PictureLayersOptions options_of(const LayersJob& job) {
  ods::PictureLayersOptions options;
  options.box = ods::vec3(job.box);
  options.width = job.width;
  options.exposure = unmeasured_exposure(job.render);
  options.tone = job.render.tone.value_or(job.render.save.tone);
  return options;
}

void report_counts(const ods::PictureLayersCounts& counts, double seconds) {
  note(fmt::format("{} triangles, in {}", counts.triangles, duration_text(seconds)));
  note(fmt::format(
      "the picture does not show {:.2f} % of what eyes in the box see: {:.2f} % are guessed from the edges in "
      "front of it, {:.3f} % are open",
      100.0 * (counts.hidden + counts.open), 100.0 * counts.hidden, 100.0 * counts.open));
}

void make(const LayersJob& job, ProgressLines& lines) {
  const ods::StoredPicture picture = picture_of(job);
  const auto start = std::chrono::steady_clock::now();
  const GentleStop stop("ods: stopping\n");
  const ods::Progress progress = layers_progress(job, lines, stop);
  try {
    ods::PictureLayersCounts counts;
    ods::LayeredScene layers =
        ods::picture_layers(picture, options_of(job), &counts, ods::part_of(progress, 0.0, kMaking));
    layers.name = std::filesystem::path(job.render.scene.name).filename().string();
    layers.fallback = job.fallback;
    report_counts(counts, seconds_since(start));
    write_layer_files(job, layers, ods::part_of(progress, kMaking, 1.0), lines);
  } catch (const ods::Error& error) {
    if (error.kind() != ods::ErrorKind::kCancelled) throw;
    stop.end();
  }
}

}  // namespace

void layers_of_picture(const LayersJob& job) {
  run_long_job(job.render.progress, job.render.render.threads, [&](ProgressLines& lines) { make(job, lines); });
}

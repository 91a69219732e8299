// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/layers/layer_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/view/export_site.h"
#include "ods/files/atomic_folder.h"
#include "ods/files/private_folder.h"
#include "ods/layers/light/layered_picture.h"

namespace {

namespace fs = std::filesystem;

constexpr double kShareOfScene = 0.25;  // of the time, beside the picture
constexpr int kWidestPicture = 8192;    // pixels: headsets do not read larger JPEGs

ods::LayeredPictureOptions picture_options(const LayersJob& job, int width) {
  return {std::min(width, kWidestPicture), job.write.quality, job.render.render.threads};
}

void report_cost(const ods::LayeredScene& scene, uint64_t bytes) {
  const ods::LayersCost cost = ods::cost_of(scene);
  note(fmt::format("{:.1f} MB; {} triangles, {} draw calls, {:.0f} MB of textures on the graphics card",
                   static_cast<double>(bytes) * 1e-6, cost.triangles, cost.draw_calls,
                   static_cast<double>(cost.texture_bytes) * 1e-6));
}

}  // namespace

void check_layer_files(const LayersJob& job) {
  const fs::path output = job.render.output;
  if (job.is_page) {
    const ods::AtomicFolder draft(output);
    return;
  }
  ods::check_layers_path(output);
  const fs::path fallback = output.parent_path() / job.fallback;
  if (!job.fallback.empty() && !fs::exists(fallback)) ods::check_layered_picture(fallback, picture_options(job, 4096));
}

ods::Progress layers_progress(const LayersJob& job, ProgressLines& lines, const GentleStop& stop) {
  const auto start = std::chrono::steady_clock::now();
  const ProgressStep step{"layers", 0, 0, job.render.output};
  return {[&lines, start, step](double done) { lines.report(done, seconds_since(start), step); },
          [&stop] { return stop.requested(); }};
}

void write_layer_files(const LayersJob& job, const ods::LayeredScene& layers, const ods::Progress& progress,
                       ProgressLines& lines) {
  std::optional<ods::PrivateFolder> draft;  // of a page, which gets copies of the files
  if (job.is_page) draft.emplace();
  const fs::path path = draft ? fs::path(draft->path()) / job.page_file : fs::path(job.render.output);
  const fs::path picture = layers.fallback.empty() ? fs::path() : path.parent_path() / layers.fallback;
  const bool makes_picture = !picture.empty() && !fs::exists(picture);
  const uint64_t bytes =
      ods::write_layers(layers, path, job.write, ods::part_of(progress, 0.0, makes_picture ? kShareOfScene : 1.0));
  if (makes_picture) {
    ods::write_layered_picture(layers, picture, picture_options(job, layers.width),
                               ods::part_of(progress, kShareOfScene, 1.0));
  }
  lines.clear();
  report_cost(layers, bytes);
  if (draft) return announce_file(export_site({ods::open_view_item(path)}, job.render.output));
  announce_file(path);
  if (makes_picture) announce_file(picture);
}

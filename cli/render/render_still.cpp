// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_still.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/console/interrupt.h"
#include "cli/render/finish_picture.h"
#include "cli/render/unfinished_picture.h"
#include "ods/render/part_file.h"
#include "ods/render/render_target.h"

namespace {

const char* stopping_words() {
  if (console.quiet) return "";
  if (console.json) return "{\"note\":\"stopping; a second signal ends at once\"}\n";
  return stderr_is_terminal() ? "\r\x1b[Kods: stopping; Ctrl-C again ends at once\n" : "ods: stopping\n";
}

Rendered finish(const RenderJob& job, const ods::StereoCamera& camera, const ods::RenderOptions& options,
                ods::PictureSamples samples) {
  const auto taken = static_cast<double>(ods::count_samples(samples));
  if (job.part) return {{ods::save_part(job.output, sampled_picture(job, options, camera), samples)}, taken};
  return {finish_picture(job, camera, ods::develop(std::move(samples), options), job.output), taken};
}

[[noreturn]] void end_early(const RenderJob& job, const ods::StereoCamera& camera, const ods::RenderOptions& options,
                            ods::PictureSamples& samples, const UnfinishedPicture& unfinished, const GentleStop& stop) {
  if (unfinished.is_kept()) {
    const std::string& path = unfinished.path();
    note(fmt::format("what is rendered is kept in '{}': the same command with --resume goes on{}", path,
                     job.save_unfinished ? "" : fmt::format(", ods merge '{}' -o FILE saves it as it is", path)));
  }
  if (job.save_unfinished) {
    for (const std::string& file : finish(job, camera, options, std::move(samples)).files) announce_file(file);
  }
  stop.end();
}

}  // namespace

Rendered render_still(const RenderJob& job, const ods::CpuRenderer& renderer,
                      std::span<const ods::StereoCamera> cameras, const ods::RenderOptions& options,
                      const ods::Progress& progress) {
  const ods::StereoCamera& camera = cameras[cameras.size() / 2];
  ods::check_picture_memory(options);
  UnfinishedPicture unfinished(job, options, camera);
  ods::PictureSamples samples = unfinished.begin();
  {
    const GentleStop stop(stopping_words());
    ods::Progress stoppable = progress;
    stoppable.cancelled = [&] { return stop.requested(); };
    try {
      renderer.sample(cameras, options, samples, stoppable,
                      [&](const ods::PictureSamples& now) { unfinished.keep(now); });
    } catch (const ods::Error& error) {
      if (error.kind() != ods::ErrorKind::kCancelled) throw;
      end_early(job, camera, options, samples, unfinished, stop);
    }
  }
  Rendered rendered = finish(job, camera, options, std::move(samples));
  unfinished.remove();
  return rendered;
}

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_still.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "cli/console/console.h"
#include "cli/console/interrupt.h"
#include "cli/render/plan.h"
#include "cli/render/unfinished_picture.h"
#include "ods/picture/cryptomatte.h"
#include "ods/render/part_file.h"
#include "ods/render/render_target.h"
#include "ods/scene/things.h"

namespace {

const char* stopping_message() {
  if (console.quiet) return "";
  if (console.json) return "{\"note\":\"stopping; a second signal ends at once\"}\n";
  return stderr_is_terminal() ? "\r\x1b[Kods: stopping; Ctrl-C again ends at once\n" : "ods: stopping\n";
}

std::optional<ods::ObjectLayer> objects_of(const RenderJob& job, const ods::FrameRenderer& renderer,
                                           const ods::StereoCamera& camera, const ods::RenderOptions& options) {
  if (!job.object_layer) return {};
  const ods::Things things = ods::things_of(renderer.scene());
  std::vector<float> numbers;
  for (const std::string& name : things.names) numbers.push_back(name.empty() ? 0.0f : ods::matte_number(name));
  ods::ObjectLayer layer{{}, things.names};
  for (const std::vector<ods::Hit>& hits : renderer.renderer().center_hits(camera, options)) {
    ods::Image& image = layer.numbers.emplace_back(options.width, options.height, 1);
    for (size_t i = 0; i < hits.size(); i++) {
      if (hits[i].t < 0.0f) continue;
      image.pixels[i] = numbers[static_cast<size_t>(things.of_instance[static_cast<size_t>(hits[i].instance)])];
    }
  }
  return layer;
}

// `unfinished` identifies the samples.
ods::Rendered finish(const RenderJob& job, const ods::FinishOptions& finish, UnfinishedPicture& unfinished,
                     ods::PictureSamples samples, std::optional<ods::ObjectLayer> objects) {
  const auto taken = static_cast<double>(ods::count_samples(samples));
  if (job.part) return {{ods::save_part(job.output, unfinished.about(), samples)}, taken};
  return {
      ods::finish_picture(finish, job.render, unfinished.camera(),
                          ods::develop(std::move(samples), unfinished.options()), job.output, {}, std::move(objects)),
      taken};
}

[[noreturn]] void end_early(const RenderJob& job, const ods::FinishOptions& finishing, ods::PictureSamples& samples,
                            std::optional<ods::ObjectLayer> objects, UnfinishedPicture& unfinished,
                            const GentleStop& stop) {
  if (unfinished.is_kept()) {
    const std::string& path = unfinished.path();
    note(fmt::format("progress is saved in '{}': the same command resumes{}, --restart starts over", path,
                     job.save_unfinished ? "" : fmt::format(", ods merge '{}' -o FILE saves it as it is", path)));
  }
  if (job.save_unfinished) {
    const ods::Rendered rendered = finish(job, finishing, unfinished, std::move(samples), std::move(objects));
    for (const std::string& file : rendered.files) announce_file(file);
  }
  stop.end();
}

}  // namespace

ods::Rendered render_still(const RenderJob& job, ods::FrameRenderer& renderer, const ods::SequenceFrame& frame,
                           const std::function<void(double done)>& report) {
  const ods::Shot shot = renderer.set(frame);
  const ods::StereoCamera& camera = shot.camera();
  ods::RenderOptions options = shot.options;
  const ods::RenderOptions sampled = plan(job).sampled;
  options.layers = sampled.layers;
  options.statistics = sampled.statistics;
  ods::check_picture_memory(options);
  const ods::FinishOptions& finishing = renderer.options().finish;
  UnfinishedPicture unfinished(job, options, camera, finishing.save);
  ods::PictureSamples samples = unfinished.begin();
  std::optional<ods::ObjectLayer> objects = objects_of(job, renderer, camera, options);
  {
    const GentleStop stop(stopping_message());
    const double share = finishing.denoiser == ods::Denoiser::kNone ? 1.0 : ods::kShareOfRendering;
    ods::Progress progress;
    progress.report = [&](double done) { report(share * done); };
    progress.cancelled = [&] { return stop.requested(); };
    try {
      renderer.renderer().sample(shot.cameras, options, samples, progress,
                                 [&](const ods::PictureSamples& now) { unfinished.keep(now); });
    } catch (const ods::Error& error) {
      if (error.kind() != ods::ErrorKind::kCancelled) throw;
      end_early(job, finishing, samples, std::move(objects), unfinished, stop);
    }
  }
  ods::Rendered rendered = finish(job, finishing, unfinished, std::move(samples), std::move(objects));
  unfinished.remove();
  return rendered;
}

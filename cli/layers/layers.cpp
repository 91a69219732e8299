// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods layers: bakes a scene for eyes that move within a box.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/interrupt.h"
#include "cli/console/long_job.h"
#include "cli/layers/film_bake.h"
#include "cli/layers/film_job.h"
#include "cli/layers/layer_files.h"
#include "cli/layers/layers_job.h"
#include "cli/layers/layers_of_picture.h"
#include "cli/render/device.h"
#include "cli/render/first_look.h"
#include "cli/render/plan.h"
#include "ods/layers/light/light_layers.h"
#include "ods/layers/probes/light_probes.h"
#include "ods/sequence/frame_renderer.h"
#include "ods/sequence/identity.h"
#include "ods/sequence/looks.h"
#include "ods/stage/exposure.h"

namespace {

namespace fs = std::filesystem;

// The ends of the steps, as fractions of the whole time.
constexpr double kGeometry = 0.15, kLight = 0.92;

std::string unfinished_path(const RenderJob& job) {
  return job.output + ".unfinished";
}

ods::LayerLight light_of(const RenderJob& job, const ods::RenderOptions& options, const ods::SequenceOptions& look) {
  ods::LayerLight light;
  light.exposure = look.finish.save.exposure;
  light.tone = look.finish.save.tone;
  light.bake.render = options;
  light.bake.is_denoised = look.finish.denoiser != ods::Denoiser::kNone;
  light.bake.unfinished = unfinished_path(job);
  light.bake.scene = identified(job).scene;
  return light;
}

void report_geometry(const ods::LayerCounts& counts, double seconds) {
  note(fmt::format("{} of the scene's triangles are seen; {} after simplifying and cutting, {} charts, in {}",
                   counts.seen_triangles, counts.triangles, counts.charts, duration_text(seconds)));
  note(fmt::format("holes: {:.3f} % of what other eyes in the box see, at worst {:.3f} %", 100.0 * counts.holes.share,
                   100.0 * counts.holes.worst));
}

// They take seconds, after the light: an interruption now would lose it.
ods::LightProbes probes_of(const ods::Scene& scene, const ods::HeadBox& box, const ods::RenderOptions& render) {
  ods::ProbeOptions options;
  options.render = render;
  return ods::light_probes(scene, box, options);
}

// Makes something of the scene without what moves. lamps_remain: but with its light.
template <typename Make>
auto without_movers(ods::Scene& scene, const std::vector<ods::Mover>& movers, bool lamps_remain, const Make& make) {
  ods::HiddenMovers hidden = ods::hide_movers(scene, movers, lamps_remain);
  auto made = make();
  ods::show_movers(scene, std::move(hidden));
  return made;
}

void bake_layers(const LayersJob& given, ProgressLines& lines) {
  ods::Scene scene = open_lit_scene(given.render.scene, false);
  const RenderJob job = on_device(given.render, scene);
  TimeOptions time = job.time;
  start_clock(time, job.camera, scene);
  ods::SequenceOptions sequence = plan(job, time).sequence;
  sequence.shutter = 0.0;
  ods::FrameRenderer renderer(std::move(sequence), scene);
  const std::vector<ods::SequenceFrame> frames = layer_frames(given, time);
  report_viewpoint(job, renderer, frames.front());
  const ods::FirstLook look = ods::look_first(renderer, frames);
  ods::SequenceOptions options = renderer.options();
  report_look(job, options, look);
  options.finish.save.exposure = look.exposure;
  options.finish.save.tone = job.tone.value_or(ods::usual_tone(scene));
  const ods::Shot shot = renderer.set(frames.front());
  const ods::HeadBox box{shot.camera().position, ods::vec3(given.box)};
  const int width = given.width.value_or(2 * job.render.width);

  const auto start = std::chrono::steady_clock::now();
  const GentleStop stop("ods: stopping\n");
  const ods::Progress progress = layers_progress(given, lines, stop);
  try {
    FilmJob film = plan_film(given, scene, frames, box, width);
    ods::LayerCounts counts;
    ods::LayerGeometry geometry = without_movers(scene, film.movers, false, [&] {
      return ods::build_layers(scene, box, width, &counts, ods::part_of(progress, 0.0, kGeometry));
    });
    geometry.scene.yaw = shot.camera().yaw;
    geometry.scene.fallback = given.fallback;
    geometry.scene.name = fs::path(job.scene.name).filename().string();
    if (!film.movers.empty()) film.still = ods::coarse_layers(geometry, width);
    report_geometry(counts, seconds_since(start));
    ods::LayerLight light = light_of(job, shot.options, options);
    if (job.restart) remove_unfinished(unfinished_path(job), film.lights);
    light.bake.keeps_unfinished = !film.movers.empty();
    const double still = kLight - (kLight - kGeometry) * share_of_film(film, counts.page_texels + counts.chart_texels);
    ods::LayeredScene layers = without_movers(scene, film.movers, true, [&] {
      ods::FrameRenderer own(options, scene);
      own.set(frames.front());
      ods::LayeredScene lit = ods::light_layers(std::move(geometry), scene, own.renderer(), light,
                                                ods::part_of(progress, kGeometry, still));
      lit.light.probes = probes_of(scene, box, shot.options);
      light_without(film, own.renderer(), light, {{}, progress.cancelled});
      return lit;
    });
    const std::vector<size_t> lights = film.lights;
    layers.film = light_of_film(std::move(film), scene, box, options, light, ods::part_of(progress, still, kLight));
    write_layer_files(given, layers, ods::part_of(progress, kLight, 1.0), lines);
    remove_unfinished(unfinished_path(job), lights);
  } catch (const ods::Error& error) {
    if (error.kind() != ods::ErrorKind::kCancelled) throw;
    if (fs::exists(unfinished_path(job))) note("the light so far is kept: the same command resumes");
    stop.end();
  }
}

void layers(const LayersJob& given) {
  check_layer_files(given);
  if (given.is_picture) return layers_of_picture(given);
  LayersJob job = given;
  job.render = settled(given.render);
  run_long_job(job.render.progress, job.render.render.threads, [&](ProgressLines& lines) { bake_layers(job, lines); });
}

}  // namespace

extern const Command kLayers =
    make_command<parse_layers, layers>("layers", "bake a scene for a head that moves within a box");

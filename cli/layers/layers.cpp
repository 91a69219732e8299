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
  std::error_code ignored;
  if (job.restart) fs::remove(light.bake.unfinished, ignored);
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

void bake_layers(const LayersJob& given, ProgressLines& lines) {
  ods::Scene scene = open_lit_scene(given.render.scene, false);
  const RenderJob job = on_device(given.render, scene);
  TimeOptions time = job.time;
  start_clock(time, job.camera, scene);
  ods::FrameRenderer renderer(plan(job, time).sequence, scene);
  const ods::SequenceFrame frame{0, double{time.time.value_or(0.0f)}, job.output, job.render.seed};
  report_viewpoint(job, renderer, frame);
  const ods::FirstLook look = ods::look_first(renderer, {frame});
  ods::SequenceOptions options = renderer.options();
  report_look(job, options, look);
  options.finish.save.exposure = look.exposure;
  if (scene.as_painted && !job.tone) options.finish.save.tone = ods::ToneCurve::kLinear;
  const ods::Shot shot = renderer.set(frame);

  const auto start = std::chrono::steady_clock::now();
  const GentleStop stop("ods: stopping\n");
  const ods::Progress progress = layers_progress(given, lines, stop);
  try {
    ods::LayerCounts counts;
    ods::LayerGeometry geometry =
        ods::build_layers(scene, {shot.camera().position, ods::vec3(given.box)},
                          given.width.value_or(2 * job.render.width), &counts, ods::part_of(progress, 0.0, kGeometry));
    geometry.scene.yaw = shot.camera().yaw;
    geometry.scene.fallback = given.fallback;
    geometry.scene.name = fs::path(job.scene.name).filename().string();
    report_geometry(counts, seconds_since(start));
    ods::LayeredScene layers =
        ods::light_layers(std::move(geometry), scene, renderer.renderer(), light_of(job, shot.options, options),
                          ods::part_of(progress, kGeometry, kLight));
    layers.light.probes = probes_of(scene, layers.box, shot.options);
    write_layer_files(given, layers, ods::part_of(progress, kLight, 1.0), lines);
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

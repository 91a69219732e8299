// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods render: a scene becomes a stereo 360 picture.
#include "ods/cpu/render.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <chrono>
#include <iostream>
#include <optional>

#include "cli/camera_options.h"
#include "cli/console.h"
#include "cli/form_options.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/scene_source.h"
#include "ods/image/save.h"

namespace {

// What --quality sets; --width and --samples go before it.
struct Quality {
  std::string_view name;
  int width;
  int samples;
};
constexpr Quality kQualities[] = {{"draft", 1024, 16}, {"preview", 2048, 64}, {"final", 4096, 512}};

struct RenderJob {
  SceneSource scene;
  CameraOptions camera;
  Quality quality = kQualities[1];
  ods::RenderOptions render;
  ods::SaveOptions save;
  std::string output;
  ProgressMode progress = ProgressMode::kAuto;
};

constexpr const char* kExamples =
    "  ods render scene.glb -o picture.png\n"
    "  ods render scene.glb -o picture.exr --width 4096 --samples 256 --env sky.hdr\n"
    "  ods render scene.glb -o picture.jpg --position 0,1.6,0 --yaw 90 --quality draft\n"
    "  ods render scene.glb -o eye_%V.png         eye_left.png and eye_right.png\n"
    "  ods render scene.glb -o picture.png --merge cosine,60,90";

void add_picture_options(Options& options, RenderJob& job) {
  options.group("Picture");
  options.text("-o,--output", "FILE", job.output, ".png .jpg .tif .webp .hdr .exr; %V in its name: a file per eye");
  add_size_option(options, job.render, job.save.layout);
  options.number("--width", job.render.width, 1, 32768, "of one eye in pixels");
  options.number("--height", job.render.height, 0, 32768, "0: as its projection's shape has it, half for lat-long");
  options.choice("--eyes", job.render.eyes, ods::kAllEyes, ods::eyes_name, "which eyes");
  add_layout_option(options, job.save.layout, "how two eyes share the file");
  options.flag("--sidecar", job.save.sidecar, "write picture.camera.json too, which ods camera reads");
  options.number("--exposure", job.save.exposure, -30.0f, 30.0f, "stops; .hdr and .exr keep the scene's light");
  options.choice("--tone", job.save.tone, ods::kToneCurves, ods::tone_curve_name, "tone curve, likewise");
}

void add_render_options(Options& options, RenderJob& job) {
  options.group("Quality");
  std::string sizes;
  for (const Quality& q : kQualities) sizes += fmt::format(", {} {} x {} samples", q.name, q.width, q.samples);
  auto name_of = [](Quality quality) { return quality.name; };
  options.choice("--quality", job.quality, kQualities, +name_of, "width and samples at once" + sizes);
  options.number("--samples", job.render.samples, 1, 1 << 20, "per pixel");
  options.number("--bounces", job.render.bounces, 0, 1024, "of light");
  options.choice("--filter", job.render.filter, ods::kPixelFilters, ods::pixel_filter_name, "of the pixel");
  options.number("--seed", job.render.seed, "the same seed gives the same picture");
  options.number("--threads", job.render.threads, 0, 1024, "0: all processors");
}

void add_console_options(Options& options, RenderJob& job) {
  options.group("Console");
  options.choice("--progress", job.progress, kProgressModes, progress_mode_name,
                 "deadline, openjd and tractor go to stdout; json makes every line on stderr an object");
  options.flag("-q,--quiet", console.quiet, "say nothing but errors");
  options.flag("--no-color", console.no_color, "as the environment variable NO_COLOR");
}

bool read_options(RenderJob& job, int argc, char** argv) {
  Options options("render", "Makes a stereo 360 picture of a scene.", kExamples);
  add_scene_argument(options, job.scene);
  add_light_options(options, job.scene);
  add_picture_options(options, job);
  add_camera_options(options, job.camera);
  add_render_options(options, job);
  add_console_options(options, job);
  if (!options.parse(argc, argv)) return false;
  if (job.output.empty()) throw UsageError("where to? -o picture.png");
  if (!options.given("--width") && !options.given("--size")) job.render.width = job.quality.width;
  if (!options.given("--samples")) job.render.samples = job.quality.samples;
  job.render.layers = ods::keeps_layers(job.output);
  if (options.given("--width") && !options.given("--height")) job.render.height = 0;
  finish_camera_options(job.camera, job.render.width, job.render.height);
  console.json = job.progress == ProgressMode::kJson;
  if (job.progress == ProgressMode::kAuto) {
    job.progress = console.quiet          ? ProgressMode::kNone
                   : stderr_is_terminal() ? ProgressMode::kBar
                                          : ProgressMode::kPlain;
  }
  return true;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void render_to_file(const RenderJob& job, ProgressLines& lines) {
  ods::check_output(job.output, job.save, ods::eye_list(job.render.eyes), {job.render.width, job.render.height});
  ods::Scene scene = open_scene(job.scene);
  add_environment(scene, job.scene);
  ods::CameraRig rig = place_camera(job.camera, scene);

  auto start = std::chrono::steady_clock::now();
  ods::Progress progress;
  progress.report = [&](double done) { lines.report(done, seconds_since(start)); };
  ods::Picture picture = ods::render_cpu(scene, rig, job.render, progress);
  double seconds = seconds_since(start);
  lines.clear();

  std::vector<std::string> files = ods::save_picture(picture, rig, job.save, job.output);
  for (const std::string& file : files) std::cout << file << std::endl;
  double samples = 1.0 * job.render.width * job.render.height * job.render.samples;
  samples *= static_cast<double>(picture.eyes.size());
  note(fmt::format("{} in {}, {:.3g} Msamples/s", files.front(), duration_text(seconds), samples / seconds * 1e-6));
}

void render(int argc, char** argv) {
  RenderJob job;
  if (!read_options(job, argc, argv)) return;
  end_on_interrupts(interrupted_line(job.progress));
  std::optional<tbb::global_control> limit;
  if (job.render.threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, job.render.threads);
  ProgressLines lines(job.progress, progress_is_for_farm(job.progress) ? std::cout : std::cerr);
  try {
    render_to_file(job, lines);
  } catch (const std::exception& error) {
    lines.fail(error.what());
    throw;
  }
}

}  // namespace

extern "C" int ods_render(int argc, char** argv) {
  return run_command([=] { render(argc, argv); });
}

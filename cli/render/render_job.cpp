// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_job.h"

#include <fmt/format.h>

#include <cctype>
#include <vector>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/picture_options.h"
#include "ods/render/picture_samples.h"

namespace {

constexpr Quality kQualities[] = {
    {"draft", 1024, 64, 0.3f}, {"preview", 2048, 512, 0.1f}, {"final", 4096, 4096, 0.02f}};

constexpr const char* kExamples =
    "  ods render scene.glb -o picture.png\n"
    "  ods render scene.glb -o picture.exr --width 4096 --samples 256 --env sky.hdr\n"
    "  ods render scene.glb -o picture.jpg --position 0,1.6,0 --yaw 90 --quality draft\n"
    "  ods render scene.glb -o eye_%V.png         eye_left.png and eye_right.png\n"
    "  ods render scene.glb -o picture.png --merge cosine,60,90\n"
    "  ods render scene.glb -o shot.####.exr --frames 1-100 --fps 30\n"
    "  ods render scene.glb -o 'views/####.exr' --rig rig.json";

// Noise cannot fall to 0; at 10 everything is clean.
float parse_noise(const std::string& word) {
  if (word == "none") return 0.0f;
  const std::vector<float> numbers = parse_numbers(word);
  if (numbers.size() == 1 && numbers[0] >= 1e-4f && numbers[0] <= 10.0f) return numbers[0];
  throw UsageError(fmt::format("--noise is a number from 0.0001 to 10, or none, not '{}'", word));
}

// Seconds.
double parse_time_limit(const std::string& word) {
  double unit = 1.0;
  std::string number = word;
  if (!word.empty() && std::isalpha(static_cast<unsigned char>(word.back()))) {
    unit = word.back() == 's' ? 1.0 : word.back() == 'm' ? 60.0 : word.back() == 'h' ? 3600.0 : 0.0;
    number.pop_back();
  }
  const std::vector<float> numbers = parse_numbers(number);
  const double seconds = numbers.size() == 1 ? double{numbers[0]} * unit : 0.0;
  if (seconds > 0.0 && seconds <= 1e7) return seconds;
  throw UsageError(fmt::format("--time-limit is a time above 0, such as 90s, 10m or 1.5h, not '{}'", word));
}

void add_picture_options(Options& options, RenderJob& job) {
  options.group("Picture");
  options.text("-o,--output", "FILE", job.output,
               "output file: .png .jpg .tif .webp .hdr .exr; %V in the name writes one file per eye");
  add_picture_options(options, job.render, job.save);
  options.text("--rig", "FILE", job.rig, "render the views of this rig (made by ods rig), for ods stitch");
  options.flag("--statistics", job.render.statistics,
               "also write each pixel's variance and number of samples, for ods denoise (.exr)");
  options.flag("--transparent", job.render.transparent,
               "leave the background transparent, for ods over; the sky still lights the scene (.exr .png .tif .webp)");
  options.texts(
      "--shadow-catcher", "NAME", job.scene.catchers,
      "make an object or material a shadow catcher: only the shadows on it are visible (needs --transparent)");
  options.number("--exposure", job.save.exposure, -30.0f, 30.0f,
                 "exposure in stops; .hdr and .exr stay scene-linear and ignore it");
  options.choice("--tone", job.save.tone, ods::kToneCurveTable, "tone curve; ignored as --exposure is");
}

// A rig has its own cameras and size.
void check_rig(const Options& options, const RenderJob& job) {
  if (job.rig.empty()) return;
  for (const char* own : {"--width", "--height", "--size", "--eyes", "--layout", "--position", "--camera", "--yaw",
                          "--pitch", "--roll", "--ipd", "--projection", "--frames", "--shutter"}) {
    if (options.given(own)) throw UsageError(fmt::format("{} cannot be used with --rig", own));
  }
}

}  // namespace

void add_quality_options(Options& options, RenderJob& job, Quality& quality) {
  quality = kQualities[1];
  options.group("Quality");
  std::string sizes;
  std::vector<std::string> names;
  for (const Quality& q : kQualities) {
    sizes += fmt::format(", {} {} x {} x {:g}", q.name, q.width, q.samples, q.noise);
    names.emplace_back(q.name);
  }
  options.choice(
      "--quality", names, std::string(quality.name), [&](size_t i) { quality = kQualities[i]; },
      "set width, --samples and --noise together" + sizes);
  options.custom(
      "--noise", "LEVEL|none", "", [&](const std::string& word) { job.render.noise = parse_noise(word); },
      "parts of the picture that are as clean as this get no more samples; in Cycles' measure, where 0.01 is its "
      "default. none: every pixel gets all samples");
  options.number("--samples", job.render.samples, 1, ods::kMaxSamples, "the most samples that a pixel gets");
  options.custom(
      "--time-limit", "TIME", "", [&](const std::string& word) { job.render.time_limit = parse_time_limit(word); },
      "the best picture that takes no longer, for each frame of a video: 90s, 10m, 1.5h. It depends on the machine");
  options.number("--bounces", job.render.bounces, 0, 1024, "maximum number of light bounces");
  options.choice("--filter", job.render.filter, ods::kPixelFilterTable, "pixel filter");
  options.number("--seed", job.render.seed, "random seed; the same seed gives the same picture");
  options.number("--threads", job.render.threads, 0, 1024, "number of threads; 0: all processors");
}

void finish_render_job(const Options& options, const Quality& quality, RenderJob& job) {
  check_time_options(job.time);
  if (!options.given("--width") && !options.given("--size")) job.render.width = quality.width;
  if (!options.given("--samples")) job.render.samples = quality.samples;
  if (!options.given("--noise")) job.render.noise = quality.noise;
  job.has_layout = options.given("--layout") || options.given("--size");
  finish_picture_options(options, job.camera.stereo.projection, job.render, job.save);
  finish_camera_options(job.camera, job.render.width, job.render.height);
}

bool read_render_job(RenderJob& job, int argc, char** argv) {
  Quality quality;
  Options options("render", "Renders a scene as a stereo 360 picture, or as the frames of a video.", kExamples);
  add_scene_argument(options, job.scene);
  add_light_options(options, job.scene);
  add_picture_options(options, job);
  add_camera_options(options, job.camera);
  add_time_options(options, job.time);
  add_quality_options(options, job, quality);
  options.group("Console");
  add_progress_options(options, job.progress);
  if (!options.parse(argc, argv)) return false;
  if (job.output.empty()) throw UsageError("no output file: add -o picture.png");
  if (options.given("--exposure") && keeps_light(job.output))
    note("--exposure does not change .exr and .hdr, which are scene-linear");
  if (job.render.transparent && !ods::has_alpha(job.output)) {
    throw UsageError("--transparent needs a format with alpha: .exr, .png, .tif or .webp");
  }
  if (!job.scene.catchers.empty() && !job.render.transparent) {
    throw UsageError("--shadow-catcher needs --transparent");
  }
  if (job.render.statistics && !ods::keeps_layers(job.output)) throw UsageError("--statistics needs an .exr");
  job.render.layers = ods::keeps_layers(job.output);
  check_rig(options, job);
  finish_render_job(options, quality, job);
  return true;
}

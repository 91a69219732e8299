// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/render/device.h"
#include "cli/render/render_with_cycles.h"
#include "ods/denoise/oidn.h"
#include "ods/files/frames.h"
#include "ods/stage/exposure.h"

namespace {

constexpr const char* kRenderExamples =
    "  ods render scene.glb -o picture.png\n"
    "  ods render scene.glb -o picture.exr --width 4096 --samples 256 --env sky.hdr\n"
    "  ods render scene.glb -o picture.jpg --position 0,1.6,0 --yaw 90 --quality draft\n"
    "  ods render scene.glb -o eye_%V.png         eye_left.png and eye_right.png\n"
    "  ods render scene.glb -o picture.png --merge cosine,60,90\n"
    "  ods render scene.glb -o shot.####.exr --frames 1-100 --fps 30\n"
    "  ods render scene.glb -o part_3.exr --part 3/8   for ods merge 'part_#.exr'\n"
    "  ods render scene.glb -o 'views/####.exr' --rig rig.json";

// Parses the value of --exposure. Returns nullopt for auto.
std::optional<float> parse_exposure(const std::string& word) {
  if (word == "auto") return std::nullopt;
  const std::vector<float> numbers = parse_numbers(word);
  if (numbers.size() == 1 && numbers[0] >= -ods::kMaxStops && numbers[0] <= ods::kMaxStops) return numbers[0];
  throw UsageError(fmt::format("--exposure is auto or a number of stops from {} to {}, not '{}'", -ods::kMaxStops,
                               ods::kMaxStops, word));
}

void add_picture_options(Options& options, RenderJob& job) {
  options.group("Picture");
  options.text("-o,--output", ValueKind::output_file(), job.output,
               "output file: .png .jpg .tif .webp .hdr .exr; %V in the name writes one file per eye");
  add_picture_options(options, job.form, job.save.sidecar);
  options.text("--rig", ValueKind::input_file(), job.rig,
               "render the views of this rig (made by ods rig), for ods stitch");
  options.flag("--statistics", job.render.statistics,
               "also write each pixel's variance and number of samples, for ods denoise (.exr)");
  options.flag("--object-layer", job.object_layer,
               "also write which object each pixel shows, by name: a Cryptomatte, which ods comfort reads (.exr)");
  options.flag("--transparent", job.render.transparent,
               "leave the background transparent, for ods over; the sky still lights the scene (.exr .png .tif .webp)");
  options.texts(
      "--shadow-catcher", "NAME", job.scene.catchers,
      "make an object or material a shadow catcher: only the shadows on it are visible (needs --transparent)");
  add_object_options(options, job.scene.objects, "the scene");
  add_exposure_option(options, job);
  options.choice("--tone", job.tone, ods::kToneCurveTable, "tone curve; .hdr and .exr ignore it",
                 std::string(ods::tone_curve_name(job.save.tone)));
}

void read_part(const std::string& word, RenderJob& job) {
  job.part = ods::parse_part(word);
  if (!job.part) throw UsageError(fmt::format("--part is a part and the number of parts, such as 3/8, not '{}'", word));
  job.render.part = *job.part;
}

void add_long_options(Options& options, RenderJob& job) {
  options.group("Long renders of one picture");
  add_restart_option(options, job.restart);
  options.flag("--save-unfinished", job.save_unfinished, "when interrupted (Ctrl-C, kill), save the picture as it is");
  options.custom(
      "--part", "I/N", "", [&](const std::string& word) { read_part(word, job); },
      "render one of N parts of the samples as an .exr, for ods merge: 3/8; # in the file's name is the part");
  options.number("--parts", job.parts, 2, 4096, "with ods submit: render this many parts, merge and remove them");
  options.flag("--keep-parts", job.keep_parts, "with --parts: keep the parts after they are merged");
}

// Cycles' samples may be the file's.
void check_part(const ods::RenderOptions& render) {
  if (render.part.count <= render.samples) return;
  throw UsageError(fmt::format("{} samples cannot be split into {} parts", render.samples, render.part.count));
}

// Parts are exact shares of a fixed number of samples.
void check_long_job(const Options& options, const RenderJob& job) {
  const std::vector<std::string> own = {"--restart", "--save-unfinished", "--part", "--parts"};
  if (makes_video(job.time)) options.refuse(own, "is for one picture; frames continue with --skip-existing");
  if (!job.rig.empty()) options.refuse(own, "cannot be used with --rig");
  if (!job.part) return;
  options.refuse({"--noise", "--time-limit", "--save-unfinished"}, "cannot be used with --part");
  options.refuse({"--denoise", "--layout"}, "cannot be used with --part: it is for ods merge");
  if (!ods::keeps_layers(job.output)) throw UsageError("--part needs an .exr, which ods merge reads");
  if (job.renderer == Renderer::kOds) check_part(job.render);
}

// A rig has its own cameras and size.
void check_rig(const Options& options, const RenderJob& job) {
  if (job.rig.empty()) return;
  options.refuse({"--width", "--height", "--size", "--eyes", "--layout", "--position", "--camera", "--yaw", "--pitch",
                  "--roll", "--ipd", "--projection", "--frames", "--shutter", "--device"},
                 "cannot be used with --rig");
}

}  // namespace

void add_exposure_option(Options& options, RenderJob& job) {
  options.custom(
      "--exposure", "auto|STOPS", "auto", [&](const std::string& word) { job.exposure = parse_exposure(word); },
      "exposure in stops. auto: suits the light in a first small picture; the same for both eyes and all frames; "
      ".hdr and .exr stay scene-linear and ignore it");
  options.number("--brighter", job.brighter, -ods::kMaxStops, ods::kMaxStops,
                 "stops added to the exposure, given or auto: 1 is twice as bright, -1 half");
}

void add_wait_option(Options& options, float& seconds, const char* noun) {
  options.number("--wait", seconds, 0.0f, 3600.0f,
                 fmt::format("seconds to wait for {} of other machines that a shared disk does not show yet", noun));
}

void finish_render_options(Options& options, RenderJob& job) {
  check_time_options(job.time);
  if (!job.time.only.empty() && !makes_video(job.time) && job.rig.empty()) {
    throw UsageError("--only chooses among frames, or among the views of --rig; this is one picture");
  }
  check_objects(job.scene.objects);
  job.given = options.given_words();
  if (job.renderer == Renderer::kCycles) check_cycles_options(job.given);
  job.scene.has_places =
      !job.rig.empty() || job.camera.position || job.time.move.pivot || !job.time.move.fly_to.empty();
  job.scene.camera = job.camera.view_point;
  job.time.fps = job.time.given_fps.value_or(job.time.fps);
  job.time.shutter = job.time.given_shutter.value_or(0.0f);
  finish_quality(job);
}

RenderJob parse_render(Options& options) {
  RenderJob job;
  options.describe("Renders a scene as a stereo 360 picture, or as the frames of a video.", kRenderExamples);
  add_scene_argument(options, job.scene);
  add_light_options(options, job.scene.light);
  add_picture_options(options, job);
  add_camera_options(options, job.camera);
  add_time_options(options, job.time);
  add_quality_options(options, job);
  add_device_option(options, job);
  add_long_options(options, job);
  options.group("Console");
  add_progress_options(options, job.progress);
  options.parse();
  if (job.output.empty()) throw UsageError("no output file: add -o picture.png");
  if (job.keep_parts && job.parts == 0) throw UsageError("--keep-parts needs --parts N");
  const auto part_names = job.part ? ods::frame_names(job.output) : std::nullopt;
  if (part_names) job.output = part_names->path(job.part->number);
  if (job.render.transparent && !ods::has_alpha(job.output)) {
    throw UsageError("--transparent needs a format with alpha: .exr, .png, .tif or .webp");
  }
  if (job.render.transparent) options.refuse({"--background"}, "cannot be used with --transparent");
  if (!job.scene.catchers.empty() && !job.render.transparent) {
    throw UsageError("--shadow-catcher needs --transparent");
  }
  if (job.render.statistics && !ods::keeps_layers(job.output)) throw UsageError("--statistics needs an .exr");
  if (job.object_layer && (!ods::keeps_layers(job.output) || job.part || !job.rig.empty() || makes_video(job.time))) {
    throw UsageError("--object-layer is for one whole picture, an .exr");
  }
  job.render.layers = ods::keeps_layers(job.output);
  check_rig(options, job);
  finish_render_options(options, job);
  check_long_job(options, job);
  return job;
}

RenderJob settled(RenderJob job) {
  if (job.denoise == ods::Denoiser::kOidn) ods::check_oidn();
  if (job.renderer == Renderer::kCycles) {
    open_in_cycles(job);
    check_part(job.render);
  } else {
    read_foreign(job.scene);
  }
  if (const std::optional<ForeignScene>& foreign = job.scene.foreign) {
    job.time.fps = job.time.given_fps.value_or(foreign->fps.value_or(job.time.fps));
    job.time.file = foreign->frames;
    job.time.shutter = job.time.given_shutter.value_or(foreign->shutter);
  }
  take_base(job.camera, job.scene.foreign, job.scene.blender);
  use_form(job.form, job.camera, job.render, job.save);
  if (job.cycles) check_cycles_camera(job.camera.stereo);
  job.save.tone = job.tone.value_or(job.save.tone);
  return job;
}

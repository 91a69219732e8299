// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/convert_options.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/convert/right_eye_options.h"
#include "cli/options/eye_options.h"
#include "cli/options/field_option.h"
#include "cli/options/projection_options.h"

using ods::CameraField;

namespace {

constexpr const char* kConvertExamples =
    "  ods convert picture.png -o cubes.png --to cube-3x2\n"
    "  ods convert picture_TB.jpg -o headset.jpg --to vr180 --width 4096\n"
    "  ods convert picture.exr -o window.png --mono --to perspective --fov 70 --yaw 30 --pitch -10\n"
    "  ods convert picture.exr -o closer.exr --ipd 0.055 --merge cosine,60,90\n"
    "  ods convert panorama.jpg --depth depth.npy --depth-kind inverse --near 0.7 --far 30 -o stereo_360_TB.png\n"
    "  ods convert video_360_TB.mp4 -o headset_180_LR.mp4 --to vr180 --trim 0:10-0:20\n"
    "  ods convert 'shot_360_TB.####.png' -o 'cubes.####.png' --to cube-3x2";

constexpr const char* kConvertSummary =
    "Converts a stereo 360 picture, frames or a video to another projection, layout, size or convergence, or to\n"
    "single eyes. Pictures with depth (.exr of ods render, or --depth) can also get another eye distance or pole "
    "merge,\n"
    "or two eyes from one. What is not given stays as it is; a video keeps its codec, times, sound, colours and "
    "metadata.";

// "0:10-0:20", "10-", "-20.5".
ods::TimeSpan parse_span(const std::string& text) {
  const size_t dash = text.find('-');
  const std::string from = text.substr(0, dash), to = dash == std::string::npos ? "" : text.substr(dash + 1);
  const std::optional<double> start = from.empty() ? 0.0 : ods::parse_time(from);
  std::optional<double> end;
  if (!to.empty()) end = ods::parse_time(to);
  if (dash == std::string::npos || !start || (!to.empty() && !end) || (end && *end <= *start)) {
    throw UsageError(fmt::format("--trim is a span of time such as 0:10-0:20, 10- or -20.5, not '{}'", text));
  }
  return {*start, end};
}

void add_input_options(Options& options, ConvertOptions& given) {
  add_input_argument(
      options, ValueKind::input_file("IN"), given.files,
      "a picture (.png .jpg .tif .webp .hdr .exr .heic .avif), frames (#### in the name is the number) or a video "
      "(.mp4 .mov .mkv .webm)");
  add_depth_options(options, given.depth);
  options.group("Input");
  options.custom(
      "--projection", "NAME", "",
      [&](const std::string& name) { given.known.projection = projection_by_name("--projection", name); },
      "its projection");
  add_input_layout_option(options, given.known.layout, "its layout");
  add_lens_options(options, given.known);
  options.number(
      "--input-fov", given.input_fov, 1.0f, 360.0f,
      "the field of view of its fisheye or window, degrees, if its name does not say it (_FISHEYE190, _MKX200)");
  add_camera_file_option(options, given.camera.file, "its camera: a .camera.json file or a picture that carries it");
  options.custom(
      "--frames", "RANGE", "", [&](const std::string& text) { given.frames = ods::parse_frames(text); },
      "frames to convert, if the input is frames: 1-100, 1-100x2 or 1,5,10-20; by default all");
}

void add_output_options(Options& options, ConvertOptions& given) {
  options.group("Output");
  options.text("-o,--output", ValueKind::output_file(), given.output,
               "output file: .png .jpg .tif .webp .hdr .exr; #### in the name writes frames, .mp4 .mov .mkv .webm a "
               "video, %V one file per eye");
  add_share_options(options, given.share);
  PictureForm& form = given.form;
  add_size_option(options, form);
  options.number("--width", form.width, 0, 32768, "width of one eye in pixels; 0: keeps the input's resolution", "0");
  options.number("--height", form.height, 0, 32768,
                 "height of one eye in pixels; 0: follows from the width and projection", "0");
  options.choice("--eyes", form.eyes, ods::kEyesTable, "which eyes to make; by default the input's");
  options.flag("--mono", given.mono, "make a mono picture of one eye: the left one, or that of --eyes");
  add_layout_option(options, form.layout,
                    "how both eyes share the new file; by default from its name (_TB, _LR), else the input's, "
                    "side-by-side for --to-projection vr180",
                    "--to-layout");
  options.flag("--sidecar", given.sidecar,
               "also write the camera to picture.camera.json, which --camera-file of other commands reads");
  add_display_options(options, given.display);
}

void add_camera(Options& options, CameraOptions& camera) {
  add_projection_options(options, camera.changes.projection, "--to-projection,--to");
  options.group("Turn");
  add_field_option(options, "--yaw", camera.yaw, CameraField::kYaw, "turn to the right, degrees");
  add_field_option(options, "--pitch", camera.pitch, CameraField::kPitch, "tilt up, degrees; mono pictures only");
  add_field_option(options, "--roll", camera.roll, CameraField::kRoll, "roll clockwise, degrees; mono pictures only");
  camera.may_follow_depth = true;
  add_circle_options(options, camera);
}

void add_video(Options& options, ConvertOptions& given) {
  options.group("Video (by default encoded like the input)");
  options.custom(
      "--trim", "FROM-TO", "", [&](const std::string& text) { given.trim = parse_span(text); },
      "convert only this part of a video: 0:10-0:20, 10-, -20.5 (seconds, minutes, hours)");
  options.text("--stabilize", ValueKind::input_file(), given.turns,
               "how the camera was turned, to turn its video back: lines of TIME ROLL or TIME YAW PITCH ROLL");
  options.custom(
      "--fps", "X|N/M", "30", [&](const std::string& text) { given.rate = parse_rate(text); },
      "frames per second, if the input is frames");
  add_packing_options(options, given.video);
  add_restart_option(options, given.restart);
}

}  // namespace

ConvertOptions parse_convert(Options& options) {
  ConvertOptions given;
  given.words = options.words();
  options.describe(kConvertSummary, kConvertExamples);
  add_input_options(options, given);
  add_output_options(options, given);
  add_camera(options, given.camera);
  options.choice("--holes", given.holes, ods::kHolesTable,
                 "pixels that no eye of the input sees: filled from the background, or empty");
  add_video(options, given);
  add_right_eye_options(options, given.right);
  options.group("Console");
  options.number("--threads", given.threads, 0, 1024, "number of threads; 0: all processors");
  add_progress_options(options, given.progress);
  options.parse();
  given.video.rate = given.rate.value_or(given.video.rate);
  if (given.output.empty()) throw UsageError("no output file: add -o picture.png");
  if (given.form.height && given.form.given_width().value_or(0) == 0) throw UsageError("--height goes with --width");
  if (given.depth.path.empty()) options.refuse(depth_option_names(), "goes with --depth FILE");
  return given;
}

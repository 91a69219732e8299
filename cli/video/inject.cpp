// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods inject: writes 360 metadata into a video or a picture, without encoding it again.
#include <fmt/format.h>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/apple_option.h"
#include "cli/options/layout_options.h"
#include "cli/video/inject_job.h"
#include "ods/video/container/video_file.h"

namespace {

constexpr const char* kInjectExamples =
    "  ods inject video_360_TB.mp4                 as its name implies\n"
    "  ods inject video.mp4 -o tagged.mp4 --layout top-bottom --projection lat-long\n"
    "  ods inject video.mov --projection vr180 --layout side-by-side\n"
    "  ods inject video.mp4 --remove\n"
    "  ods inject panorama_360.jpg --yaw 90       GPano, which viewers of pictures read";

constexpr const char* kInjectSummary =
    "Writes into a video (mp4, mov, mkv, webm) how its eyes are laid out and which part of the sphere it shows:\n"
    "Spherical Video V2, and V1 where possible. Writes GPano into a picture of one eye (jpg, png, tif), and the "
    "camera\n"
    "into an exr. Only what you specify changes. What the file does not record comes from a sidecar, its name (_360_TB,\n"
    "_180_LR, ...) or its shape. Nothing is encoded again; samples and pixels stay the same. The new file replaces "
    "the\n"
    "old one when it is complete.";

InjectJob parse_inject(Options& options) {
  InjectJob job;
  std::string layout;
  options.describe(kInjectSummary, kInjectExamples);
  options.argument(ValueKind::input_file("FILE"), job.file, "the file: mp4, mov, mkv, webm; jpg, png, tif, exr");
  options.text("-o,--output", ValueKind::output_file(), job.output, "write this file and leave FILE unchanged");
  options.group("Metadata");
  options.text("--layout", "LAYOUT", layout, "mono, top-bottom, side-by-side, ...: how both eyes share a frame");
  options.text("--projection", "NAME", job.projection,
               "lat-long, vr180 or flat; videos also cubemap (right, left, up over down, front, back); .exr also any "
               "projection of ods convert");
  options.number("--yaw", job.yaw, -180.0f, 180.0f,
                 "video: turn the view to the left, degrees; picture: compass heading of its centre");
  options.number("--pitch", job.pitch, -90.0f, 90.0f, "tilt up, degrees");
  options.number("--roll", job.roll, -180.0f, 180.0f, "roll clockwise, degrees");
  options.number("--track", job.track, 0, 2147483647,
                 "number of the video track; by default the one with the largest picture");
  options.flag("--ambisonics", job.ambisonics,
               "mark four-channel sound as first-order ambisonics (AmbiX: W Y Z X, SN3D); mp4 and mov only");
  add_apple_option(options, job.for_apple);
  options.flag("--remove", job.remove, "remove all 360 and stereo metadata");
  options.group("Console");
  add_progress_options(options, job.progress);
  options.parse();
  if (job.remove) {
    options.refuse({"--layout", "--projection", "--yaw", "--pitch", "--roll", "--ambisonics", "--apple"},
                   "cannot be used with --remove");
  }
  job.is_mono = layout == "mono";
  if (!layout.empty() && !job.is_mono) job.layout = layout_by_name("--layout", layout);
  if (job.output.empty()) job.output = job.file;
  return job;
}

void inject(const InjectJob& job) {
  const bool is_video = ods::is_video(job.file);
  run_long_job(job.progress, 0,
               [&](ProgressLines& lines) { is_video ? inject_video(job, lines) : inject_picture(job); });
  announce_file(job.output);
}

}  // namespace

extern const Command kInject =
    make_command<parse_inject, inject>("inject", "write 360 and stereo metadata into a video or picture");

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods inject: makes a film or a picture say what it is, without encoding it again.
#include <fmt/format.h>

#include <iostream>

#include "cli/apple_option.h"
#include "cli/console.h"
#include "cli/inject_job.h"
#include "cli/layout_options.h"
#include "cli/long_job.h"
#include "ods/video/film.h"

namespace {

constexpr const char* kExamples =
    "  ods inject film_360_TB.mp4                 as its name says\n"
    "  ods inject film.mp4 -o tagged.mp4 --layout top-bottom --projection lat-long\n"
    "  ods inject film.mov --projection vr180 --layout side-by-side\n"
    "  ods inject film.mp4 --remove\n"
    "  ods inject panorama_360.jpg --yaw 90       GPano, which viewers of pictures read";

constexpr const char* kSummary =
    "Writes into a film (mp4, mov, mkv, webm) how its eyes are laid out and what of the sphere it shows: Spherical "
    "Video\n"
    "V2, and V1 where that can say it; into a picture of one eye (jpg, png, tif) GPano, into an exr its camera. Only "
    "what\n"
    "you ask for changes. What a film does not say is found by its sidecar, its name (_360_TB, _180_LR ...), its "
    "shape.\n"
    "Nothing is encoded again: samples and pixels stay as they are, and a complete new file takes the old one's place.";

bool read_options(InjectJob& job, ProgressMode& mode, int argc, char** argv) {
  Options options("inject", kSummary, kExamples);
  std::string layout;
  options.argument("FILE", job.file, "mp4, mov, mkv, webm; jpg, png, tif, exr");
  options.text("-o,--output", "FILE", job.output, "leave FILE as it is and write this one");
  options.group("What it says");
  options.text("--layout", "LAYOUT", layout,
               "mono, or how both eyes share a frame: top-bottom, side-by-side, ... by the names of ods render");
  options.text("--projection", "NAME", job.projection,
               "lat-long, vr180 or flat; of films cubemap (right, left, up over down, front, back); of an exr all of "
               "ods convert --help");
  options.number(
      "--yaw", job.yaw, -180.0f, 180.0f,
      "turn what a film shows to the left, degrees; of a picture: how far to the right of north its middle is");
  options.number("--pitch", job.pitch, -90.0f, 90.0f, "and up");
  options.number("--roll", job.roll, -180.0f, 180.0f, "and clockwise");
  options.number("--track", job.track, 0, 2147483647, "of several video tracks, by its number (the largest picture)");
  options.flag("--ambisonics", job.ambisonics,
               "its sound of four channels is first-order ambisonics (AmbiX: W Y Z X, SN3D); of mp4 and mov");
  add_apple_option(options, job.for_apple);
  options.flag("--remove", job.remove, "make it say nothing");
  options.group("Console");
  add_progress_options(options, mode);
  if (!options.parse(argc, argv)) return false;
  for (const char* other : {"--layout", "--projection", "--yaw", "--pitch", "--roll", "--ambisonics", "--apple"}) {
    if (job.remove && options.given(other)) throw UsageError(fmt::format("--remove leaves nothing for {}", other));
  }
  job.is_mono = layout == "mono";
  if (!layout.empty() && !job.is_mono) job.layout = layout_by_name("--layout", layout);
  if (job.output.empty()) job.output = job.file;
  return true;
}

void inject(int argc, char** argv) {
  InjectJob job;
  ProgressMode mode = ProgressMode::kAuto;
  if (!read_options(job, mode, argc, argv)) return;
  const bool is_film = ods::is_film(job.file);
  run_long_job(mode, 0, [&](ProgressLines& lines) { is_film ? inject_film(job, lines) : inject_picture(job); });
  std::cout << job.output << std::endl;
}

}  // namespace

extern "C" int ods_inject(int argc, char** argv) {
  return run_command([=] { inject(argc, argv); });
}

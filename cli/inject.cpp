// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods inject: makes a film say what it is, without encoding it again.
#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "cli/console.h"
#include "cli/form_options.h"
#include "cli/interrupt.h"
#include "ods/base/suggest.h"
#include "ods/video/encode.h"
#include "ods/video/film_form.h"

using ods::FilmForm, ods::FilmProjection;

namespace {

constexpr const char* kExamples =
    "  ods inject film_360_TB.mp4                 as its name says\n"
    "  ods inject film.mp4 -o tagged.mp4 --layout top-bottom --projection lat-long\n"
    "  ods inject film.mov --projection vr180 --layout side-by-side\n"
    "  ods inject film.mp4 --remove";

constexpr const char* kSummary =
    "Writes into an mp4, mov, mkv or webm how its eyes are laid out and what of the sphere it shows, in place of what\n"
    "it said before: Spherical Video V2, and V1 where that can say it. Nothing is encoded, every sample stays as it\n"
    "is. A complete new file takes the old one's place. What is not given is found as for pictures: by a sidecar, the\n"
    "name (_360_TB, _180_LR ...), the shape.";

struct InjectJob {
  std::string file, output;
  FilmForm form;
  std::optional<int> track;
  float yaw = 0.0f, pitch = 0.0f, roll = 0.0f;
  bool remove = false, ambisonics = false;
};

void parse_projection(const std::string& name, FilmForm& form) {
  const std::vector<std::string> names = {"lat-long", "vr180", "cubemap", "flat"};
  if (name == "cubemap" || name == "flat") {
    form.projection = name == "flat" ? FilmProjection::kFlat : FilmProjection::kCubemap;
  } else if (const ods::NamedProjection* named = ods::find_projection(name); named && name.starts_with("cube-3x2")) {
    throw UsageError(
        "--projection cube-3x2 has its faces in another order than the cubemap of films: right, left, up over down, "
        "front, back");
  } else if (named) {
    set_projection(form, named->setting);
  } else {
    throw UsageError(fmt::format("--projection is one of {}, not '{}'{}", fmt::join(names, ", "), name,
                                 ods::did_you_mean(name, names)));
  }
}

bool read_options(InjectJob& job, int argc, char** argv) {
  Options options("inject", kSummary, kExamples);
  std::string layout;
  options.argument("FILE", job.file, "mp4, mov, mkv or webm");
  options.text("-o,--output", "FILE", job.output, "leave FILE as it is and write this one");
  options.group("What it says");
  options.text("--layout", "LAYOUT", layout,
               "mono, or how both eyes share a frame: top-bottom, side-by-side, ... by the names of ods render");
  options.custom(
      "--projection", "NAME", "", [&](const std::string& name) { parse_projection(name, job.form); },
      "lat-long, vr180, cubemap (right, left, up over down, front, back) or flat");
  options.number("--yaw", job.yaw, -180.0f, 180.0f, "turn what is shown to the left, degrees");
  options.number("--pitch", job.pitch, -90.0f, 90.0f, "and up");
  options.number("--roll", job.roll, -180.0f, 180.0f, "and clockwise");
  options.number("--track", job.track, 0, 2147483647, "of several video tracks, by its number (the largest picture)");
  options.flag("--ambisonics", job.ambisonics,
               "its sound of four channels is first-order ambisonics (AmbiX: W Y Z X, SN3D); of mp4 and mov");
  options.flag("--remove", job.remove, "make it say nothing");
  options.group("Console");
  options.flag("-q,--quiet", console.quiet, "say nothing but errors");
  if (!options.parse(argc, argv)) return false;
  for (const char* other : {"--layout", "--projection", "--yaw", "--pitch", "--roll", "--ambisonics"}) {
    if (job.remove && options.given(other)) throw UsageError(fmt::format("--remove leaves nothing for {}", other));
  }
  if (layout == "mono") job.form.stereo = ods::FilmStereo::kOneView;
  if (!layout.empty() && layout != "mono") job.form.stereo = film_stereo(layout_by_name("--layout", layout));
  if (job.output.empty()) job.output = job.file;
  return true;
}

// What was asked for, and which of its places could hold it.
void say_what_is_written(const FilmForm& form, const ods::TagResult& result, ods::Container container) {
  const bool is_matroska = container == ods::Container::kMatroska || container == ods::Container::kWebm;
  const char* places = is_matroska ? "StereoMode and Projection" : result.has_v1 ? "V1 and V2" : "V2";
  note(fmt::format("{}: written as {}", form_text(form), places));
  if (!is_matroska && !result.has_v1) {
    note("V1 cannot say that, and is left out: players that read only V1 show a flat film");
  }
  if (result.has_v1 && (form.pitch != 0.0 || form.roll != 0.0 || form.yaw != std::round(form.yaw))) {
    note("V1 holds whole degrees of heading, and neither pitch nor roll: only V2 has the angles as they are");
  }
}

// What the sound is to say; nothing where it is left as it is.
std::optional<ods::Ambisonics> wished_sound(const InjectJob& job, const ods::FilmInfo& film) {
  if (!job.ambisonics) return std::nullopt;
  const bool has_boxes = film.container == ods::Container::kMp4 || film.container == ods::Container::kMov;
  if (!has_boxes) throw UsageError("--ambisonics is for mp4 and mov; in mkv and webm Opus says it by itself");
  const bool is_alone = film.sound.size() == 1;
  if (!is_alone)
    throw UsageError(fmt::format("--ambisonics: '{}' has {} tracks of sound, not one", job.file, film.sound.size()));
  const int channels = ods::read_sound_info(job.file).channels;
  if (channels != 4)
    throw UsageError(fmt::format("--ambisonics takes sound of 4 channels; '{}' has {}", job.file, channels));
  return ods::Ambisonics();
}

void inject(int argc, char** argv) {
  InjectJob job;
  if (!read_options(job, argc, argv)) return;
  end_on_interrupts("ods: interrupted: the file is as it was\n");
  const ods::FilmInfo film = ods::read_film(job.file);
  const ods::VideoTrack& track = choose_track(film, job.track, job.file);
  std::optional<FilmForm> form;
  std::vector<std::string> guesses;
  if (!job.remove) {
    form = complete_form(job.form, track, job.file, guesses);
    form->yaw = static_cast<double>(job.yaw);
    form->pitch = static_cast<double>(job.pitch);
    form->roll = static_cast<double>(job.roll);
    form->source = "Omnistereo";
  }
  const ods::TagResult result = tag_film(job.file, job.output, track.id, form, wished_sound(job, film));
  for (const std::string& guess : guesses) note(guess);
  if (form) say_what_is_written(*form, result, film.container);
  std::cout << job.output << std::endl;
}

}  // namespace

extern "C" int ods_inject(int argc, char** argv) {
  return run_command([=] { inject(argc, argv); });
}

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "cli/apple_option.h"
#include "cli/console.h"
#include "cli/inject_job.h"
#include "cli/long_job.h"
#include "ods/base/suggest.h"
#include "ods/video/film_form.h"

using ods::FilmForm, ods::FilmProjection;

namespace {

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

// What was asked for, and which of its places could hold it.
void say_what_is_written(const FilmForm& form, const ods::TagResult& result, ods::Container container) {
  const bool is_matroska = container == ods::Container::kMatroska || container == ods::Container::kWebm;
  const char* places = is_matroska ? "StereoMode and Projection" : result.has_v1 ? "V1 and V2" : "V2";
  note(fmt::format("{}: written as {}{}", form_text(form), places, result.has_vexu ? ", and for Apple's players" : ""));
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
  if (!has_boxes(film.container))
    throw UsageError("--ambisonics is for mp4 and mov; in mkv and webm Opus says it by itself");
  const bool is_alone = film.sound.size() == 1;
  if (!is_alone)
    throw UsageError(fmt::format("--ambisonics: '{}' has {} tracks of sound, not one", job.file, film.sound.size()));
  const int channels = film.sound[0].channels;
  if (channels != 4) {
    const std::string has = channels > 0 ? fmt::format("has {}", channels) : "does not say how many it has";
    throw UsageError(fmt::format("--ambisonics takes sound of 4 channels; '{}' {}", job.file, has));
  }
  return ods::Ambisonics();
}

}  // namespace

void inject_film(const InjectJob& job, ProgressLines& lines) {
  FilmForm known;
  if (job.is_mono) known.stereo = ods::FilmStereo::kOneView;
  if (job.layout) known.stereo = ods::film_stereo(*job.layout);
  if (!job.projection.empty()) parse_projection(job.projection, known);
  const ods::FilmInfo film = ods::read_film(job.file);
  check_apple(job.for_apple, film.container);
  const ods::VideoTrack& track = choose_track(film, job.track, job.file);
  std::optional<FilmForm> form;
  std::vector<std::string> guesses;
  if (!job.remove) {
    form = complete_form(known, track, job.file, guesses);
    form->yaw = static_cast<double>(job.yaw.value_or(0.0f));
    form->pitch = static_cast<double>(job.pitch.value_or(0.0f));
    form->roll = static_cast<double>(job.roll.value_or(0.0f));
    form->source = "Omnistereo";
    form->for_apple = form->for_apple || job.for_apple;
  }
  const auto start = std::chrono::steady_clock::now();
  const auto progress = [&](double done) {
    const double kSoon = 1.0;  // seconds: what takes less needs no lines
    if (const double seconds = seconds_since(start); seconds > kSoon)
      lines.report(done, seconds, {"inject", 0, 0, job.output});
  };
  const ods::TagResult result = tag_film(job.file, job.output, track.id, form, wished_sound(job, film), progress);
  lines.clear();
  for (const std::string& guess : guesses) note(guess);
  if (form) say_what_is_written(*form, result, film.container);
  if (job.ambisonics) note("its sound: written as ambisonics of first order (SA3D)");
}

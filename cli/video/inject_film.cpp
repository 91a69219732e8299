// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/apple_option.h"
#include "cli/video/inject_job.h"
#include "ods/base/error.h"
#include "ods/base/suggest.h"
#include "ods/video/container/apple.h"
#include "ods/video/container/film_form.h"

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

void say_what_is_written(const FilmForm& form, const ods::TagResult& result, ods::Container container) {
  const char* places = !has_boxes(container) ? "StereoMode and Projection" : result.has_v1 ? "V1 and V2" : "V2";
  note(fmt::format("{}: written as {}{}", form_text(form), places, result.has_vexu ? ", and for Apple's players" : ""));
}

void set_angles(const InjectJob& job, FilmForm& form) {
  const bool is_asked = job.yaw || job.pitch || job.roll;
  if (is_asked && form.projection == FilmProjection::kFlat) {
    throw UsageError(fmt::format("'{}' is flat: there is no place for --yaw, --pitch and --roll", job.file));
  }
  const auto set = [](const std::optional<float>& wish, double& angle) {
    if (wish) angle = static_cast<double>(*wish);
  };
  set(job.yaw, form.yaw), set(job.pitch, form.pitch), set(job.roll, form.roll);
}

bool asks_for_something(const InjectJob& job) {
  return job.is_mono || job.layout || !job.projection.empty() || job.yaw || job.pitch || job.roll || job.ambisonics ||
         job.for_apple;
}

// A film whose name or shape contradicts its own words is not tagged further before somebody says which is true.
void settle_conflicts(const InjectJob& job, const FilmForm& known, const ods::VideoTrack& track, bool matters) {
  std::string texts, options;
  for (const ods::FormConflict& conflict : find_conflicts(known, track, job.file)) {
    texts += (texts.empty() ? "" : "; ") + conflict.text;
    options += (options.empty() ? "" : ", and ") + conflict.options;
  }
  if (texts.empty()) return;
  if (!matters) return warn(texts);
  throw ods::Error(ods::ErrorKind::kInput,
                   fmt::format("'{}' contradicts itself: {}. Say which is true: {}", job.file, texts, options));
}

// The form that the film gets; what is not asked for is as the film has it. Says what its places cannot hold.
FilmForm wished_form(const InjectJob& job, ods::Container container, const ods::VideoTrack& track,
                     std::vector<std::string>& guesses) {
  FilmForm known;
  if (job.is_mono) known.stereo = ods::FilmStereo::kOneView;
  if (job.layout) known.stereo = ods::film_stereo(*job.layout);
  if (!job.projection.empty()) parse_projection(job.projection, known);
  known.for_apple = job.for_apple;
  FilmForm form = complete_form(known, track, job.file, guesses);
  set_angles(job, form);
  const ods::TagPlan plan = plan_tag(container, track, form);
  settle_conflicts(job, known, track, plan.says_more || !asks_for_something(job));
  if (job.for_apple && track.has_layers) {
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("the eyes of '{}' are layers of its stream, which its vexu describes: --apple would "
                                 "write another",
                                 job.file));
  }
  if (job.for_apple && !fits_vexu(form)) {
    throw ods::Error(ods::ErrorKind::kUsage,
                     fmt::format("--apple: vexu has no words for {} ('{}')", form_text(form), job.file));
  }
  if (!can_say(container, track, form)) {
    const auto kind = asks_for_something(job) ? ods::ErrorKind::kUsage : ods::ErrorKind::kInput;
    throw ods::Error(kind, fmt::format("cannot use '{}': {} has no words for {}", job.file, container_name(container),
                                       form_text(form)));
  }
  for (const std::string& each : plan.notes) note(each);
  return form;
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
  const ods::FilmInfo film = ods::read_film(job.file);
  check_apple(job.for_apple, film.container);
  const ods::VideoTrack& track = choose_track(film, job.track, job.file);
  const std::optional<ods::Ambisonics> sound = wished_sound(job, film);
  std::optional<FilmForm> form;
  std::vector<std::string> guesses;
  if (!job.remove) form = wished_form(job, film.container, track, guesses);
  const auto start = std::chrono::steady_clock::now();
  const auto progress = [&](double done) {
    const double kSoon = 1.0;  // seconds: what takes less needs no lines
    if (const double seconds = seconds_since(start); seconds > kSoon)
      lines.report(done, seconds, {"inject", 0, 0, job.output});
  };
  const ods::TagResult result = tag_film(job.file, job.output, track.id, form, sound, progress);
  lines.clear();
  for (const std::string& guess : guesses) note(guess);
  if (form) say_what_is_written(*form, result, film.container);
  if (job.ambisonics) note("its sound: written as ambisonics of first order (SA3D)");
}

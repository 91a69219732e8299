// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods film: a scene becomes a film.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/film_options.h"
#include "cli/options/form_options.h"
#include "cli/render/render_frames.h"
#include "cli/slits/stitch_frames.h"
#include "cli/video/film_journal.h"

namespace {

constexpr const char* kExamples =
    "  ods film scene.glb -o film_360_TB.mp4\n"
    "  ods film scene.glb -o film_360_TB.mp4 --target quest --width 4096 --fps 60 --audio sound.wav\n"
    "  ods film room -o room_360_TB.mp4 --quality draft --turntable 1 --duration 20\n"
    "  ods film scene.glb -o master.mov --target master --frames 1-250 --keep-frames\n"
    "  ods film 'views/####/####.exr' --rig rig.json -o film_360_TB.mp4 --frames 1-250   as ods stitch";

constexpr const char* kSummary =
    "Renders a scene frame by frame, encodes the frames and writes the 360 metadata that players need. The frames are\n"
    "kept in FILM.frames until the video is complete: after an interruption, give the same command again to continue.";

struct FilmJob {
  RenderJob render;
  ods::Development development;
  FilmWishes film;
  std::string rig;  // of slits: frames are stitched of its views, in place of being rendered
  bool keep_frames = false, restart = false;
};

bool read_options(FilmJob& job, int argc, char** argv) {
  RenderJob& render = job.render;
  Quality quality;
  Options options("film", kSummary, kExamples);
  add_scene_argument(options, render.scene);
  add_light_options(options, render.scene);
  add_film_options(options, job.film);
  options.text("--rig", "FILE", job.rig,
               "stitch the views of this rig (made by ods rig); SCENE is then the views' file names");
  options.flag("--keep-frames", job.keep_frames, "keep FILM.frames, which ods encode can read");
  options.flag("--restart", job.restart, "discard frames rendered with other options and start over");
  options.group("Picture");
  add_form_options(options, render.render, render.save);
  options.number("--exposure", job.development.exposure, -30.0f, 30.0f, "exposure in stops");
  options.choice("--tone", job.development.tone, ods::kToneCurves, ods::tone_curve_name, "tone curve");
  add_camera_options(options, render.camera);
  add_time_options(options, render.time);
  add_quality_options(options, render, quality);
  options.group("Console");
  add_progress_options(options, render.progress);
  if (!options.parse(argc, argv)) return false;
  if (render.time.time) throw UsageError("--time is for one picture; --frames says which of a film");
  if (render.save.sidecar) throw UsageError("--sidecar is for pictures; a film says itself what it shows");
  finish_render_job(options, quality, render);
  render.render.layers = false;
  render.time.is_film = render.time.skip_existing = true;
  job.film.rate = parse_rate(fmt::format("{}", render.time.fps));
  render.time.fps = static_cast<float>(job.film.rate.value());
  return true;
}

// Frames of the views of a rig.
std::vector<int> stitch_views(const FilmJob& job, const ods::SlitRig& rig, FilmJournal& journal,
                              const StepReport& report) {
  StitchJob stitch;
  stitch.views.names = job.render.scene.name;
  stitch.output = job.render.output;
  stitch.frames = job.render.time.frames;
  stitch.save = job.render.save;
  stitch.layout = job.render.save.layout;
  stitch.skip_existing = true, stitch.claims = false, stitch.says_files = false;
  if (stitch.frames.empty()) throw UsageError("--rig: --frames says which folders of views there are");
  journal.plan(ods::parse_frames(stitch.frames));
  return stitch_frames(stitch, rig, report);
}

void make_film(FilmJob job, ProgressLines& lines) {
  const double kRendering = 0.95;  // of the time
  const auto start = std::chrono::steady_clock::now();
  const RenderJob& render = job.render;
  const std::optional<ods::SlitRig> rig = job.rig.empty() ? std::nullopt : std::optional(open_rig(job.rig));
  if (rig && !render.has_layout) job.render.save.layout = ods::default_layout(rig->camera.projection);
  const ods::FilmPlan expected =
      rig ? expect_film(render.save.layout, rig->eyes.size(), rig->eye, rig->camera.projection)
          : expect_film(render.save.layout, ods::eye_list(render.render.eyes).size(),
                        {render.render.width, render.render.height}, render.camera.rig.projection);
  const ods::EncodeOptions options = encode_options(job.film, expected.size, job.render.render.threads);
  ods::check_packing(expected, options.packing);
  say_what_players_need(job.film, expected, options);
  FilmJournal journal(job.film.output,
                      rig ? stitch_settings(job.rig, render.scene.name, render.save) : frame_settings(render),
                      job.restart);
  job.render.output = journal.pattern();
  const auto rendered = [&](double done, const ProgressStep& step) {
    journal.check();
    lines.report(kRendering * done, seconds_since(start), step);
  };
  const auto planned = [&](const std::vector<int>& numbers) { journal.plan(numbers); };
  const std::vector<int> frames =
      rig ? stitch_views(job, *rig, journal, rendered) : render_frames(render, rendered, planned);

  const ods::FrameFiles files = ods::find_frames(journal.pattern(), frames);
  const ods::FilmPlan plan = ods::plan_film(files, {}, {});
  say_length_of_sound(options, frames.size());
  ods::Progress progress;
  progress.report = [&](double done) {
    lines.report(kRendering + (1.0 - kRendering) * done, seconds_since(start),
                 film_step("encode", done, frames.size(), job.film.output));
  };
  ods::make_film(files, plan, job.development, options, job.film.output, progress);
  lines.clear();
  announce_file(job.film.output);
  note(fmt::format("{}: {}, in {}", job.film.output, film_text(plan, options, frames.size()),
                   duration_text(seconds_since(start))));
  if (job.keep_frames) return note(fmt::format("the frames are in {}", journal.folder()));
  journal.remove();
}

void film(int argc, char** argv) {
  FilmJob job;
  if (!read_options(job, argc, argv)) return;
  run_long_job(job.render.progress, job.render.render.threads, [&](ProgressLines& lines) { make_film(job, lines); });
}

}  // namespace

extern "C" int ods_film(int argc, char** argv) {
  return run_command([=] { film(argc, argv); });
}

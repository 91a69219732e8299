// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods film: a scene becomes a film.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iostream>

#include "cli/console.h"
#include "cli/film_journal.h"
#include "cli/film_options.h"
#include "cli/form_options.h"
#include "cli/long_job.h"
#include "cli/render_frames.h"
#include "cli/stitch_frames.h"

using ods::Layout;

namespace {

constexpr const char* kExamples =
    "  ods film scene.glb -o film_360_TB.mp4\n"
    "  ods film scene.glb -o film_360_TB.mp4 --target quest --width 4096 --fps 60 --audio sound.wav\n"
    "  ods film room -o room_360_TB.mp4 --quality draft --turntable 1 --duration 20\n"
    "  ods film scene.glb -o master.mov --target master --frames 1-250 --keep-frames\n"
    "  ods film 'views/####/####.exr' --rig rig.json -o film_360_TB.mp4 --frames 1-250   as ods stitch";

constexpr const char* kSummary =
    "Renders a scene frame by frame, encodes the frames and says in the film what it is. The frames lie in\n"
    "FILM.frames until the film is there: a film that was interrupted or killed goes on where it was when the same\n"
    "command is given again.";

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
  options.text("--rig", "FILE", job.rig, "stitch the views of this rig (ods rig); SCENE is then their names");
  options.flag("--keep-frames", job.keep_frames, "leave FILM.frames, which ods encode reads, where it is");
  options.flag("--restart", job.restart, "render the frames anew that are there of other options");
  options.group("Picture");
  add_form_options(options, render.render, render.save);
  options.number("--exposure", job.development.exposure, -30.0f, 30.0f, "stops");
  options.choice("--tone", job.development.tone, ods::kToneCurves, ods::tone_curve_name, "tone curve");
  add_camera_options(options, render.camera);
  add_time_options(options, render.time);
  add_quality_options(options, render, quality);
  options.group("Console");
  add_progress_options(options, render.progress);
  if (!options.parse(argc, argv)) return false;
  console.json = render.progress == ProgressMode::kJson;
  if (render.time.time) throw UsageError("--time is for one picture; --frames says which of a film");
  if (render.save.sidecar) throw UsageError("--sidecar is for pictures; a film says itself what it shows");
  finish_render_job(options, quality, render);
  render.render.layers = false;
  render.time.is_film = render.time.skip_existing = true;
  job.film.rate = parse_rate(fmt::format("{}", render.time.fps));
  render.time.fps = static_cast<float>(job.film.rate.value());
  return true;
}

// What the frames will be like, of eyes of this size.
ods::FilmPlan expect(const RenderJob& render, const std::vector<int>& eyes, ods::Extent size,
                     const ods::ProjectionSetting& projection) {
  const Layout layout = render.save.layout;
  const Layout kLayouts[] = {Layout::kTopBottom, Layout::kSideBySide, Layout::kTopBottomHalf, Layout::kSideBySideHalf};
  const size_t count = eyes.size();
  if (count == 2 && std::find(std::begin(kLayouts), std::end(kLayouts), layout) == std::end(kLayouts)) {
    throw UsageError(
        fmt::format("a film's layout is top-bottom or side-by-side, perhaps -half, not {}", ods::layout_name(layout)));
  }
  const ods::Extent eye = ods::squeezed_eye(layout, size, static_cast<int>(count));
  const ods::FilmPlan plan = ods::plan_eyes(eye, count, layout, projection);
  for (const std::string& each : plan.notes) warn(each);
  return plan;
}

// Frames of the views of a rig.
std::vector<int> stitch_views(const FilmJob& job, const ods::SlitRig& rig, const StitchReport& report) {
  StitchJob stitch;
  stitch.views.names = job.render.scene.name;
  stitch.output = job.render.output;
  stitch.frames = job.render.time.frames;
  stitch.save = job.render.save;
  stitch.layout = job.render.save.layout;
  stitch.skip_existing = true, stitch.says_files = false;
  if (stitch.frames.empty()) throw UsageError("--rig: --frames says which folders of views there are");
  return stitch_frames(stitch, rig, report);
}

void make_film(FilmJob job, const std::vector<std::string>& words, ProgressLines& lines) {
  const double kRendering = 0.95;  // of the time
  const auto start = std::chrono::steady_clock::now();
  const RenderJob& render = job.render;
  std::optional<ods::SlitRig> rig;
  if (!job.rig.empty()) rig = open_rig(job.rig);
  if (rig && !render.has_layout) job.render.save.layout = ods::default_layout(rig->camera.projection);
  const ods::FilmPlan expected =
      rig ? expect(render, rig->eyes, rig->eye, rig->camera.projection)
          : expect(render, ods::eye_list(render.render.eyes), {render.render.width, render.render.height},
                   render.camera.rig.projection);
  const ods::EncodeOptions options = encode_options(job.film, expected.size, job.render.render.threads);
  ods::check_packing(expected, options.packing);
  say_what_players_need(job.film, expected, options);

  const FilmJournal journal(job.film.output, words, job.restart);
  job.render.output = journal.pattern();
  const auto report = [&](double done) { lines.report(done, seconds_since(start)); };
  const auto rendered = [&](double done) { report(kRendering * done); };
  const std::vector<int> frames = rig ? stitch_views(job, *rig, rendered) : render_frames(render, rendered);

  const ods::FrameFiles files = ods::find_frames(journal.pattern(), frames);
  const ods::FilmPlan plan = ods::plan_film(files, {}, {});
  say_length_of_sound(options, frames.size());
  ods::Progress progress;
  progress.report = [&](double done) { report(kRendering + (1.0 - kRendering) * done); };
  ods::make_film(files, plan, job.development, options, job.film.output, progress);
  lines.clear();
  std::cout << job.film.output << std::endl;
  note(fmt::format("{}: {}, in {}", job.film.output, film_text(plan, options, frames.size()),
                   duration_text(seconds_since(start))));
  if (job.keep_frames) return note(fmt::format("the frames are in {}", journal.folder()));
  journal.remove();
}

void film(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);  // reading them moves them about
  FilmJob job;
  if (!read_options(job, argc, argv)) return;
  run_long_job(job.render.progress, job.render.render.threads,
               [&](ProgressLines& lines) { make_film(job, words, lines); });
}

}  // namespace

extern "C" int ods_film(int argc, char** argv) {
  return run_command([=] { film(argc, argv); });
}

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/video/make_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cli/bridge/film_conversion.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/video/make_video.h"
#include "ods/files/frames.h"

namespace {

constexpr int kEarlyFrames = 3;

void make(const VideoJob& given) {
  const VideoJob job = settled(given);
  run_long_job(job.render.progress, job.render.render.threads, [&](ProgressLines& lines) { make_video(job, lines); });
}

// The frames that are rendered first; nullopt: the job needs the whole scene, for times of its own, for a merge that
// suits all frames, or because another process may need it just as soon.
std::optional<FilmBeginning> early_frames(const VideoJob& job) {
  const RenderJob& render = job.render;
  const TimeOptions& time = render.time;
  const bool is_ours = render.renderer == Renderer::kOds && job.rig.empty() && is_blend(render.scene.name);
  const bool has_own_times = time.given_fps || time.duration || !time.animation.empty();
  if (!is_ours || has_own_times || !time.only.empty()) return std::nullopt;
  if (!render.scene.confine.empty() || render.camera.changes.merge_limit) return std::nullopt;
  FilmBeginning beginning{kEarlyFrames, {}};
  if (time.frames.empty() || time.frames == "all") return beginning;
  const std::vector<int> frames = ods::parse_frames(time.frames);
  if (frames.back() - frames.front() + 1 != static_cast<int>(frames.size())) return std::nullopt;
  beginning.frames = {frames.front(), frames.back()};
  return frames.size() > kEarlyFrames ? std::optional(beginning) : std::nullopt;
}

// The numbers of the frames that the beginning of a scene has.
std::vector<int> first_frames(const FilmBeginning& beginning, const FileFrames& file) {
  const int first = std::max(beginning.frames ? beginning.frames->first : file.first, file.first);
  std::vector<int> frames;
  for (int i = 0; i < beginning.count; i++) frames.push_back(first + i);
  return frames;
}

}  // namespace

void make_film(const VideoJob& given) {
  const std::optional<FilmBeginning> early = early_frames(given);
  if (!early) return make(given);
  const SaidOnce once;
  VideoJob job = given;
  FilmConversion conversion(job.render.scene.name, blender_options(job.render.scene), *early);
  if (std::optional<ForeignScene> beginning = conversion.beginning()) {
    note("Blender takes long to follow what moves: the first frames are rendered meanwhile");
    job.early = first_frames(*early, beginning->frames);
    job.render.scene.foreign = std::move(beginning);
    make(job);
    job.early.clear();
    job.restart = false;
  }
  job.render.scene.foreign = conversion.whole();
  make(job);
}

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/layers/film_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/console/console.h"
#include "ods/base/memory.h"

namespace {

constexpr size_t kMostFrames = 1000;
constexpr float kLightsPerSecond = 4.0f;

// The frames between two lights: those given, or so many that graphics cards need half of what is allowed at most.
size_t light_step(const LayersJob& job, const ods::FilmGeometry& geometry, size_t frames, float fps) {
  const auto bytes = [&](size_t step) {
    return ods::film_texture_bytes(geometry, ods::light_frames(frames, step).size());
  };
  size_t step = static_cast<size_t>(std::max(std::lround(fps / kLightsPerSecond), 1L));
  if (job.light_every) {
    step = static_cast<size_t>(*job.light_every);
  } else {
    while (step < frames && bytes(step) > ods::kMostFilmBytes / 2) step *= 2;
  }
  if (bytes(step) > ods::kMostFilmBytes) {
    throw UsageError(fmt::format(
        "the light of what moves would need {} on graphics cards, at most {}: a smaller --width or a larger "
        "--light-every needs less",
        ods::bytes_text(bytes(step)), ods::bytes_text(ods::kMostFilmBytes)));
  }
  return step;
}

void report_film(const FilmJob& film) {
  size_t triangles = 0, moving = 0, deforming = 0;
  for (size_t i = 0; i < film.movers.size(); i++) {
    const std::vector<ods::MoverMesh>& meshes = film.geometry.film.movers[i].meshes;
    if (meshes.empty()) continue;
    moving++;
    deforming += film.movers[i].deforms ? 1 : 0;
    for (const ods::MoverMesh& mesh : meshes) triangles += mesh.triangles.size();
  }
  note(fmt::format("{} frames: {} things move, {} of them deform; {} triangles", film.frames.size(), moving, deforming,
                   triangles));
  note(fmt::format("their light at {} of the frames: {} of {} x {}, {} on graphics cards", film.lights.size(),
                   film.geometry.textures == 1 ? "a texture" : fmt::format("{} textures", film.geometry.textures),
                   film.geometry.texture_size, film.geometry.texture_size,
                   ods::bytes_text(ods::film_texture_bytes(film.geometry, film.lights.size()))));
}

}  // namespace

std::vector<ods::SequenceFrame> layer_frames(const LayersJob& job, const TimeOptions& time) {
  if (job.render.time.frames.empty()) {
    return {{0, double{time.time.value_or(0.0f)}, job.render.output, job.render.render.seed}};
  }
  const std::vector<int> numbers = video_frames(time);
  if (numbers.size() < 2 || numbers.size() > kMostFrames) {
    throw UsageError(fmt::format("--frames: a film of layers has 2 to {} frames, not {}; 1-100x2 takes every other one",
                                 kMostFrames, numbers.size()));
  }
  if (!std::ranges::is_sorted(numbers)) throw UsageError("--frames: a film of layers goes forwards, such as 1-48");
  std::vector<ods::SequenceFrame> frames;
  for (const int number : numbers) {
    const double seconds = (number - time.file.first) / static_cast<double>(time.fps);
    frames.push_back({number, seconds, job.render.output, job.render.render.seed});
  }
  return frames;
}

FilmJob plan_film(const LayersJob& job, ods::Scene& scene, std::vector<ods::SequenceFrame> frames,
                  const ods::HeadBox& box, int width) {
  FilmJob film;
  film.frames = std::move(frames);
  if (film.frames.size() < 2) return film;
  std::vector<double> times;
  for (const ods::SequenceFrame& frame : film.frames) times.push_back(frame.time);
  film.movers = ods::find_movers(scene, times);
  if (film.movers.empty()) {
    throw UsageError("--frames: nothing moves in these frames; without it, or with --time, layers are still");
  }
  film.geometry = ods::build_film(scene, film.movers, times, box, width);
  if (film.geometry.textures == 0) {
    throw UsageError("--frames: the box sees nothing of what moves in these frames; leave it out");
  }
  const float fps = static_cast<float>(static_cast<double>(times.size() - 1) / (times.back() - times.front()));
  film.lights = ods::light_frames(times.size(), light_step(job, film.geometry, times.size(), fps));
  report_film(film);
  return film;
}

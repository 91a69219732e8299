// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/testcard/testcard_film.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/base/pipeline.h"
#include "ods/compose/film_over.h"

namespace ods {

// --- drawing ---------------------------------------------------------------------------------------------------------

static Testcard with_marks(const TestcardFilm& film, int number) {
  Testcard card = film.card;
  for (Card& mark : testcard_marks(film.rig, card.eye, number, film.rate.value()))
    card.cards.push_back(std::move(mark));
  return card;
}

static ColumnRuns runs_of(const Testcard& card, const std::vector<Card>& marks, int eye, int y) {
  const float pixel = 2.0f * kPi / static_cast<float>(std::max(8, std::min(card.eye.width, card.eye.height)));
  ColumnRuns runs;
  for (int x = 0; x < card.eye.width; x++) {
    const vec2 uv = (vec2(x, y) + 0.5f) / vec2(card.eye.width, card.eye.height);
    const vec3 direction = camera_ray(card.camera, eye, uv).direction;
    const auto meets = [&](const Card& mark) { return is_on_card(mark, direction, pixel); };
    if (direction == vec3(0.0f) || std::none_of(marks.begin(), marks.end(), meets)) continue;
    if (runs.empty() || runs.back()[1] < x) runs.push_back({x, x});
    runs.back()[1] = x + 1;
  }
  return runs;
}

static void draw_still(const TestcardFilm& film) {
  const Extent eye = film.card.eye;
  for (size_t i = 0; i < film.like.eyes.size(); i++) {
    const EyeCorner corner = eye_corner(film.like.layout, eye, static_cast<int>(i));
    const auto rows = [&](int y, std::span<float> row) {
      std::vector<float> pixels(row.size());
      fill_testcard_row(film.card, film.like.eyes[i].eye, y, pixels);
      const size_t width = row.size() / 3;
      for (size_t k = 0; k < row.size(); k++) row[k % 3 * width + k / 3] = film_code(std::clamp(pixels[k], 0.0f, 1.0f));
    };
    put_ycbcr(rows, eye, film.still->planes().at(corner.x, corner.y));
  }
}

TestcardFilm make_testcard_film(const Testcard& card, const CameraRig& rig, const std::vector<int>& eyes,
                                const FilmPlan& plan, FrameRate rate, const Packing& packing) {
  TestcardFilm film;
  film.card = card;
  film.rig = rig;
  film.rate = rate;
  film.packing = packing;
  film.like.size = card.eye;
  film.like.layout = plan.eyes == 2 ? plan.layout : Layout::kSeparate;
  for (const int eye : eyes) film.like.eyes.push_back({eye, {}});
  film.still = std::make_shared<FilmFrame>(plan.size, packing);
  draw_still(film);
  const std::vector<Card> marks = testcard_marks(rig, card.eye, 0, rate.value());
  film.runs.resize(plan.eyes);
  for (size_t i = 0; i < plan.eyes; i++) {
    film.runs[i].resize(static_cast<size_t>(card.eye.height));
    tbb::parallel_for(0, card.eye.height, [&](int y) {
      film.runs[i][static_cast<size_t>(y)] = runs_of(card, marks, film.like.eyes[i].eye, y);
    });
  }
  return film;
}

std::shared_ptr<FilmFrame> testcard_frame(const TestcardFilm& film, int number) {
  const Testcard card = with_marks(film, number);
  Cover cover;
  cover.eyes.resize(film.runs.size());
  for (size_t i = 0; i < cover.eyes.size(); i++) {
    cover.eyes[i].resize(film.runs[i].size());
    tbb::parallel_for(0, card.eye.height, [&](int y) {
      const ColumnRuns& runs = film.runs[i][static_cast<size_t>(y)];
      if (runs.empty()) return;
      CoverRow& row = cover.eyes[i][static_cast<size_t>(y)];
      row.first = runs.front()[0];
      row.rgba.assign(4 * static_cast<size_t>(runs.back()[1] - row.first), 0.0f);
      for (const auto& [first, last] : runs) {
        std::vector<float> pixels(3 * static_cast<size_t>(last - first));
        fill_testcard_pixels(card, film.like.eyes[i].eye, first, y, pixels);
        float* out = &row.rgba[4 * static_cast<size_t>(first - row.first)];
        for (size_t k = 0; k < pixels.size(); k += 3, out += 4) {
          std::copy_n(&pixels[k], 3, out);
          out[3] = 1.0f;
        }
      }
    });
  }
  auto frame = std::make_shared<FilmFrame>(film.still->extent(), film.packing);
  copy_planes(film.still->planes(), film.still->extent(), frame->planes());
  lay_cover(cover, film.like, {}, film.still->planes(), frame->planes());
  return frame;
}

// --- sound -----------------------------------------------------------------------------------------------------------

static std::string little(uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; i++) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

std::string testcard_sound(int frames, double fps) {
  const int rate = 48000, count = static_cast<int>(std::lround(frames / fps * rate));
  std::vector<int16_t> samples(static_cast<size_t>(count));
  const int length = static_cast<int>(std::lround(flash_frames(fps) / fps * rate));
  for (int second = 0; first_frame_of(second, fps) < frames; second++) {
    const auto start = static_cast<int>(std::lround(first_frame_of(second, fps) / fps * rate));
    for (int i = 0; i < length && start + i < count; i++) {
      const double edge = std::min({1.0, i / 48.0, (length - i) / 48.0});  // a millisecond, so that it does not click
      const double value = 12000.0 * edge * std::sin(2.0 * std::numbers::pi * 1000.0 * i / rate);
      samples[static_cast<size_t>(start + i)] = static_cast<int16_t>(std::lround(value));
    }
  }
  const auto bytes = static_cast<uint32_t>(2 * samples.size());
  std::string wav = "RIFF" + little(36 + bytes, 4) + "WAVEfmt " + little(16, 4) + little(1, 2) + little(1, 2) +
                    little(rate, 4) + little(2 * rate, 4) + little(2, 2) + little(16, 2) + "data" + little(bytes, 4);
  for (const int16_t sample : samples) wav += little(static_cast<uint16_t>(sample), 2);
  return wav;
}

// --- the film --------------------------------------------------------------------------------------------------------

static void encode_frames(const TestcardFilm& film, int frames, FilmEncoder& encoder, const Progress& progress) {
  struct Work {
    int number = 0;
    std::shared_ptr<FilmFrame> frame;
  };
  int next = 0, done = 0;
  const auto number = [&](Work& work) {
    work.number = next++;
    return work.number < frames;
  };
  const auto draw = [&](Work& work) {
    if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "cancelled");
    work.frame = testcard_frame(film, work.number);
  };
  const auto encode = [&](const Work& work) {
    encoder.add(work.frame);
    done++;
    if (progress.report) progress.report(static_cast<double>(done) / frames);
  };
  const auto threads = static_cast<size_t>(tbb::this_task_arena::max_concurrency());
  const size_t at_once = std::clamp<size_t>(available_memory() / 8 / film.still->bytes(), 1, threads + 1);
  run_pipeline<Work>(at_once, number, draw, encode);
}

void write_testcard_film(const TestcardFilm& film, const FilmPlan& plan, int frames, EncodeOptions options,
                         const std::string& path, const Progress& progress) {
  AtomicFile untagged(path), sound(path + ".wav");
  if (options.sound.empty()) {
    const std::string wav = testcard_sound(frames, film.rate.value());
    std::fwrite(wav.data(), 1, wav.size(), sound.stream());
    sound.finish();
    options.sound = sound.temporary();  // which goes when it is not needed any more
  }
  FilmEncoder encoder(untagged, *container_of_path(path), plan.size, options);
  encode_frames(film, frames, encoder, progress);
  encoder.finish();
  const FilmInfo made = read_film(untagged.temporary());
  FilmForm form = plan.form;
  form.for_apple = options.for_apple;
  tag_film(untagged.temporary(), path, choose_track(made, {}, path).id, form);
}

}  // namespace ods

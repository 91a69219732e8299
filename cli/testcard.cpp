// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods testcard: a picture that judges players.
#include "ods/image/testcard.h"

#include <fmt/format.h>

#include <iostream>

#include "cli/camera_options.h"
#include "cli/console.h"
#include "cli/form_options.h"
#include "cli/interrupt.h"
#include "cli/long_job.h"
#include "cli/testcard_film.h"
#include "ods/image/save.h"

namespace {

constexpr const char* kExamples =
    "  ods testcard -o card.png\n"
    "  ods testcard -o card_180.jpg --projection vr180 --width 2880\n"
    "  ods testcard -o card.png --size deovr-4096 --merge cosine,60,90\n"
    "  ods testcard --film -o card_360_TB.mp4 --duration 60 --fps 60";

constexpr const char* kSummary =
    "Makes a picture that shows in one look what a player does with stereo 360: each eye reads its own name, the\n"
    "plates stand at the metres they say, rings are round, and every direction has its degrees. As a film it also "
    "shows\n"
    "whether frames are dropped and whether sound and pictures go together.";

struct TestcardJob {
  std::string output;
  ods::RenderOptions picture;
  ods::SaveOptions save;
  CameraOptions camera;
  TestcardFilmWishes film;
};

bool read_options(TestcardJob& job, int argc, char** argv) {
  Options options("testcard", kSummary, kExamples);
  options.group("Picture");
  options.text("-o,--output", "FILE", job.output,
               ".png .jpg .tif .webp .hdr .exr; %V in its name: a file per eye; a film");
  job.picture.width = 4096;
  add_form_options(options, job.picture, job.save);
  add_sceneless_camera_options(options, job.camera);
  add_testcard_film_options(options, job.film);
  options.group("Console");
  options.number("--threads", job.film.threads, 0, 1024, "0: all processors");
  add_progress_options(options, job.film.progress);
  if (!options.parse(argc, argv)) return false;
  console.json = job.film.progress == ProgressMode::kJson;
  if (job.output.empty()) throw UsageError("where to? -o card.png");
  finish_form_options(options, job.camera.rig.projection, job.picture, job.save);
  finish_camera_options(job.camera, job.picture.width, job.picture.height);
  job.film.is_film = job.film.is_film || ods::container_of_path(job.output).has_value();
  job.film.film.output = job.output;
  if (job.film.is_film && job.save.sidecar)
    throw UsageError("--sidecar is for pictures; a film says itself what it shows");
  job.save.tone = ods::ToneCurve::kLinear;  // the codes of the greys are what they say
  return true;
}

std::vector<std::string> lettering(const TestcardJob& job, const ods::CameraRig& rig, ods::Extent eye,
                                   const std::vector<int>& eyes) {
  const ods::Layout shared = ods::names_eye(job.output) ? ods::Layout::kSeparate : job.save.layout;
  const std::string layout(eyes.size() == 2 ? ods::layout_name(shared) : ods::eye_name(eyes[0]));
  return {fmt::format("{} {}", projection_name(rig.projection), layout),
          fmt::format("{} x {} an eye", eye.width, eye.height),
          fmt::format("{:g} mm between the eyes", 1000.0f * rig.ipd)};
}

void draw(const TestcardJob& job, const ods::CameraRig& rig, ods::Extent eye, const std::vector<int>& eyes) {
  ods::check_output(job.output, job.save, eyes, eye);
  note_misleading_name(job.output, job.save, eyes.size(), rig.projection);
  const ods::Testcard card = make_testcard(rig, eye, lettering(job, rig, eye, eyes));
  ods::PictureRows rows{eye, eyes, {{{"R", "G", "B"}}}, {}, {}};
  rows.fill = [&](int index, int y, std::span<float> row) {
    fill_testcard_row(card, eyes[static_cast<size_t>(index)], y, row);
  };
  for (const std::string& file : save_picture(rows, &rig, job.save, job.output)) std::cout << file << std::endl;
}

void testcard(int argc, char** argv) {
  TestcardJob job;
  if (!read_options(job, argc, argv)) return;
  const ods::CameraRig rig = place_camera(job.camera);
  const ods::Extent eye{job.picture.width, job.picture.height};
  const std::vector<int> eyes = ods::eye_list(job.picture.eyes);
  if (!job.film.is_film) {
    end_on_interrupts("ods: interrupted\n");
    return draw(job, rig, eye, eyes);
  }
  run_long_job(job.film.progress, job.film.threads, [&](ProgressLines& lines) {
    make_film_of_card(rig, eye, eyes, job.save.layout, lettering(job, rig, eye, eyes), job.film, lines);
  });
}

}  // namespace

extern "C" int ods_testcard(int argc, char** argv) {
  return run_command([=] { testcard(argc, argv); });
}

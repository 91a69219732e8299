// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods testcard: makes a picture or video for judging players.
#include "ods/compose/testcard.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/compose/testcard_video.h"
#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/camera_options.h"
#include "cli/options/picture_options.h"
#include "ods/picture/save.h"

namespace {

constexpr const char* kTestcardExamples =
    "  ods testcard -o card.png\n"
    "  ods testcard -o card_180.jpg --projection vr180 --width 2880\n"
    "  ods testcard -o card.png --size deovr-4096 --merge cosine,60,90\n"
    "  ods testcard --video -o card_360_TB.mp4 --duration 60 --fps 60";

constexpr const char* kTestcardSummary =
    "Makes a picture that shows at a glance what a player does with stereo 360: each eye sees its own name, plates "
    "are\n"
    "at the distances written on them, rings are round, and every direction has its degrees. A video also shows "
    "dropped\n"
    "frames and whether sound and picture are in sync.";

struct TestcardJob {
  std::string output;
  PictureForm form;
  ods::RenderOptions picture;  // only its size and eyes
  ods::SaveOptions save;
  CameraOptions camera;
  TestcardVideoChoices video;
};

TestcardJob parse_testcard(Options& options) {
  TestcardJob job;
  options.describe(kTestcardSummary, kTestcardExamples);
  options.group("Picture");
  options.text("-o,--output", ValueKind::output_file(), job.output,
               "output file: .png .jpg .tif .webp .hdr .exr, or a video; %V in the name writes one file per eye");
  job.form.usual_width = 4096;
  add_picture_options(options, job.form, job.save.sidecar);
  add_sceneless_camera_options(options, job.camera);
  add_testcard_video_options(options, job.video);
  options.group("Console");
  options.number("--threads", job.video.threads, 0, 1024, "number of threads; 0: all processors");
  add_progress_options(options, job.video.progress);
  options.parse();
  if (job.output.empty()) throw UsageError("no output file: add -o card.png");
  job.video.is_video = job.video.is_video || ods::container_of_path(job.output).has_value();
  job.video.video.output = job.output;
  if (job.video.is_video && job.save.sidecar)
    throw UsageError("--sidecar is for pictures; a video carries its own metadata");
  job.save.tone = ods::ToneCurve::kLinear;  // so that the greys have exactly the code values on their labels
  return job;
}

std::vector<std::string> lettering(const TestcardJob& job, const ods::StereoCamera& stereo, ods::Extent eye,
                                   const std::vector<int>& eyes) {
  const ods::Layout shared = ods::names_eye(job.output) ? ods::Layout::kSeparate : job.save.layout;
  const std::string layout(eyes.size() == 2 ? ods::layout_name(shared) : ods::eye_name(eyes[0]));
  return {fmt::format("{} {}", projection_name(stereo.projection), layout),
          fmt::format("{} x {} an eye", eye.width, eye.height),
          fmt::format("{:g} mm between the eyes", 1000.0f * stereo.ipd)};
}

void warn_if_illegible(const ods::ProjectionSetting& projection, int width) {
  const double height = ods::letter_height(projection, width);
  if (height >= ods::kLegible) return;
  const int enough = static_cast<int>(std::ceil(width * ods::kLegible / height / 128.0)) * 128;
  warn(fmt::format("its small letters are {:.2g} pixels high and cannot be read: use --width {} or more", height,
                   enough));
}

void draw(const TestcardJob& job, const ods::StereoCamera& stereo, ods::Extent eye, const std::vector<int>& eyes) {
  ods::check_output(job.output, job.save, eyes, eye);
  note_misleading_name(job.output, job.save, eyes.size(), stereo.projection);
  warn_if_illegible(stereo.projection, eye.width);
  const ods::Testcard card = make_testcard(stereo, eye, lettering(job, stereo, eye, eyes));
  ods::PictureRows rows{eye, eyes, {{{"R", "G", "B"}}}, {}, {}};
  rows.fill = [&](int index, int y, std::span<float> row) {
    fill_testcard_row(card, eyes[static_cast<size_t>(index)], y, row);
  };
  for (const std::string& file : save_picture(rows, &stereo, job.save, job.output)) announce_file(file);
}

void testcard(TestcardJob job) {
  use_form(job.form, job.camera, job.picture, job.save);
  const ods::StereoCamera stereo = place_camera(job.camera);
  const ods::Extent eye{job.picture.width, job.picture.height};
  const std::vector<int> eyes = ods::eye_list(job.picture.eyes);
  if (!job.video.is_video) {
    return draw(job, stereo, eye, eyes);
  }
  warn_if_illegible(stereo.projection, eye.width);
  run_long_job(job.video.progress, job.video.threads, [&](ProgressLines& lines) {
    make_video_of_card(stereo, eye, eyes, job.save.layout, lettering(job, stereo, eye, eyes), job.video, lines);
  });
}

}  // namespace

extern const Command kTestcard =
    make_command<parse_testcard, testcard>("testcard", "make a test card for players and headsets");

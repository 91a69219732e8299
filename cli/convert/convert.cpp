// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods convert: converts a picture, frames or a video to another form.
#include "ods/convert/convert.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <mutex>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/convert/convert_frames.h"
#include "cli/convert/convert_job.h"
#include "cli/options/projection_options.h"

namespace {

// Reports to the progress lines how many rows are done.
void count_rows(ods::PictureRows& rows, const std::string& output, ProgressLines& lines,
                std::chrono::steady_clock::time_point start) {
  const double all = static_cast<double>(rows.eyes.size()) * rows.eye.height;
  const auto done = std::make_shared<std::atomic<int>>(0);
  const auto speaks = std::make_shared<std::mutex>();
  rows.fill = [=, &lines, fill = rows.fill](int index, int y, std::span<float> row) {
    fill(index, y, row);
    const int count = ++*done;
    if (!speaks->try_lock()) return;
    const std::lock_guard<std::mutex> lock(*speaks, std::adopt_lock);
    lines.report(std::min(count / all, 1.0), seconds_since(start), {"convert", 0, 0, output});
  };
}

void convert_to_file(const ConvertJob& job, ProgressLines& lines) {
  const auto start = std::chrono::steady_clock::now();
  ods::Conversion conversion = ods::convert(job.picture, job.target);
  if (conversion.no_depth > 0) {
    note(fmt::format("{}: {} of its depths are invalid (NaN, 0 or less): taken for far away", job.given.input,
                     conversion.no_depth));
  }
  count_rows(conversion.rows, job.given.output, lines, start);
  const auto files = ods::save_picture(conversion.rows, &job.target.camera, job.save, job.given.output);
  lines.report(1.0, seconds_since(start), {"convert", 0, 0, job.given.output});
  lines.clear();
  for (const std::string& file : files) announce_file(file);
  const ods::Extent eye = job.target.eye;
  const double all = 1.0 * eye.width * eye.height * static_cast<double>(job.target.eyes.size());
  note_empty_share(static_cast<double>(*conversion.empty) / all, conversion.sees_around);
  note_filled_share(static_cast<double>(*conversion.filled) / all);
  note(fmt::format("{} of {} {}x{} in {}", files.front(), ods::projection_name(job.target.camera.projection), eye.width,
                   eye.height, duration_text(seconds_since(start))));
}

void convert(ConvertOptions given) {
  ods::FormatHint alone = given.known;
  alone.one_eye |= !given.camera.file.empty() || given.frames.has_value();
  given.input = joined_input(given.files, alone);
  ConvertJob job = open_conversion(given);
  run_long_job(given.progress, given.threads, [&](ProgressLines& lines) {
    if (ods::container_of_path(given.output)) return convert_to_video(job, lines);
    if (job.kind != ods::FootageKind::kPicture) return convert_to_frames(job, lines);
    read_pixels(job);
    convert_to_file(job, lines);
  });
}

}  // namespace

void note_empty_share(double share, bool sees_around) {
  if (share == 0.0) return;
  note(fmt::format(
      "{:.3g} % of the pixels are empty: {}", 100.0 * share,
      sees_around ? "what the eyes see there was hidden or outside the picture" : "the picture does not reach there"));
}

void note_filled_share(double share) {
  if (share == 0.0) return;
  note(fmt::format(
      "{:.3g} % of the pixels were hidden and are filled from their neighbours (--holes empty leaves them empty)",
      100.0 * share));
}

extern const Command kConvert =
    make_command<parse_convert, convert>("convert", "change a picture's projection, layout, size or eyes");

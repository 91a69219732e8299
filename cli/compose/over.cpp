// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods over: composites a picture with alpha over another.
#include "ods/compose/over.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "cli/compose/over_job.h"
#include "cli/compose/over_video.h"
#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/picture_options.h"
#include "cli/options/projection_options.h"
#include "cli/options/time_options.h"
#include "ods/base/error.h"
#include "ods/files/frames.h"

using ods::Footage, ods::FootageKind, ods::StoredPicture;

namespace {

// Composites one frame. Without a foreground the background passes through.
void lay(const OverJob& job, const std::optional<StoredPicture>& front, const StoredPicture& back,
         const std::string& output, bool is_first) {
  ods::SaveOptions save = job.save;
  save_as_it_was(back, back.camera.projection, output, job.layout, job.display, save);
  ods::Overlay overlay;
  if (front) {
    check_over(job, *front, back);
    if (is_first) {
      for (const std::string& warning : over_warnings(*front, back)) warn(warning);
    }
    overlay = lay_over(*front, back, job.over);
  } else {
    overlay.rows = convert(back, same_format(back)).rows;
  }
  if (is_first) note_misleading_name(output, save, back.eyes.size(), back.camera.projection);
  for (const std::string& file : save_picture(overlay.rows, &back.camera, save, output)) announce_file(file);
  const std::string behind = behind_warning(overlay);
  if (is_first && !behind.empty()) warn(behind);
}

// False at the end of a video.
bool lay_frame(const OverJob& job, Footage& back, Footage& front, int frame, const std::string& output, bool is_first) {
  for (const Footage* input : {&front, &back}) refuse_overwriting(output, input->path_of(frame));
  const std::optional<StoredPicture> before = front.picture(frame), behind = back.picture(frame);
  if (!behind && back.kind() == FootageKind::kVideo) return false;
  if (!behind) throw ods::Error(ods::ErrorKind::kInput, fmt::format("'{}' does not exist", back.path_of(frame)));
  if (is_first && before) note_guesses(front.path_of(frame), *before);
  if (is_first) note_guesses(back.path_of(frame), *behind);
  lay(job, before, *behind, output, is_first);
  return true;
}

void lay_frames(const OverJob& job, Footage& back, Footage& front, ProgressLines& lines) {
  const ods::FrameNames output = video_names(job.output);
  const bool to_the_end = back.kind() == FootageKind::kVideo && !job.frames;
  std::vector<int> frames = job.frames ? *job.frames : back.frames();
  if (frames.empty() && !to_the_end) {
    throw ods::Error(ods::ErrorKind::kInput, fmt::format("there is no frame '{}'", job.background));
  }
  if (job.frames && (back.kind() == FootageKind::kVideo || front.kind() == FootageKind::kVideo)) check_rising(frames);
  frames = own_frames(job.share.only, frames);
  std::erase_if(frames, [&](int frame) { return job.share.skip_existing && ods::is_saved(output.path(frame)); });
  const auto start = std::chrono::steady_clock::now();
  for (size_t i = 0; to_the_end || i < frames.size(); i++) {
    const int frame = to_the_end ? static_cast<int>(i) : frames[i];
    const bool is_there = lay_frame(job, back, front, frame, output.path(frame), i == 0);
    const auto count = static_cast<double>(std::max(frames.size(), i + 1));
    const ProgressStep step{"over", static_cast<int>(i) + 1, static_cast<int>(count), output.path(frame)};
    if (is_there) lines.report(static_cast<double>(i + 1) / count, seconds_since(start), step);
    if (is_there) continue;
    if (to_the_end && i > 0) return;
    const ods::ErrorKind kind = job.frames ? ods::ErrorKind::kUsage : ods::ErrorKind::kInput;
    throw ods::Error(kind, fmt::format("there is no picture {} in '{}'", frame, job.background));
  }
}

// Title frames with other numbers than the footage would otherwise be skipped silently.
void warn_of_no_cover(const OverJob& job, const Footage& back, const Footage& front) {
  if (front.kind() != FootageKind::kFrames || back.kind() == FootageKind::kPicture) return;
  const std::vector<int> covers = front.frames(), frames = job.frames ? *job.frames : back.frames();
  if (covers.empty() || frames.empty()) return;
  const auto is_covered = [&](int frame) { return std::binary_search(covers.begin(), covers.end(), frame); };
  if (std::any_of(frames.begin(), frames.end(), is_covered)) return;
  warn(fmt::format("no frame of '{}' ({}) has the same number as one of '{}' ({}): nothing is composited",
                   job.foreground, ods::frames_text(covers), job.background, ods::frames_text(frames)));
}

void lay_all(const OverJob& job, ProgressLines& lines) {
  ods::MediaFile media = open_input(job.background, {.known = job.known});
  const ods::FormatHint known = media.hint;
  std::optional<ods::PictureReader> reader;
  if (ods::footage_kind(job.background) == FootageKind::kPicture) reader = reader_of(std::move(media));
  Footage back(job.background, known, std::move(reader));
  Footage front(job.foreground, {});
  warn_of_no_cover(job, back, front);
  const bool to_video = ods::container_of_path(job.output).has_value();
  if (back.kind() == FootageKind::kVideo && to_video) return lay_over_video(job, back, front, lines);
  if (to_video) {
    throw UsageError("a video output needs a video as background; composite to -o 'x.####.png', then use ods encode");
  }
  if (back.kind() != FootageKind::kPicture) return lay_frames(job, back, front, lines);
  if (front.kind() != FootageKind::kPicture) {
    throw UsageError(
        fmt::format("'{}' is one picture, '{}' are many: the background decides how many pictures are made",
                    job.background, job.foreground));
  }
  lay_frame(job, back, front, 0, job.output, true);
}

void over(const OverJob& job) {
  run_long_job(job.progress, job.threads, [&](ProgressLines& lines) { lay_all(job, lines); });
}

}  // namespace

extern const Command kOver = make_command<parse_over, over>("over", "composite a picture or video over another");

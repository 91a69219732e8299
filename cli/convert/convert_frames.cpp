// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/convert_frames.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/picture_options.h"
#include "ods/base/memory.h"
#include "ods/base/pipeline.h"
#include "ods/files/frames.h"

using ods::FootageKind, ods::StoredPicture;

namespace {

// A picture on its way from the input to a file.
struct Work {
  size_t index = 0;
  std::optional<StoredPicture> picture;
  ods::DepthFootage::Give give;  // its depth; may be none
  ods::ViewAngles turned{0.0f, 0.0f, 0.0f};
  std::vector<std::string> files;
  double empty = 0.0, filled = 0.0;  // shares of the pixels
};

class Frames {
 public:
  explicit Frames(ConvertJob& job) : job_(job), names_(video_names(job.given.output)) {
    if (job_.footage) job_.footage->choose(job_.given.span());
    for (size_t i = 0; i < job_.files.frames.size(); i++) refuse_overwriting(output_of(i), job_.files.path(i));
    const auto exists = [&](int frame) { return job_.given.share.skip_existing && ods::is_saved(names_.path(frame)); };
    std::erase_if(job_.files.frames, exists);
  }

  bool take(Work& work) {
    work.index = next_;
    if (job_.kind == FootageKind::kFrames) {
      if (next_ == job_.files.frames.size()) return false;
      if (job_.depth_frames) work.give = job_.depth_frames->next(job_.files.frames[next_]);
      next_++;
      return true;
    }
    const std::optional<ods::DecodedFrame> frame = job_.footage->next();
    if (!frame) return false;
    work.picture = picture_of(job_.footage->video(), job_.footage->stream(), *frame);
    if (job_.depth_frames) work.give = job_.depth_frames->next({});
    if (!job_.turns.empty()) work.turned = turned_at(job_.turns, job_.footage->seconds_of(*frame));
    next_++;
    return true;
  }

  void convert(Work& work) const {
    ods::ConvertTarget target = job_.target;
    target.turned = work.turned;
    if (job_.merges) target.camera.merge_map = job_.merges->at(place_of(work.index));
    if (!work.picture) {
      work.picture = open_frame(job_.files, work.index, job_.picture);
    }
    if (work.give) {
      const ods::DepthReport report = work.give(*work.picture);
      if (work.index == 0) note_depth(report);
    }
    if (job_.kind == FootageKind::kFrames) refuse_impossible(job_, *work.picture);
    ods::Conversion conversion = ods::convert(*work.picture, target);
    const ods::PictureRows& rows = conversion.rows;
    work.files = save_picture(rows, &target.camera, job_.save, output_of(work.index));
    const double pixels = 1.0 * rows.eye.width * rows.eye.height * static_cast<double>(rows.eyes.size());
    work.empty = static_cast<double>(*conversion.empty) / pixels;
    work.filled = static_cast<double>(*conversion.filled) / pixels;
    work.picture.reset();
  }

  // The index of a picture among those of all processes.
  int place_of(size_t index) const {
    if (job_.kind == FootageKind::kVideo) return static_cast<int>(index);
    const std::vector<int>& every = job_.every_frame;
    return static_cast<int>(std::ranges::find(every, job_.files.frames[index]) - every.begin());
  }

  // Frames keep their numbers; frames of a video count from 0.
  std::string output_of(size_t index) const {
    return names_.path(job_.kind == FootageKind::kFrames ? job_.files.frames[index] : static_cast<int>(index));
  }

 private:
  ConvertJob& job_;
  ods::FrameNames names_;
  size_t next_ = 0;
};

size_t frames_at_once(const ConvertJob& job) {
  const ods::Extent old = job.picture.size, made = job.target.eye;
  const size_t pixels = static_cast<size_t>(old.width) * static_cast<size_t>(old.height) +
                        static_cast<size_t>(made.width) * static_cast<size_t>(made.height);
  const size_t bytes = 2 * pixels * 4 * sizeof(float);
  return std::clamp<size_t>(ods::available_memory() / 2 / bytes, 1,
                            static_cast<size_t>(tbb::this_task_arena::max_concurrency()) + 1);
}

}  // namespace

void convert_to_frames(ConvertJob& job, ProgressLines& lines) {
  const auto start = std::chrono::steady_clock::now();
  const bool from_video = job.kind == FootageKind::kVideo;
  if (from_video) refuse_other_colors(job.footage->stream(), job.given.input);
  open_depth(job);
  find_merges(job);
  Frames frames(job);
  note_guesses(job.given.input, job.picture);
  const size_t expected = from_video ? static_cast<size_t>(job.footage->expected_count()) : job.files.frames.size();
  size_t done = 0;
  double empty = 0.0, filled = 0.0;
  const auto report = [&](const Work& work) {
    for (const std::string& file : work.files) announce_file(file);
    empty += work.empty, filled += work.filled;
    done++;
    const size_t all = std::max(expected, done);
    lines.report(static_cast<double>(done) / static_cast<double>(all), seconds_since(start),
                 {"convert", static_cast<int>(done), static_cast<int>(all), frames.output_of(work.index)});
  };
  ods::run_pipeline<Work>(
      frames_at_once(job), [&](Work& work) { return frames.take(work); }, [&](Work& work) { frames.convert(work); },
      report);
  lines.clear();
  if (done == 0 && from_video)
    throw UsageError(fmt::format("there is no picture in that part of '{}'", job.given.input));
  note_empty_share(empty / static_cast<double>(std::max<size_t>(done, 1)), false);
  note_filled_share(filled / static_cast<double>(std::max<size_t>(done, 1)));
  note(fmt::format("{}: {} frames, in {}", job.given.output, done, duration_text(seconds_since(start))));
}

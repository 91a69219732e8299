// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/write_video.h"

#include <tbb/task_arena.h>

#include <algorithm>

#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/base/pipeline.h"

namespace ods {

namespace {

struct Work {
  PendingFrame pending;
  std::shared_ptr<VideoFrame> frame;
};

}  // namespace

static size_t frames_at_once(const NewVideo& video) {
  const size_t bytes = video.frame_bytes + VideoFrame(video.size, video.options.packing).bytes();
  const auto threads = static_cast<size_t>(tbb::this_task_arena::max_concurrency());
  return std::clamp<size_t>(available_memory() / 2 / bytes, 1, threads + 1);
}

static int encode_frames(const NewVideo& video, const std::function<std::optional<PendingFrame>()>& next,
                         VideoEncoder& encoder, const Progress& progress) {
  int done = 0;
  const auto take = [&](Work& work) {
    if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "cancelled");
    std::optional<PendingFrame> pending = next();
    if (pending) work.pending = std::move(*pending);
    return pending.has_value();
  };
  const auto make = [](Work& work) {
    work.frame = work.pending.make();
    work.pending.make = nullptr;  // frees the old picture
  };
  const auto encode = [&](const Work& work) {
    encoder.add(work.frame, work.pending.time);
    done++;
    if (progress.report) progress.report(std::min(1.0, static_cast<double>(done) / std::max(video.count, done)));
  };
  run_pipeline<Work>(frames_at_once(video), take, make, encode);
  return done;
}

WrittenVideo write_video(const NewVideo& video, const std::function<std::optional<PendingFrame>()>& next,
                         const std::string& path, const Progress& progress) {
  const EncodeOptions& options = video.options;
  AtomicFile untagged(path);
  VideoEncoder encoder(untagged, *container_of_path(path), video.size, options);
  WrittenVideo written;
  written.frames = encode_frames(video, next, encoder, progress);
  encoder.finish();
  std::optional<Ambisonics> ambisonics = video.ambisonics;
  if (!options.copies_sound && !options.sound.empty() && read_sound_info(options.sound).channels == 4) {
    ambisonics.emplace();
  }
  SphericalMetadata metadata = video.metadata;
  metadata.for_apple = metadata.for_apple || options.for_apple;
  const VideoFile made = read_video_file(untagged.temporary());
  written.tags = tag_video(untagged.temporary(), path, choose_track(made, {}, path).id, metadata, ambisonics);
  return written;
}

}  // namespace ods

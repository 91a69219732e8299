// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/write_video.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/base/pipeline.h"
#include "ods/files/md5.h"
#include "ods/files/parts_file.h"
#include "ods/video/tracks/kept_tags.h"
#include "ods/video/tracks/kept_tracks.h"
#include "ods/video/tracks/sound.h"

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

// --- parts -----------------------------------------------------------------------------------------------------------

// A picture's four numbers, 8 bytes each, and its bytes.
static std::string record_of(const EncodedPicture& picture) {
  std::string record;
  for (const int64_t each : {picture.shown, picture.decoded, picture.duration, int64_t{picture.flags}}) {
    append_number(record, static_cast<uint64_t>(each), 8);
  }
  return record.append(picture.bytes);
}

static EncodedPicture picture_of(std::string_view record) {
  const auto number = [&](size_t index) { return static_cast<int64_t>(get_number(record, 8 * index, 8)); };
  return {number(0), number(1), number(2), static_cast<int>(number(3)), record.substr(32)};
}

namespace {

// The finished parts of a video, kept for a later call.
class Parts {
 public:
  Parts(const NewVideo& video, const std::string& path, VideoEncoder& encoder) : encoder_(encoder) {
    Settings settings = video.resume.settings;
    if (settings.empty() || video.options.bitrate) return;
    const int interval = key_interval(video.options.rate);
    frames_ = (kPartFrames + interval - 1) / interval * interval;
    settings.push_back({"parts", fmt::format("{}", frames_), ""});
    settings.push_back({"header", md5(encoder.header()), ""});
    file_.emplace(path, settings, video.resume.restart);
    if (video.resume.tell && finished() > 0) {
      video.resume.tell(fmt::format("resuming after {} frames from '{}'", finished(), file_->path()));
    }
    file_->read([&](std::string_view record) { encoder_.add(picture_of(record)); });
    encoder_.keep([this](const EncodedPicture& picture) { file_->add(record_of(picture)); });
  }

  int finished() const { return file_ ? file_->count() * frames_ : 0; }

  // Called after each frame. done: number of frames in the encoder, including finished ones.
  void count(int done) {
    if (!file_ || done % frames_ != 0) return;
    encoder_.end_part();
    file_->end_part();
  }

  void remove() {
    if (file_) file_->remove();
  }

 private:
  VideoEncoder& encoder_;
  std::optional<PartsFile> file_;
  int frames_ = 0;  // per part
};

}  // namespace

// --- the video -------------------------------------------------------------------------------------------------------

static int encode_frames(const NewVideo& video, const std::function<std::optional<PendingFrame>()>& next,
                         VideoEncoder& encoder, Parts& parts, const Progress& progress) {
  int done = 0;
  while (done < parts.finished() && next()) done++;
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
    parts.count(++done);
    if (progress.report) progress.report(std::min(1.0, static_cast<double>(done) / std::max(video.count, done)));
  };
  run_pipeline<Work>(frames_at_once(video), take, make, encode);
  return done;
}

// The old video's sound metadata; four channels of new sound are first-order ambisonics.
static OtherTags other_tags(const EncodeOptions& options, Container container) {
  OtherTags tags;
  if (!has_boxes(container)) return tags;
  tags.sound = kept_ambisonics(options.keep, container);
  if (!options.sound.empty()) {
    const bool is_field = read_sound_info(options.sound).channels == 4;
    tags.sound.push_back(is_field ? std::optional(Ambisonics()) : std::nullopt);
  }
  if (!options.keep.path.empty()) tags.user = read_user_data(options.keep.path, options.keep.track);
  return tags;
}

static void report_lost_tags(const KeepOptions& keep, const std::string& made) {
  if (!keep.tell) return;
  for (const std::string& tag : lost_tags(keep, made)) keep.tell(fmt::format("{} has no place in the new file", tag));
}

WrittenVideo write_video(const NewVideo& video, const std::function<std::optional<PendingFrame>()>& next,
                         const std::string& path, const Progress& progress) {
  const EncodeOptions& options = video.options;
  const Container container = *container_of_path(path);
  AtomicFile untagged(path);
  VideoEncoder encoder(untagged, container, video.size, options);
  WrittenVideo written;
  Parts parts(video, path, encoder);
  written.frames = encode_frames(video, next, encoder, parts, progress);
  encoder.finish();
  SphericalMetadata metadata = video.metadata;
  // Vision Pro reads no other metadata, and of these codecs it takes HEVC.
  const bool may_be_apples = options.packing.codec == VideoCodec::kHevc && has_boxes(container) && fits_vexu(metadata);
  metadata.for_apple = metadata.for_apple || options.for_apple || may_be_apples;
  const VideoFile made = read_video_file(untagged.temporary());
  written.tags =
      tag_video(untagged.temporary(), path, choose_track(made, {}, path).id, metadata, other_tags(options, container));
  report_lost_tags(options.keep, path);
  parts.remove();
  return written;
}

}  // namespace ods

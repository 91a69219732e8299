// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/footage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <numeric>

namespace ods {

static bool exists(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(names_eye(path) ? path_for_eye(path, kLeft) : path, ignored);
}

FootageKind footage_kind(const std::string& path) {
  if (frame_names(path)) return FootageKind::kFrames;
  const bool has_videos_bytes = exists(path) && !names_eye(path) && is_video(path);
  return container_of_path(path) || has_videos_bytes ? FootageKind::kVideo : FootageKind::kPicture;
}

Footage::Footage(const std::string& path, const FormatHint& known, std::optional<PictureReader> reader)
    : path_(path), known_(known), kind_(footage_kind(path)), names_(frame_names(path)), reader_(std::move(reader)) {
  if (kind_ != FootageKind::kVideo) return;
  video_ = open_video(path, known);
  decoder_ = std::make_unique<VideoDecoder>(path, video_->track, video_->views);
}

std::vector<int> Footage::frames() const {
  if (kind_ == FootageKind::kPicture) return {};
  if (kind_ == FootageKind::kFrames) return frames_on_disk(*names_);
  std::vector<int> frames(static_cast<size_t>(stream().count));
  std::iota(frames.begin(), frames.end(), 0);
  return frames;
}

std::string Footage::path_of(int frame) const {
  return kind_ == FootageKind::kFrames ? names_->path(frame) : path_;
}

std::optional<DecodedFrame> Footage::decode(int frame) {
  assert(kind_ == FootageKind::kVideo && frame >= next_);
  std::optional<DecodedFrame> decoded;
  for (; next_ <= frame; next_++) {
    decoded = decoder_->next();
    if (!decoded) return std::nullopt;
  }
  return decoded;
}

void Footage::choose(const TimeSpan& span) {
  assert(kind_ == FootageKind::kVideo && next_ == 0);
  span_ = span;
  if (span.from > 0.0) decoder_->skip_to(stream().start + span.from);
}

std::optional<DecodedFrame> Footage::next() {
  std::optional<DecodedFrame> frame = decode(next_);
  const double rounded = 0.5 / stream().clock.value();  // rounding error of a time: half a tick
  return frame && span_.to && seconds_of(*frame) >= *span_.to - rounded ? std::nullopt : frame;
}

double Footage::seconds_of(const DecodedFrame& frame) const {
  return stream().seconds_at(frame.time);
}

int Footage::expected_count() const {
  const double rate = stream().rate.value(), all = stream().count / rate;
  const double end = std::min(span_.to.value_or(all), all);
  return std::max(1, static_cast<int>(std::lround((end - span_.from) * rate)));
}

std::optional<StoredPicture> Footage::picture(int frame) {
  OpenOptions options;
  options.format = known_;
  if (kind_ == FootageKind::kVideo) {
    refuse_other_colors(stream(), path_);
    const std::optional<DecodedFrame> decoded = decode(frame);
    return decoded ? std::optional(picture_of(*video_, stream(), *decoded)) : std::nullopt;
  }
  if (kind_ == FootageKind::kFrames) {
    const std::string path = names_->path(frame);
    return exists(path) ? std::optional(open_picture(path, options)) : std::nullopt;
  }
  if (!still_) still_ = reader_ ? reader_->read("") : open_picture(path_, options);
  reader_.reset();
  return still_;
}

}  // namespace ods

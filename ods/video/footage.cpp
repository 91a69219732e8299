// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/footage.h"

#include <cassert>
#include <filesystem>
#include <numeric>

namespace ods {

static bool exists(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(names_eye(path) ? path_for_eye(path, kLeft) : path, ignored);
}

Footage::Footage(const std::string& path, const FormatHint& known)
    : path_(path), known_(known), names_(frame_names(path)) {
  if (names_) {
    kind_ = FootageKind::kFrames;
  } else if (container_of_path(path) || (exists(path) && !names_eye(path) && is_video(path))) {
    kind_ = FootageKind::kVideo;
    video_ = open_video(path, known);
    decoder_ = std::make_unique<VideoDecoder>(path, video_->track);
  }
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

std::optional<StoredPicture> Footage::picture(int frame) {
  OpenOptions options;
  options.format = known_;
  if (kind_ == FootageKind::kVideo) {
    const std::optional<DecodedFrame> decoded = decode(frame);
    return decoded ? std::optional(picture_of(*video_, stream(), *decoded)) : std::nullopt;
  }
  if (kind_ == FootageKind::kFrames) {
    const std::string path = names_->path(frame);
    return exists(path) ? std::optional(open_picture(path, options)) : std::nullopt;
  }
  if (!still_) still_ = open_picture(path_, options);
  return still_;
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/video/depth_footage.h"

#include <fmt/format.h>

#include "ods/base/error.h"
#include "ods/files/frames.h"

namespace ods {

namespace {

// Depth has the eyes and the shape of its pictures, regardless of its own metadata.
Footage open_depth(const std::string& path, const StoredPicture& format) {
  FormatHint known;
  known.one_eye = format.eyes.size() == 1;
  if (!known.one_eye) known.layout = format.layout;
  known.projection = format.camera.projection;
  return Footage(path, known);
}

// Converts a grey frame of a video to numbers from 0 to 1 of its range.
DepthNumbers numbers_of(const Footage& footage, const DecodedFrame& frame) {
  const VideoStream& stream = footage.stream();
  DepthNumbers depth{Image(stream.size.width, stream.size.height, 1), (1 << stream.bits) - 1, footage.path()};
  const size_t width = static_cast<size_t>(stream.size.width);
  std::vector<float> row(3 * width);
  for (int y = 0; y < stream.size.height; y++) {
    get_codes(frame.planes, stream.size, stream.color, y, 0, row);
    for (size_t x = 0; x < width; x++) {
      *depth.numbers.at(static_cast<int>(x), y) = finite(row[width + x], 0.0f, 1.0f);  // green
    }
  }
  return depth;
}

}  // namespace

DepthFootage::DepthFootage(const std::string& path, const StoredPicture& format, const DepthOptions& options,
                           const TimeSpan& part, std::optional<int> first)
    : path_(path), format_(format), options_(options), kind_(footage_kind(path)), first_(first) {
  if (kind_ == FootageKind::kFrames) frames_ = frames_on_disk(*frame_names(path));
  if (kind_ != FootageKind::kVideo) return;
  footage_.emplace(open_depth(path, format));
  footage_->choose(part);
}

DepthFootage::Give DepthFootage::next(std::optional<int> number) {
  if (std::optional<Give> give = next_if_any(number)) return *give;
  throw Error(ErrorKind::kInput, fmt::format("'{}' ends before the pictures whose depth it is", path_));
}

std::optional<DepthFootage::Give> DepthFootage::next_if_any(std::optional<int> number) {
  const size_t index = taken_++;
  const auto known = [&](const std::vector<DepthNumbers>& depth) {
    if (options_.eye_height && !options_.scale) options_.scale = scale_of(depth[0], format_, options_);
  };
  if (kind_ == FootageKind::kVideo) {
    const std::optional<DecodedFrame> frame = footage_->next();
    if (!frame) return std::nullopt;
    if (index == 0) known(depth_of_eyes(numbers_of(*footage_, *frame), format_));
    return [this, frame = *frame, options = options_](StoredPicture& picture) {
      return add_depth(picture, depth_of_eyes(numbers_of(*footage_, frame), picture), options);
    };
  }
  if (kind_ == FootageKind::kPicture) {
    if (!still_) {
      still_ = std::make_shared<const std::vector<DepthNumbers>>(read_depth(path_, format_));
      known(*still_);
    }
    return [still = still_, options = options_](StoredPicture& picture) { return add_depth(picture, *still, options); };
  }
  if (!number && index >= frames_.size()) return std::nullopt;
  const FrameNames names = *frame_names(path_);
  const std::string file = names.path(number ? *number : frames_[index]);
  if (index == 0) known(read_depth(first_ ? names.path(*first_) : file, format_));
  return [file, options = options_](StoredPicture& picture) {
    return add_depth(picture, read_depth(file, picture), options);
  };
}

}  // namespace ods

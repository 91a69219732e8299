// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/video/convert_video.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>

#include "ods/base/error.h"
#include "ods/video/video_clock.h"

namespace ods {

static glm::dmat3 axes_of(const ViewAngles& angles) {
  const auto degrees = [](float value) { return glm::radians(static_cast<double>(value)); };
  const auto [right, up, back] = orientation(degrees(angles.yaw), degrees(angles.pitch), degrees(angles.roll));
  return {right, up, back};
}

// The rotation of the sound with the pictures. Returns no rotation if they do not turn.
static SoundTurn sound_turn(const Footage& footage, const VideoConversion& conversion) {
  const auto angles = [](const StereoCamera& camera) { return ViewAngles{camera.yaw, camera.pitch, camera.roll}; };
  const glm::dmat3 before = axes_of(angles(footage.video().prototype.camera));
  const glm::dmat3 turn = glm::transpose(axes_of(angles(conversion.target.camera))) * before;
  if (turn == glm::transpose(before) * before && conversion.turns.empty()) return {};
  return [turn, keys = conversion.turns, start = footage.stream().start](double seconds) {
    return keys.empty() ? turn : turn * axes_of(turned_at(keys, seconds - start));
  };
}

// The depth of the next picture. Reports on the first one through `tell`.
static DepthFootage::Give next_depth(DepthFootage& depth, std::optional<int> number, bool is_first,
                                     const std::function<void(const DepthReport&)>& tell) {
  if (!is_first || !tell) return depth.next(number);
  return [give = depth.next(number), tell](StoredPicture& picture) {
    const DepthReport report = give(picture);
    tell(report);
    return report;
  };
}

// Converts a frame whose eyes are moved by its depth.
static std::shared_ptr<VideoFrame> convert_with_depth(const Footage& footage, const DecodedFrame& frame,
                                                      const DepthFootage::Give& give, const ConvertTarget& target,
                                                      const FrameFormat& format) {
  StoredPicture picture = picture_of(footage.video(), footage.stream(), frame);
  give(picture);
  return frame_of(convert(picture, target).rows, format, {});
}

int convert_video(Footage& footage, const VideoConversion& conversion, EncodeOptions options, const std::string& path,
                  const Progress& progress) {
  assert(footage.kind() == FootageKind::kVideo);
  const VideoStream& stream = footage.stream();
  options.rate = stream.rate, options.color = stream.color, options.words = stream.words;
  std::optional<DecodedFrame> frame = footage.next();
  if (!frame) throw Error(ErrorKind::kUsage, fmt::format("there is no picture in that part of '{}'", footage.path()));
  if (options.keep.tell) {
    for (const std::string& each : stream.unkept) options.keep.tell(each + " are lost");
  }
  options.keep.turn = sound_turn(footage, conversion);
  const VideoClock clock(stream, frame->time, options.keep.cut.is_cut);
  clock.set(options);

  const FrameFormat format{conversion.layout, options.packing, options.color};
  std::optional<FrameConverter> converter;
  if (conversion.depth) {
    refuse_other_colors(stream, footage.path());
  } else {
    converter.emplace(footage.video(), stream, conversion.target, format, !conversion.turns.empty());
  }
  int next = 0;
  const auto pending = [&]() -> std::optional<PendingFrame> {
    if (!frame) return std::nullopt;
    ViewAngles turned{0.0f, 0.0f, 0.0f};
    if (!conversion.turns.empty()) turned = turned_at(conversion.turns, footage.seconds_of(*frame));
    PendingFrame result{clock(frame->time), {}};
    if (conversion.depth) {
      ConvertTarget target = conversion.target;
      target.turned = turned;
      if (conversion.merge) target.camera.merge_map = conversion.merge(next);
      const auto give = next_depth(*conversion.depth, {}, next == 0, conversion.tell);
      result.make = [&footage, target, give, format, old = *frame] {
        return convert_with_depth(footage, old, give, target, format);
      };
    } else {
      result.make = [&converter, turned, old = *frame] { return converter->convert(old, turned); };
    }
    frame = footage.next();
    next++;
    return result;
  };
  const int eyes = static_cast<int>(conversion.target.eyes.size());
  NewVideo video;
  video.size = packed_size(conversion.layout, conversion.target.eye, eyes);
  video.options = options, video.metadata = conversion.metadata, video.resume = conversion.resume;
  video.count = footage.expected_count();
  const size_t pixels = static_cast<size_t>(stream.size.width) * static_cast<size_t>(stream.size.height);
  video.frame_bytes = pixels * 6;  // the decoded frame
  return write_video(video, pending, path, progress).frames;
}

StoredPicture open_frame(const FrameFiles& files, size_t index, const StoredPicture& first) {
  OpenOptions open;
  open.format.layout = first.layout;
  open.format.camera = first.camera;
  const std::string path = files.path(index);
  StoredPicture picture = open_picture(path, open);
  picture.maps = first.maps, picture.front_and_back = first.front_and_back;
  for (size_t i = 0; i < std::min(picture.eyes.size(), first.eyes.size()); i++) picture.eyes[i].eye = first.eyes[i].eye;
  if (picture.size.width == first.size.width && picture.size.height == first.size.height &&
      picture.eyes.size() == first.eyes.size())
    return picture;
  throw Error(ErrorKind::kInput, fmt::format("'{}' is not like the first frame, '{}'", path, files.path(0)));
}

static std::shared_ptr<VideoFrame> convert_file(const FramesConversion& conversion, size_t index,
                                                const DepthFootage::Give& give, const FrameFormat& format) {
  StoredPicture picture = open_frame(conversion.files, index, conversion.first);
  if (give) give(picture);
  ConvertTarget target = conversion.target;
  if (conversion.merge) target.camera.merge_map = conversion.merge(static_cast<int>(index));
  const std::string fault = conversion_fault(picture, target);
  if (!fault.empty()) throw Error(ErrorKind::kUsage, fmt::format("'{}': {}", conversion.files.path(index), fault));
  std::optional<DisplayTransform> display;
  if (picture.is_float) display = conversion.display;
  return frame_of(convert(picture, target).rows, format, display);
}

int convert_frames(const FramesConversion& conversion, const EncodeOptions& options, const std::string& path,
                   const Progress& progress) {
  const FrameFormat format{conversion.layout, options.packing, options.color};
  const std::vector<int>& frames = conversion.files.frames;
  size_t next = 0;
  const auto pending = [&]() -> std::optional<PendingFrame> {
    if (next == frames.size()) return std::nullopt;
    const size_t index = next++;
    DepthFootage::Give give;
    if (conversion.depth) give = next_depth(*conversion.depth, frames[index], index == 0, conversion.tell);
    return PendingFrame{{static_cast<int64_t>(index), 1},
                        [&, index, give] { return convert_file(conversion, index, give, format); }};
  };
  const Extent old = conversion.first.size;
  const int eyes = static_cast<int>(conversion.target.eyes.size());
  NewVideo video;
  video.size = packed_size(conversion.layout, conversion.target.eye, eyes);
  video.options = options, video.metadata = conversion.metadata, video.resume = conversion.resume;
  video.count = static_cast<int>(frames.size());
  video.frame_bytes = static_cast<size_t>(old.width) * static_cast<size_t>(old.height) * conversion.first.eyes.size() *
                      4 * sizeof(float);
  return write_video(video, pending, path, progress).frames;
}

}  // namespace ods

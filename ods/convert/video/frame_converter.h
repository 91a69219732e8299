// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts the pictures of a video, or of frames, into frames of a new video: bit for bit as convert() converts each.
// Only where pixels merely move are a video's own numbers copied (shifted_frame.h), which loses less: as colours, its
// chroma would be interpolated and averaged.
//
// SDR is resampled in linear light, by sRGB's curve, as pictures are. HDR is resampled in its code values: PQ and HLG
// are made so that equal steps look alike, and in linear light a highlight of a hundred times the white would outweigh
// all its neighbours, so that its edges were jagged. Values above white and below black are kept.
#pragma once
#include <memory>

#include "ods/convert/convert.h"
#include "ods/video/decode.h"
#include "ods/video/video_frame.h"
#include "ods/video/video_input.h"

namespace ods {

// The frames to make.
struct FrameFormat {
  Layout layout = Layout::kTopBottom;  // of two eyes, each half of the frame
  Packing packing;
  ColorCode color;
};

// A conversion of a video's pictures.
class FrameConverter {
 public:
  // target.eye: as stored, that is squeezed for a squeezed layout. has_turns: every frame is turned by angles of its
  // own. `video` and `stream` must outlive the converter. Preconditions: conversion_fault() is empty, no alpha.
  FrameConverter(const VideoInput& video, const VideoStream& stream, const ConvertTarget& target,
                 const FrameFormat& format, bool has_turns);
  ~FrameConverter();

  // turned: as in ConvertTarget; ignored without has_turns. May be called concurrently.
  std::shared_ptr<VideoFrame> convert(const DecodedFrame& frame, const ViewAngles& turned) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The frame of a converted picture. `display` is for scene-linear light, none for display-encoded pictures.
std::shared_ptr<VideoFrame> frame_of(const PictureRows& rows, const FrameFormat& format,
                                     const std::optional<DisplayTransform>& display);

}  // namespace ods

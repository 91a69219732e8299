// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts the pictures of a video, or single frames, to frames of a new video: bit for bit like convert() converts
// each picture. If pixels merely move, the video's own numbers are copied instead (shifted_frame.h), which loses less,
// because a conversion of colours would interpolate and average chroma.
//
// SDR is resampled in linear light, by sRGB's curve, like pictures. HDR is resampled in its code values: equal steps of
// PQ and HLG look equal, whereas in linear light a highlight of a hundred times the white would outweigh all adjacent
// pixels, and its edges would be jagged. Values above white and below black are kept.
#pragma once
#include <memory>

#include "ods/convert/convert.h"
#include "ods/video/decode.h"
#include "ods/video/video_frame.h"
#include "ods/video/video_input.h"

namespace ods {

// The format of the new frames.
struct FrameFormat {
  Layout layout = Layout::kTopBottom;  // for two eyes, each half of the frame
  Packing packing;
  ColorCode color;
};

// A conversion of a video's pictures.
class FrameConverter {
 public:
  // target.eye: as stored, that is, squeezed for a squeezed layout. has_turns: every frame has its own rotation.
  // `video` and `stream` must outlive the converter. Preconditions: conversion_fault() is empty, no alpha.
  FrameConverter(const VideoInput& video, const VideoStream& stream, const ConvertTarget& target,
                 const FrameFormat& format, bool has_turns);
  ~FrameConverter();

  // turned: as in ConvertTarget; ignored without has_turns. May be called concurrently.
  std::shared_ptr<VideoFrame> convert(const DecodedFrame& frame, const ViewAngles& turned) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Makes a frame of a converted picture. `display` is for scene-linear light, and not set for display-encoded pictures.
std::shared_ptr<VideoFrame> frame_of(const PictureRows& rows, const FrameFormat& format,
                                     const std::optional<DisplayTransform>& display);

}  // namespace ods

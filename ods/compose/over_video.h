// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Composites titles and computer graphics over a video: decode, change the covered pixels, encode. Uncovered pixels
// keep their code values if the video is limited-range BT.709 and the new one has the same bit depth and chroma;
// otherwise they are converted. Light is mixed as in over.h. A chroma sample shared by several pixels is their mean, in
// which uncovered pixels keep their old value.
#pragma once
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/compose/over.h"
#include "ods/video/footage.h"

namespace ods {

// The covered part of a picture, in the layout of the video's eyes.
struct AlphaRow {
  int first = 0;            // column of the first pixel
  std::vector<float> rgba;  // premultiplied linear light
};
struct Cover {
  std::vector<std::vector<AlphaRow>> eyes;  // rows of each eye; empty where nothing is covered
};

// Precondition: no over_fault().
Cover make_cover(const StoredPicture& foreground, const StoredPicture& video, const OverOptions& options);

// Copies all planes unchanged. Precondition: the same bit depth and chroma.
void copy_planes(const Planes& from, Extent size, const Planes& to);

// A video's picture converted to a frame of the new video, of the same size.
std::shared_ptr<VideoFrame> copied_frame(const DecodedFrame& frame, const VideoStream& stream, const VideoInput& video,
                                         const Packing& packing);

// Composites the cover into `to`, which contains the same picture as `from`;
// both are whole pictures in the video's layout.
void lay_cover(const Cover& cover, const StoredPicture& video, const ColorCode& color, const Planes& from,
               const Planes& to);

// Composites `front` over frames first..last of `back`, a video, into a new video of the same format. Frames that
// `front` does not have stay unchanged. `options` specify the sound. Throws Error like VideoEncoder and VideoDecoder;
// kUsage for a foreground that cannot be composited. Returns the number of frames.
int over_video(Footage& back, Footage& front, int first, int last, const OverOptions& over,
               const EncodeOptions& options, const std::string& path, const Progress& progress = {});

}  // namespace ods

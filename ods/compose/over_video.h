// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Titles and computer graphics over a video: the video is decoded, changed where something stands before it, and
// encoded again. Where nothing does, its numbers reach the encoder as they are, if it is of BT.709 of limited range and
// the new video of as many bits and as much colour; else they become that. Light is mixed as over.h does it, and a
// colour that several pixels share is the mean of theirs, those that are not covered counting with what they had.
#pragma once
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/compose/over.h"
#include "ods/video/footage.h"

namespace ods {

// What of a picture is covered, in the form of the video's eyes.
struct AlphaRow {
  int first = 0;            // column of the first pixel
  std::vector<float> rgba;  // light multiplied by alpha
};
struct Cover {
  std::vector<std::vector<AlphaRow>> eyes;  // of each its rows; empty ones where there is nothing
};

// Precondition: no over_fault().
Cover make_cover(const StoredPicture& foreground, const StoredPicture& video, const OverOptions& options);

// All numbers of a picture as they are. Precondition: of the same bits and chroma.
void copy_planes(const Planes& from, Extent size, const Planes& to);

// A video's picture as a frame of the new one, of the same size.
std::shared_ptr<VideoFrame> copied_frame(const DecodedFrame& frame, const VideoStream& stream, const VideoInput& video,
                                         const Packing& packing);

// Changes what the cover covers in `to`, which shows the same as `from`; both are whole pictures of the video's layout.
void lay_cover(const Cover& cover, const StoredPicture& video, const ColorCode& color, const Planes& from,
               const Planes& to);

// How a video is encoded that is to be as this one is; nothing where that cannot be.
std::optional<Packing> packing_like(const VideoStream& stream, Container container);

// Lays `front` over frames first..last of `back`, a video, which become a video of the same form; where there is no
// such frame in front, it stays as it is. Its sound is what `options` say. Throws Error as VideoEncoder and
// VideoDecoder do; kUsage for a foreground that cannot be laid over. Returns how many frames there were.
int over_video(Footage& back, Footage& front, int first, int last, const OverOptions& over,
               const EncodeOptions& options, const std::string& path, const Progress& progress = {});

}  // namespace ods

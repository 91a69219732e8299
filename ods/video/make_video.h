// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Encodes pictures, one file or two per frame, into a tagged video.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/files/frames.h"
#include "ods/video/encode.h"

namespace ods {

// The frames of a video, as files.
struct FrameFiles {
  std::string pattern;  // shot.####.exr (ods/files/frames.h); with %V or %v in it, a file per eye
  std::vector<int> frames;
  std::string path(size_t index) const;  // path of a frame; %V is kept as in the pattern
};

// The requested frames, or all that exist. Throws Error(kUsage) if the pattern has no frame number; Error(kInput) for
// missing frames, all listed at once ("7,9-12"), including gaps between the first and the last existing frame.
FrameFiles find_frames(const std::string& pattern, const std::optional<std::vector<int>>& wanted = {});

// The format of the video, from its first frame.
struct VideoPlan {
  FormatHint known;  // the same for every frame
  Extent eye;        // as stored
  size_t eyes = 1;   // per frame
  Extent size;       // size of the video
  Layout layout = Layout::kTopBottom;
  SphericalMetadata metadata;
  std::vector<std::string> notes;  // for users: guesses, and properties that the video's metadata cannot express
};

// The plan for `count` eyes of size `eye` as stored, in a layout that videos support.
VideoPlan plan_eyes(Extent eye, size_t count, Layout layout, const ProjectionSetting& projection);

// `known` takes precedence over the files' metadata; `layout` is kTopBottom or kSideBySide. Reads the first frame and
// the headers of the others. Throws Error(kInput) for an unreadable frame, or frames of another size (listed);
// Error(kUsage) for a layout that squeezed eyes cannot have.
VideoPlan plan_video(const FrameFiles& files, const FormatHint& known, std::optional<Layout> layout);

// Throws Error(kUsage) if the sides are not multiples of the chroma format's block.
void check_packing(const VideoPlan& plan, const Packing& packing);

// Writes the video atomically. Reads ahead as many frames as fit into half of the free memory. Throws Error: kInput,
// also for a frame unlike the first; kOutput, kMemory, kCancelled.
TagResult make_video(const FrameFiles& files, const VideoPlan& plan, const DisplayTransform& display,
                     const EncodeOptions& options, const std::string& path, const Progress& progress = {});

}  // namespace ods

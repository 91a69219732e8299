// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures, a file or two for every frame, into a video that says what it is.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/files/frames.h"
#include "ods/video/encode.h"

namespace ods {

// Frames of a video as files.
struct FrameFiles {
  std::string pattern;  // shot.####.exr (ods/files/frames.h); %V or %v in it: a file for each eye
  std::vector<int> frames;
  std::string path(size_t index) const;  // of a frame; with %V as the pattern has it
};

// The frames asked for, or all that there are. Throws Error(kUsage): the pattern has no place for a number. Throws
// Error(kInput): frames that are missing, all at once ("7,9-12"), also between the first and the last of those found.
FrameFiles find_frames(const std::string& pattern, const std::optional<std::vector<int>>& wanted = {});

// What a video of such frames is like, by the first of them.
struct VideoPlan {
  FormatHint known;  // of every frame
  Extent eye;        // as it is stored
  size_t eyes = 1;   // in a frame
  Extent size;       // of the video
  Layout layout = Layout::kTopBottom;
  SphericalMetadata metadata;
  std::vector<std::string> notes;  // what was guessed, and what the video cannot say, for people
};

// That of so many eyes, `eye` large as they are stored, in a layout that videos have.
VideoPlan plan_eyes(Extent eye, size_t count, Layout layout, const ProjectionSetting& projection);

// `known` goes before what the files say; `layout` is kTopBottom or kSideBySide. Reads the first frame, and of the
// others what they say of themselves. Throws Error(kInput): a frame that cannot be read, frames of another size
// (which); Error(kUsage): a layout that squeezed eyes cannot have.
VideoPlan plan_video(const FrameFiles& files, const FormatHint& known, std::optional<Layout> layout);

// What the plan's size is not fit for. Throws Error(kUsage): odd sides.
void check_packing(const VideoPlan& plan, const Packing& packing);

// Writes the video; whatever happens there is a complete one or none. The frames are read ahead, as many as half of the
// free memory holds. Throws Error: kInput, also for a frame that is not like the first; kOutput, kMemory, kCancelled.
TagResult make_video(const FrameFiles& files, const VideoPlan& plan, const DisplayTransform& development,
                     const EncodeOptions& options, const std::string& path, const Progress& progress = {});

}  // namespace ods

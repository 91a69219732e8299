// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The test card as a video: the static cards are drawn once, the moving marks (testcard.h) in every frame.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/compose/testcard.h"
#include "ods/video/make_video.h"

namespace ods {

// Half-open column ranges: [0] up to, but not including, [1].
using ColumnRuns = std::vector<std::array<int, 2>>;

struct TestcardVideo {
  Testcard card;
  StereoCamera camera;
  FrameRate rate;
  Packing packing;
  StoredPicture prototype;                    // eyes without layers
  std::shared_ptr<VideoFrame> still;          // without marks
  std::vector<std::vector<ColumnRuns>> runs;  // the pixels with marks, per row of each eye
};

// Makes the video's data. eyes: as in EyeImage; plan: from plan_eyes() for them. Precondition: eyes that do not overlap
// and are multiples of the chroma block.
TestcardVideo make_testcard_video(const Testcard& card, const StereoCamera& camera, const std::vector<int>& eyes,
                                  const VideoPlan& plan, FrameRate rate, const Packing& packing);

std::shared_ptr<VideoFrame> testcard_frame(const TestcardVideo& video, int number);

// A mono wav file as long as the video, 48 kHz, 16 bits: a beep of 1 kHz during each flash.
std::string testcard_sound(int frames, double fps);

// Draws and encodes the frames, with beeps unless options.sound specifies another file. Throws Error like make_video().
void write_testcard_video(const TestcardVideo& video, const VideoPlan& plan, int frames, EncodeOptions options,
                          const std::string& path, const Progress& progress = {});

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The test card as a video: what stands still is drawn once, and what moves (testcard.h) over it in every frame.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/testcard/testcard.h"
#include "ods/video/make_video.h"

namespace ods {

// Columns from [0] to [1], the latter not one of them.
using ColumnRuns = std::vector<std::array<int, 2>>;

struct TestcardVideo {
  Testcard card;
  StereoCamera camera;
  FrameRate rate;
  Packing packing;
  StoredPicture like;                         // eyes without layers
  std::shared_ptr<VideoFrame> still;          // without marks
  std::vector<std::vector<ColumnRuns>> runs;  // where marks are: of each eye its rows
};

// eyes as EyeImage has them; plan: of plan_eyes() for them. Precondition: eyes of whole blocks, that stand apart.
TestcardVideo make_testcard_video(const Testcard& card, const StereoCamera& camera, const std::vector<int>& eyes,
                                  const VideoPlan& plan, FrameRate rate, const Packing& packing);

std::shared_ptr<VideoFrame> testcard_frame(const TestcardVideo& video, int number);

// A wav file of one channel: a beep of 1 kHz while the flash is seen, as long as the video. 48 kHz, 16 bits.
std::string testcard_sound(int frames, double fps);

// Draws and encodes so many frames, with the beeps unless options.sound is something else. Throws Error as
// make_video().
void write_testcard_video(const TestcardVideo& video, const VideoPlan& plan, int frames, EncodeOptions options,
                          const std::string& path, const Progress& progress = {});

}  // namespace ods

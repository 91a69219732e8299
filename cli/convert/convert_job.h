// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods convert has to do.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/console/progress.h"
#include "cli/convert/depth_input.h"
#include "cli/options/camera_options.h"
#include "cli/options/share_options.h"
#include "cli/options/video_options.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/convert/convert.h"
#include "ods/convert/video/convert_video.h"
#include "ods/render/render_options.h"

struct ConvertJob {
  std::vector<std::string> arguments;  // as given
  std::string input;
  std::string output;
  ods::FormatHint known;  // of the input
  DepthInput depth;
  std::optional<ods::DepthFootage> depth_frames;  // of frames and videos, after open_depth()
  ods::FootageKind kind = ods::FootageKind::kPicture;
  ods::FrameFiles files;                     // of frames
  std::vector<int> every_frame;              // likewise, of all processes that share them
  std::optional<ods::Footage> footage;       // of a video
  std::optional<ods::PictureReader> reader;  // of a picture, until open_input()
  ods::StoredPicture picture;                // only its header until open_input(); of a video or of the first frame
  ods::ConvertTarget target;
  std::optional<float> merge_limit;        // --merge auto: the target's merge is found when the depth is there
  std::optional<ods::SteadyMerge> merges;  // likewise of frames and videos, after find_merges()
  ods::SaveOptions save;
  bool has_exposure = false, has_tone = false, has_layout = false;

  // Frames and videos.
  FrameShare share;
  bool restart = false;  // a video does not go on from what an interrupted run has kept
  ods::TimeSpan trim;
  std::vector<ods::TurnKey> turns;
  VideoWishes video;
  bool has_packing = false;  // an option says how to encode
  bool has_target = false;   // --target

  int threads = 0;
  ProgressMode progress = ProgressMode::kAuto;
};

// Values that are not given remain the input's. Returns false if help was asked for. Throws UsageError and ods::Error.
bool read_convert_job(ConvertJob& job, int argc, char** argv);

// Reads the input's pixels, if it is one picture. Throws UsageError and ods::Error.
void open_input(ConvertJob& job);

// Opens the depth of frames and videos, if they have any beside them. Throws UsageError and ods::Error.
void open_depth(ConvertJob& job);

// The number of the first frame, whichever process converts it; none of a video.
std::optional<int> first_of_all(const ConvertJob& job);

// The merges of --merge auto, of frames and videos. Throws UsageError and ods::Error.
void find_merges(ConvertJob& job);

// Asked of the header, so that nobody waits for pixels in vain, and of the pixels: reading them may leave out a layer
// of depth that the header promised. Throws UsageError.
void refuse_impossible(const ConvertJob& job, const ods::StoredPicture& picture);

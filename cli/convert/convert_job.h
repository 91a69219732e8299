// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A conversion that is ready to run: the options, the opened input, and the plan.
#pragma once
#include <optional>
#include <vector>

#include "cli/convert/plan_conversion.h"
#include "ods/comfort/merge_from_depth.h"

struct ConvertJob {
  ConvertOptions given;
  ods::FootageKind kind = ods::FootageKind::kPicture;
  ods::FrameFiles files;                     // the frames that this process converts
  std::vector<int> every_frame;              // the frames that all processes convert together
  std::optional<ods::Footage> footage;       // a video
  std::optional<ods::PictureReader> reader;  // a picture, until read_pixels()
  ods::StoredPicture picture;                // only the header, until read_pixels() for a picture
  ods::ConvertTarget target;
  ods::SaveOptions save;
  std::vector<ods::TurnKey> turns;
  std::optional<ods::DepthFootage> depth_frames;  // beside frames and videos, after open_depth()
  std::optional<ods::SteadyMerge> merges;         // --merge auto for frames and videos, after find_merges()
};

// Opens the input's header and plans the conversion. Prints notes. Throws UsageError and ods::Error.
ConvertJob open_conversion(const ConvertOptions& given);

// Reads the pixels of an input that is one picture. Throws UsageError and ods::Error.
void read_pixels(ConvertJob& job);

// Opens the depth beside frames and videos, if there is any. Throws UsageError and ods::Error.
void open_depth(ConvertJob& job);

// Returns the number of the first frame, whichever process converts it; nullopt for a video.
std::optional<int> first_of_all(const ConvertJob& job);

// Finds the merges of --merge auto for frames and videos. Throws UsageError and ods::Error.
void find_merges(ConvertJob& job);

// Called twice: on the header, to fail early, and on the pixels, because decoding may drop the depth layer that the
// header announced. Throws UsageError.
void refuse_impossible(const ConvertJob& job, const ods::StoredPicture& picture);

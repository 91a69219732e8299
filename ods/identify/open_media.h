// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Opens a picture or a video of unknown origin: its header, its format, how that was decided, and, if the pixels had to
// be examined for it, the pixels. ods/picture/metadata/format_source.h has the sources of the format in order of
// precedence. Every command opens its input here.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/identify/identify.h"
#include "ods/picture/stored_picture.h"
#include "ods/video/container/video_file.h"
#include "ods/video/decode.h"

namespace ods {

struct MediaOptions {
  FormatHint known{};            // the caller's settings
  std::optional<int> track{};    // of a video; if not set, the one with the largest picture
  bool left_first = false;       // the pixels do not decide the order of a picture's eyes: it is as players assume
  bool color_only = false;       // as in OpenOptions, for a picture
  std::string scratch_folder{};  // as in OpenOptions; if empty, temporary_folder_if_any()
};

struct MediaFile {
  std::string path;                  // of frames, the first one
  FormatHint hint;                   // MediaOptions::known, completed by the pixels where nothing else decides
  std::optional<Identity> identity;  // result of the pixels, if they had to be examined
  std::vector<std::string> notes;    // for users: what the pixels decided, and what is doubtful

  // Set for a picture. It may hold the decoded pixels.
  std::optional<PictureReader> reader;
  StereoFormat format;  // as find_format() returns it for `hint`

  // Set for a video.
  std::optional<VideoFile> video;
  VideoTrack track;             // if two tracks are joined, of the joined pictures
  Views views = Views::kFirst;  // for VideoDecoder
};

// Opens a picture, a pair (%V), frames (their first one stands for all) or a video. The pixels are examined only if
// options, metadata, sidecar and name leave the layout or the projection open, and decoded once: reader_of() has them.
// Their result is used if it is likely and the aspect ratio suggests nothing, or if it is sure or rules out what the
// aspect ratio suggests; for a video only if it is sure. Throws Error(kInput) like find_format(), read_video_file() and
// choose_track(), and for a file that cannot be read; a misfit of format and size is found by the next step.
MediaFile open_media(const std::string& path, const MediaOptions& options = {});

// The reason why the pictures of a video's track cannot be read, for messages: "'a.mp4': its pictures are interlaced;
// ...". Empty if they can. Only their description is read, no picture.
std::string reading_fault(const std::string& path, uint64_t track);

// Throws Error(kInput) if the pixels were needed, and none of their readings is likely.
void refuse_unlikely(const MediaFile& media);

// Throws Error(kInput) if the file is a video.
void expect_picture(const MediaFile& media);

// The reader of a picture with its format set; it decodes nothing again. Throws like PictureReader and
// expect_picture().
PictureReader reader_of(MediaFile media);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Frame numbers, and the file names of frames.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace ods {

// "1-100", "1-100x2" or "1-100:2" (every second), "1..10", "1,5,10-20", "-10-5", "10-1" and "10-1x-2" (backwards), and
// comma-separated lists of these, in brackets or not: "[1-10]". Spaces are ignored. Returns the frames in the order
// given, without duplicates, at most a million; numbers have at most nine digits. In some programs ':' staggers; here
// it is a step, as in Open Job Description. Throws Error(kUsage), naming the part that does not parse.
std::vector<int> parse_frames(const std::string& text);

// The shortest text for these frames: "1-7,9-19x2". Precondition: no duplicates.
std::string frames_text(const std::vector<int>& frames);

// The missing numbers between the first and the last: of 1 2 3 5, 4; of 1 3 5 9, 7. At most the first million.
// Precondition: ascending.
std::vector<int> gaps(const std::vector<int>& frames);

// The frame number's placeholder in a file name: ####, one mark per digit (# or @), %04d or %d, $F4 or $F,
// {frame}. If there are several, the last one counts. Marks in folder names are ignored, and %V is left alone.
struct FrameNames {
  std::string before, after;
  int digits = 1;  // minimum; padded with zeros

  std::string path(int frame) const;
};
// Returns nullopt if the name has no placeholder.
std::optional<FrameNames> frame_names(const std::string& path);

// The frames that exist as files, ascending. A file counts only if path() gives exactly its name. Throws Error(kInput):
// the folder cannot be read.
std::vector<int> frames_on_disk(const FrameNames& names);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames by their numbers, and the names of their files.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace ods {

// "1-100", "1-100x2" or "1-100:2" (every second), "1..10", "1,5,10-20", "-10-5", "10-1" and "10-1x-2" (backwards), and
// commas between any of these. Spaces do not matter. In the order given, every frame once, at most a million; numbers
// have at most nine digits. In some programs ':' staggers; here it is a step, as in Open Job Description.
// Throws Error(kUsage): which part of the text makes no sense.
std::vector<int> parse_frames(const std::string& text);

// The shortest such text: "1-7,9-19x2". Precondition: no frame twice.
std::string frames_text(const std::vector<int>& frames);

// The numbers that are missing between the first and the last: of 1 2 3 5, 4; of 1 3 5 9, 7. The
// first million of them. Precondition: rising.
std::vector<int> gaps(const std::vector<int>& frames);

// Where the number stands in a file name: ####, one mark for a digit (@ does, too), %04d or %d, $F4 or $F, {frame}. Of
// several the last one counts. Marks in the names of folders are no marks, and %V is left alone.
struct FrameNames {
  std::string before, after;
  int digits = 1;  // at least; missing ones are zeros

  std::string path(int frame) const;
};
// Nothing where the name has no such place.
std::optional<FrameNames> frame_names(const std::string& path);

// The frames of which there are files, rising. A file counts if path() gives its very name. Throws Error(kInput): the
// folder cannot be read.
std::vector<int> frames_on_disk(const FrameNames& names);

}  // namespace ods

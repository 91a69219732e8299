// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files beside a picture or a video for its viewers: notes and subtitles. docs/view.md describes the files.
#pragma once
#include <string>
#include <vector>

namespace ods {

struct Hotspot {
  float yaw = 0.0f, pitch = 0.0f;  // degrees, as the page shows them
  std::string title, text;
};

struct Notes {
  std::string caption;
  std::vector<Hotspot> hotspots;
};

// Reads PICTURE.notes.json beside PICTURE.jpg; empty if there is none. Throws Error(kInput) if it is not such JSON, or
// is too long.
Notes read_notes(const std::string& picture);

// Returns the text of VIDEO.vtt beside VIDEO.mp4 (WebVTT); empty if there is none. Throws Error(kInput) if it has
// another format, or is too long.
std::string read_subtitles(const std::string& video);

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What people put beside a picture or a video for its viewers: notes and subtitles. docs/view.md describes the files.
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

// Of PICTURE.notes.json beside PICTURE.jpg; empty without one. Throws Error(kInput): no such JSON, or too much of it.
Notes read_notes(const std::string& picture);

// The text of FILM.vtt beside FILM.mp4 (WebVTT); empty without one. Throws Error(kInput): another format, or too long.
std::string read_subtitles(const std::string& video);

}  // namespace ods

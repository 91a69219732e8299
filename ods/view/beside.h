// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files beside a picture or a video for its viewers: notes and subtitles. docs/view.md describes the files.
#pragma once
#include <string>
#include <vector>

#include "ods/base/json_reader.h"

namespace ods {

struct Hotspot {
  float yaw = 0.0f, pitch = 0.0f;  // degrees, as the page shows them
  float distance = 2.5f;           // metres, at which both eyes see it
  std::string title, text;
};

struct Notes {
  std::string caption;
  std::vector<Hotspot> hotspots;
};

// Reads PICTURE.notes.json beside PICTURE.jpg; empty if there is none. Throws Error(kInput) if it is not such JSON, or
// is too long.
Notes read_notes(const std::string& picture);

// Read the value of a key of such a file, also for tours. `file`, `noun` and `place` are the reader's. Throw
// Error(kInput) for a text of more bytes than `maximum`, for a missing text that is needed, and for too many hotspots.
std::string text_of(JsonReader& reader, const std::string& key, size_t maximum, bool is_needed);
std::vector<Hotspot> hotspots_of(JsonReader& reader, const std::string& file, const std::string& noun,
                                 const std::string& place, std::vector<std::string>& warnings);
inline constexpr size_t kMaxHotspotTitle = 100, kMaxHotspotText = 1000;  // bytes

// Returns the text of VIDEO.vtt beside VIDEO.mp4 (WebVTT); empty if there is none. Throws Error(kInput) if it has
// another format, or is too long.
std::string read_subtitles(const std::string& video);

}  // namespace ods

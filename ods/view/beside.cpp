// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/beside.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "ods/base/json_reader.h"
#include "ods/base/text.h"
#include "ods/files/read_file.h"

namespace ods {

namespace {

// Bytes, but of hotspots their number.
constexpr size_t kMaxNotes = 256 << 10;
constexpr size_t kMaxSubtitles = 2 << 20;
constexpr size_t kMaxHotspots = 200;
constexpr size_t kMaxCaption = 400;

// The file with another extension beside a file, and its contents; empty if there is none.
std::string text_beside(const std::string& path, const char* end, size_t maximum, std::string& name) {
  name = std::filesystem::path(path).replace_extension(end).native();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(name, ignored)) return "";
  return read_text(name, maximum);
}

}  // namespace

std::string text_of(JsonReader& reader, const std::string& key, size_t maximum, bool is_needed) {
  const Json* const found = reader.find(key);
  if (!found && !is_needed) return "";
  if (!found || !found->is_string() || found->get_ref<const std::string&>().size() > maximum) {
    reader.fail(key, fmt::format("must be text of at most {} bytes", maximum));
  }
  return found->get<std::string>();
}

std::vector<Hotspot> hotspots_of(JsonReader& reader, const std::string& file, const std::string& noun,
                                 const std::string& place, std::vector<std::string>& warnings) {
  const Json* const list = reader.find("hotspots");
  std::vector<Hotspot> hotspots;
  if (!list) return hotspots;
  if (!list->is_array() || list->size() > kMaxHotspots) {
    reader.fail("hotspots", fmt::format("must be a list of at most {}", kMaxHotspots));
  }
  for (const Json& each : *list) {
    JsonReader entry(each, file, noun, fmt::format("{}hotspots.{}", place, hotspots.size()), warnings);
    Hotspot& hotspot = hotspots.emplace_back();
    entry.number("yaw", hotspot.yaw, -360.0f, 360.0f);
    entry.number("pitch", hotspot.pitch, -90.0f, 90.0f);
    entry.number("distance", hotspot.distance, 0.5f, 1000.0f);
    hotspot.title = text_of(entry, "title", kMaxHotspotTitle, true);
    hotspot.text = text_of(entry, "text", kMaxHotspotText, false);
  }
  return hotspots;
}

Notes read_notes(const std::string& picture) {
  std::string name;
  const std::string text = text_beside(picture, ".notes.json", kMaxNotes, name);
  Notes notes;
  if (text.empty()) return notes;
  const Json json = parse_json(text, name, "notes");
  std::vector<std::string> warnings;
  JsonReader reader(json, name, "notes", "", warnings);
  notes.caption = text_of(reader, "caption", kMaxCaption, false);
  notes.hotspots = hotspots_of(reader, name, "notes", "", warnings);
  return notes;
}

std::string read_subtitles(const std::string& video) {
  std::string name;
  const std::string text = valid_utf8(text_beside(video, ".vtt", kMaxSubtitles, name));
  if (text.empty()) return "";
  const size_t at = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
  if (text.compare(at, 6, "WEBVTT") != 0) {
    throw cannot_read(name,
                      "it is not WebVTT, which begins with WEBVTT: ffmpeg -i subtitles.srt subtitles.vtt makes it");
  }
  return text;
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/tracks/kept_tags.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "ods/base/text.h"
#include "ods/video/container/user_data.h"
#include "ods/video/tracks/av.h"

extern "C" {
#include <libavformat/avformat.h>
}

namespace ods {

// Returns whether a tag applies only to the old file.
static bool is_of_old_file(std::string_view key, bool is_pictures) {
  const auto is = [&](std::string_view name) { return small_letters(std::string(key)) == name; };
  if (key.starts_with("_STATISTICS") || key.starts_with("BPS") || key.starts_with("NUMBER_OF_")) return true;
  if (is("major_brand") || is("minor_version") || is("compatible_brands") || is("duration")) return true;
  return is("encoder") || (is_pictures && is("vendor_id"));
}

// libavformat lists tags with a language twice: "title" and "title-eng".
static bool is_repeated(const AVDictionary* tags, const AVDictionaryEntry& entry) {
  const std::string key = entry.key;
  if (key.size() < 5 || key[key.size() - 4] != '-') return false;
  const AVDictionaryEntry* plain = av_dict_get(tags, key.substr(0, key.size() - 4).c_str(), nullptr, 0);
  return plain != nullptr && std::string_view(plain->value) == entry.value;
}

// The tags that apply to the new file, too.
static std::vector<const AVDictionaryEntry*> lasting_tags(const AVDictionary* tags, bool is_pictures) {
  std::vector<const AVDictionaryEntry*> lasting;
  const AVDictionaryEntry* entry = nullptr;
  while ((entry = av_dict_get(tags, "", entry, AV_DICT_IGNORE_SUFFIX)) != nullptr) {
    if (!is_of_old_file(entry->key, is_pictures) && !is_repeated(tags, *entry)) lasting.push_back(entry);
  }
  return lasting;
}

namespace av {

void copy_tags(const AVDictionary* from, AVDictionary** to, bool is_pictures) {
  for (const AVDictionaryEntry* entry : lasting_tags(from, is_pictures)) av_dict_set(to, entry->key, entry->value, 0);
}

void copy_chapters(const AVFormatContext& from, const TimeCut& cut, AVFormatContext& to) {
  if (from.nb_chapters == 0) return;
  auto** chapters = static_cast<AVChapter**>(av::made(av_calloc(from.nb_chapters, sizeof(AVChapter*))));
  to.chapters = chapters;
  for (unsigned i = 0; i < from.nb_chapters; i++) {
    const AVChapter& old = *from.chapters[i];
    const double unit = av_q2d(old.time_base);
    const auto ticks = [&](double seconds) { return std::llround(seconds / unit); };
    const int64_t zero = ticks(cut.start);
    int64_t start = old.start - zero, end = old.end - zero;
    if (cut.is_cut && (end <= 0 || static_cast<double>(start) * unit >= cut.length)) continue;
    start = std::max<int64_t>(start, 0);
    if (cut.is_cut && std::isfinite(cut.length)) end = std::min<int64_t>(end, ticks(cut.length));
    AVChapter* chapter = static_cast<AVChapter*>(av::made(av_mallocz(sizeof(AVChapter))));
    chapter->id = old.id, chapter->time_base = old.time_base;
    chapter->start = start, chapter->end = std::max(end, start);
    av_dict_copy(&chapter->metadata, old.metadata, 0);
    chapters[to.nb_chapters++] = chapter;
  }
}

}  // namespace av

// --- lost tags ----------------------------------------------------------------------------------------------------

static bool has_tag(const AVDictionary* tags, const AVDictionaryEntry& wanted) {
  return av_dict_get(tags, wanted.key, nullptr, 0) != nullptr;
}

// Lost tags of the file. A timecode has become a tag of the pictures.
static void find_lost(const AVFormatContext& old, const AVFormatContext& made_file, std::vector<std::string>& lost) {
  for (const AVDictionaryEntry* entry : lasting_tags(old.metadata, false)) {
    bool is_there = has_tag(made_file.metadata, *entry);
    for (unsigned i = 0; i < made_file.nb_streams; i++) {
      const bool is_timecode = small_letters(entry->key) == "timecode";
      is_there = is_there || (is_timecode && has_tag(made_file.streams[i]->metadata, *entry));
    }
    if (!is_there) lost.push_back(fmt::format("tag {} ({})", one_line(entry->key), one_line(entry->value)));
  }
}

// Lost tags of the streams: those in none of the new file's streams. The names that programs give to their handlers do
// not count.
static void find_lost_of_streams(const AVFormatContext& old, const AVFormatContext& made_file,
                                 std::vector<std::string>& lost) {
  std::set<std::string> values;
  for (unsigned i = 0; i < made_file.nb_streams; i++) {
    for (const AVDictionaryEntry* entry : lasting_tags(made_file.streams[i]->metadata, true)) {
      values.insert(entry->value);
    }
  }
  const std::set<std::string> kNames = {"handler_name", "vendor_id", "language", "creation_time",
                                        "timecode",     "filename",  "mimetype", "reel_name"};
  for (unsigned i = 0; i < old.nb_streams; i++) {
    for (const AVDictionaryEntry* entry : lasting_tags(old.streams[i]->metadata, true)) {
      if (kNames.contains(small_letters(entry->key)) || values.contains(entry->value)) continue;
      lost.push_back(fmt::format("tag {} ({}) of stream {}", one_line(entry->key), one_line(entry->value), i));
    }
  }
}

// Lost user data of an mp4 or mov: boxes unknown to libavformat, which cannot become tags.
static void find_lost_boxes(const KeepOptions& keep, std::vector<std::string>& lost) {
  const std::set<BoxType> kKnown = {box_type("meta"), box_type("loci"), box_type("name"), box_type("titl"),
                                    box_type("auth"), box_type("cprt"), box_type("yrrc"), box_type("perf")};
  const UserData data = read_user_data(keep.path, keep.track);
  const auto look = [&](const std::vector<Box>& boxes) {
    for (const Box& box : boxes) {
      const bool is_text = box.type >> 24 == 0xa9;
      if (!is_text && !kKnown.contains(box.type))
        lost.push_back(fmt::format("box {} of the header", type_text(box.type)));
    }
  };
  for (const std::vector<Box>* boxes : {&data.movie, &data.pictures, &data.file}) {
    for (const Box& box : *boxes) look(box.type == box_type("udta") ? box.children : std::vector<Box>{box});
  }
}

std::vector<std::string> lost_tags(const KeepOptions& keep, const std::string& made_path) {
  std::vector<std::string> lost;
  if (keep.path.empty()) return lost;
  const av::Owned<AVFormatContext> old = av::open_file(keep.path, fmt::format("cannot read '{}'", keep.path));
  const av::Owned<AVFormatContext> made_file = av::open_file(made_path, fmt::format("cannot read '{}'", made_path));
  find_lost(*old, *made_file, lost);
  find_lost_of_streams(*old, *made_file, lost);
  if (!has_user_data(made_path)) find_lost_boxes(keep, lost);
  return lost;
}

}  // namespace ods

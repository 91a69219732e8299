// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/matroska_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "ods/video/container/film_form.h"
#include "ods/video/container/matroska_form.h"

namespace ods {

using namespace matroska;

// --- reading ---------------------------------------------------------------------------------------------------------

namespace {

struct Matroska {
  Element head;  // the EBML element
  FileElement head_place, segment;
  std::vector<FileElement> parts;    // of the segment
  std::map<size_t, Element> opened;  // those of them that may change
};

}  // namespace

bool is_matroska(std::string_view first_bytes) {
  return first_bytes.size() >= 4 && get_number(first_bytes, 0, 4) == kEbml;
}

static void open_all(Element& element, const std::vector<uint32_t>& path, size_t depth = 0) {
  open_element(element);
  if (depth == path.size()) return;
  for (Element& child : element.children) {
    if (child.id == path[depth]) open_all(child, path, depth + 1);
  }
}

static void open_part(Element& part) {
  if (part.id == kSeekHead) open_all(part, {kSeek});
  if (part.id == kTracks) open_all(part, {kTrackEntry, kVideo});
  if (part.id == kCues) open_all(part, {kCuePoint, kCueTrackPositions});
  if (part.id == kTags) {
    open_all(part, {kTag, kSimpleTag});
    for (Element& tag : part.children) {
      if (Element* targets = tag.id == kTag ? find_child(tag, kTargets) : nullptr) open_element(*targets);
    }
  }
}

static Matroska open_matroska(const FileInput& file) {
  constexpr size_t kMost = 1000000;
  Matroska film;
  film.head_place = scan_element(file, 0, file.size());
  film.head = read_element(file, film.head_place);
  open_element(film.head);
  uint64_t at = film.head_place.end();
  while (at < file.size() && film.segment.id != kSegment) {
    film.segment = scan_element(file, at, file.size());
    at = film.segment.end();
  }
  if (film.segment.id != kSegment) throw Broken("there is no film in it");
  for (at = film.segment.body(); at < film.segment.end();) {
    film.parts.push_back(scan_element(file, at, film.segment.end()));
    const FileElement& part = film.parts.back();
    // Where such a one ends is only known by what is in it.
    if (part.is_endless) throw Broken("it is a live recording; mkvmerge makes a film of it");
    at = part.end();
    if (film.parts.size() > kMost) throw Broken("it consists of more than a million parts");
    if (part.id != kSeekHead && part.id != kTracks && part.id != kCues && part.id != kTags) continue;
    Element& opened = film.opened[film.parts.size() - 1] = read_element(file, part);
    open_part(opened);
  }
  return film;
}

static bool is_about(const Element& tag, const Element& track) {
  const Element* targets = tag.id == kTag ? find_child(tag, kTargets) : nullptr;
  return targets != nullptr && child_number(*targets, kTagTrackUid) == child_number(track, kTrackUid);
}

static std::optional<FilmForm> v1_of(const Matroska& film, const Element& track) {
  for (const auto& [index, part] : film.opened) {
    for (const Element& tag : part.children) {
      if (part.id != kTags || !is_about(tag, track)) continue;
      for (const Element& simple : tag.children) {
        if (is_v1_tag(simple)) return parse_v1(child_text(simple, kTagString));
      }
    }
  }
  return std::nullopt;
}

static VideoTrack read_track(const Matroska& film, const Element& entry) {
  VideoTrack track;
  track.id = child_number(entry, kTrackNumber);
  track.codec = child_text(entry, kCodecId);
  if (const Element* video = find_child(entry, kVideo)) {
    const auto side = [&](uint32_t id) {
      return static_cast<int>(std::min<uint64_t>(child_number(*video, id), 1 << 20));
    };
    track.size = {side(kPixelWidth), side(kPixelHeight)};
    track.v2 = parse_video(*video);
  }
  const uint64_t duration = child_number(entry, kDefaultDuration);  // nanoseconds
  track.fps = duration == 0 ? 0.0 : 1e9 / static_cast<double>(duration);
  track.v1 = v1_of(film, entry);
  return track;
}

FilmInfo read_matroska(const FileInput& file) {
  const Matroska film = open_matroska(file);
  FilmInfo info;
  info.container = child_text(film.head, kDocType) == "webm" ? Container::kWebm : Container::kMatroska;
  for (const auto& [index, part] : film.opened) {
    for (const Element& entry : part.children) {
      if (part.id != kTracks || entry.id != kTrackEntry) continue;
      const uint64_t type = child_number(entry, kTrackType);
      if (type == 1) info.video.push_back(read_track(film, entry));
      if (type == 2) info.sound.push_back({child_number(entry, kTrackNumber), child_text(entry, kCodecId), 0, {}});
    }
  }
  return info;
}

// --- writing ---------------------------------------------------------------------------------------------------------

static void tag_tracks(Matroska& film, uint64_t number, const std::optional<FilmForm>& form) {
  const Element* tagged = nullptr;
  for (auto& [index, part] : film.opened) {
    for (Element& entry : part.children) {
      if (part.id != kTracks || entry.id != kTrackEntry || child_number(entry, kTrackNumber) != number) continue;
      Element* video = find_child(entry, kVideo);
      if (video == nullptr) continue;
      if (form && !can_say(Container::kMatroska, read_track(film, entry), *form)) {
        throw Broken(fmt::format("mkv and webm have no words for {}", form_text(*form)));
      }
      tag_video(*video, form);
      tagged = &entry;
    }
  }
  if (tagged == nullptr) throw Broken("its video track does not say what its pictures are like");
  for (auto& [index, part] : film.opened) {
    for (Element& tag : part.children) {
      if (part.id == kTags && is_about(tag, *tagged)) tag_v1(tag, form);
    }
    if (part.id != kTags) continue;
    std::erase_if(part.children, [](const Element& e) { return e.id == kTag && find_child(e, kSimpleTag) == nullptr; });
  }
}

// Projection came with version 4.
static void raise_version(Element& head, const std::optional<FilmForm>& form) {
  Element* version = find_child(head, kDocTypeVersion);
  if (form && version != nullptr && number_of(*version) < 4) set_number(*version, 4);
}

namespace {

// Where every part of the segment comes to lie, counted from the segment's first byte behind its size.
struct Places {
  std::vector<uint64_t> offsets;
  std::vector<uint64_t> sizes;
  uint64_t end = 0;
};

}  // namespace

static Places place_parts(const Matroska& film, const std::map<size_t, Element>& parts) {
  Places places;
  int64_t growth = 0;  // of what is in memory
  for (size_t i = 0; i < film.parts.size(); i++) {
    const auto part = parts.find(i);
    places.sizes.push_back(part == parts.end() ? film.parts[i].size : element_size(part->second));
    growth += static_cast<int64_t>(places.sizes[i]) - static_cast<int64_t>(film.parts[i].size);
    if (film.parts[i].id == kCluster) break;
  }
  for (size_t i = 0; i < places.sizes.size(); i++) {  // the first Void that can give or take as much
    const int64_t left = static_cast<int64_t>(places.sizes[i]) - growth;
    if (growth == 0 || film.parts[i].id != kVoid || (left != 0 && left < 2)) continue;
    places.sizes[i] = static_cast<uint64_t>(left);
    growth = 0;
  }
  for (size_t i = places.sizes.size(); i < film.parts.size(); i++) {
    const auto part = parts.find(i);
    places.sizes.push_back(part == parts.end() ? film.parts[i].size : element_size(part->second));
  }
  for (uint64_t size : places.sizes) {
    places.offsets.push_back(places.end);
    places.end += size;
  }
  return places;
}

// Where the part that starts at this place of the old segment starts in the new one.
static uint64_t moved(const Matroska& film, const Places& places, uint64_t position) {
  const uint64_t offset = film.segment.body() + position;
  const auto after = std::upper_bound(film.parts.begin(), film.parts.end(), offset,
                                      [](uint64_t at, const FileElement& part) { return at < part.offset; });
  if (after == film.parts.begin()) return position;
  const size_t i = static_cast<size_t>(after - film.parts.begin()) - 1;
  return places.offsets[i] + (offset - film.parts[i].offset);
}

static void move_positions(Element& element, const Matroska& film, const Places& places) {
  for (Element& child : element.children) {
    const bool is_position = child.id == kSeekPosition || child.id == kCueClusterPosition ||
                             (child.id == kCueCodecState && number_of(child) != 0);
    if (is_position) set_number(child, moved(film, places, number_of(child)));
    move_positions(child, film, places);
  }
}

// Positions may need more bytes than before, and then all moves again.
static std::map<size_t, Element> move_parts(const Matroska& film, Places& places) {
  places = place_parts(film, film.opened);
  constexpr int kRounds = 16;  // a handful of widths, each of which grows once
  for (int i = 0; i < kRounds; i++) {
    std::map<size_t, Element> parts = film.opened;
    for (auto& [index, part] : parts) {
      if (part.id == kSeekHead || part.id == kCues) move_positions(part, film, places);
      update_crc(part);
    }
    const Places again = place_parts(film, parts);
    if (again.sizes == places.sizes) return parts;
    places = again;
  }
  throw Broken("its index does not settle");
}

// It stands before the first block.
static bool says_position(const FileInput& file, const FileElement& cluster) {
  constexpr int kBefore = 6;
  uint64_t at = cluster.body();
  for (int i = 0; i < kBefore && at < cluster.end(); i++) {
    const FileElement child = scan_element(file, at, cluster.end());
    if (child.id == kClusterPosition) return true;
    at = child.end();
  }
  return false;
}

// A cluster may say where it lies. It keeps its length: a place that is too small says nothing from then on.
static void write_moved_cluster(const FileInput& file, const FileElement& place, uint64_t position, AtomicFile& to) {
  Element cluster = read_element(file, place);
  open_element(cluster);
  Element& said = *find_child(cluster, kClusterPosition);
  const size_t width = said.body.size();
  set_number(said, position);
  if (said.body.size() != width) {
    said.id = kVoid;
    said.body.assign(width, '\0');
  }
  update_crc(cluster);
  std::string bytes;
  write_element(cluster, bytes);
  append(to, bytes);
}

static std::string void_bytes(uint64_t size) {
  if (size == 0) return {};
  std::string bytes(1, static_cast<char>(kVoid));
  const size_t width = size < 128 ? 1 : 8;
  append_size(bytes, size - 1 - width, width);
  bytes.resize(size);
  return bytes;
}

static void write_segment_header(const FileInput& file, const Matroska& film, uint64_t size, AtomicFile& to) {
  std::string bytes;
  write_element(film.head, bytes);
  append(to, bytes);
  file.copy(film.head_place.end(), film.segment.offset - film.head_place.end(), to);
  bytes = file.read(film.segment.offset, film.segment.header);
  if (!film.segment.is_endless) {
    bytes.resize(film.segment.header - film.segment.size_width);
    append_size(bytes, size, film.segment.size_width);
  }
  append(to, bytes);
}

TagResult tag_matroska(const FileInput& file, AtomicFile& to, uint64_t track, const std::optional<FilmForm>& form) {
  Matroska film = open_matroska(file);
  tag_tracks(film, track, form);
  raise_version(film.head, form);
  update_crc(film.head);
  Places places;
  const std::map<size_t, Element> parts = move_parts(film, places);
  write_segment_header(file, film, places.end, to);
  TagResult result;
  result.has_v2 = form.has_value();
  for (size_t i = 0; i < film.parts.size(); i++) {
    const FileElement& part = film.parts[i];
    const bool is_moved = part.id == kCluster && places.offsets[i] != part.offset - film.segment.body();
    result.moved = result.moved || is_moved;
    std::string bytes;
    if (parts.contains(i)) {
      write_element(parts.at(i), bytes);
      append(to, bytes);
    } else if (part.id == kVoid && places.sizes[i] != part.size) {
      append(to, void_bytes(places.sizes[i]));
    } else if (is_moved && says_position(file, part)) {
      write_moved_cluster(file, part, places.offsets[i], to);
    } else {
      file.copy(part.offset, part.size, to);
    }
  }
  file.copy(film.segment.end(), file.size() - film.segment.end(), to);
  return result;
}

}  // namespace ods

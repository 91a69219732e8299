// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/matroska_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "ods/video/container/complete_metadata.h"
#include "ods/video/container/matroska_metadata.h"

namespace ods {

using namespace matroska;

constexpr uint64_t kTypeVideo = 1, kTypeAudio = 2;  // TrackType

// --- reading ---------------------------------------------------------------------------------------------------------

namespace {

struct Matroska {
  Element head;  // the EBML element
  FileElement head_place, segment;
  std::vector<FileElement> parts;    // parts of the segment
  std::map<size_t, Element> opened;  // the parts that may change
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
  if (part.id == kTracks) {
    open_all(part, {kTrackEntry, kVideo});
    for (Element& entry : part.children) {
      Element* operation = entry.id == kTrackEntry ? find_child(entry, kTrackOperation) : nullptr;
      if (operation != nullptr) open_all(*operation, {kTrackCombinePlanes, kTrackPlane});
    }
  }
  if (part.id == kCues) open_all(part, {kCuePoint, kCueTrackPositions});
  if (part.id == kTags) {
    open_all(part, {kTag, kSimpleTag});
    for (Element& tag : part.children) {
      if (Element* targets = tag.id == kTag ? find_child(tag, kTargets) : nullptr) open_element(*targets);
    }
  }
}

static Matroska open_matroska(const FileInput& file) {
  constexpr size_t kMax = 1000000;
  Matroska video;
  video.head_place = scan_element(file, 0, file.size());
  video.head = read_element(file, video.head_place);
  open_element(video.head);
  uint64_t at = video.head_place.end();
  while (at < file.size() && video.segment.id != kSegment) {
    video.segment = scan_element(file, at, file.size());
    at = video.segment.end();
  }
  if (video.segment.id != kSegment) throw MalformedFile("there is no video in it");
  for (at = video.segment.body(); at < video.segment.end();) {
    video.parts.push_back(scan_element(file, at, video.segment.end()));
    const FileElement& part = video.parts.back();
    // The end of such a part is only known from its contents.
    if (part.is_endless) throw MalformedFile("it is a live recording; remux it with mkvmerge first");
    at = part.end();
    if (video.parts.size() > kMax) throw MalformedFile("it contains more than a million elements");
    if (part.id != kSeekHead && part.id != kTracks && part.id != kCues && part.id != kTags) continue;
    Element& opened = video.opened[video.parts.size() - 1] = read_element(file, part);
    open_part(opened);
  }
  return video;
}

static bool is_about(const Element& tag, const Element& track) {
  const Element* targets = tag.id == kTag ? find_child(tag, kTargets) : nullptr;
  return targets != nullptr && child_number(*targets, kTagTrackUid) == child_number(track, kTrackUid);
}

static std::optional<SphericalMetadata> v1_of(const Matroska& video, const Element& track) {
  for (const auto& [index, part] : video.opened) {
    for (const Element& tag : part.children) {
      if (part.id != kTags || !is_about(tag, track)) continue;
      for (const Element& simple : tag.children) {
        if (is_v1_tag(simple)) return parse_v1(child_text(simple, kTagString));
      }
    }
  }
  return std::nullopt;
}

// Returns whether an entry is a track of this type.
static bool is_track_of_type(const Element& part, const Element& entry, uint64_t type) {
  return part.id == kTracks && entry.id == kTrackEntry && child_number(entry, kTrackType) == type;
}

static VideoTrack read_track(const Matroska& video, const Element& entry) {
  VideoTrack track;
  track.id = child_number(entry, kTrackNumber);
  track.name = child_text(entry, kName);
  track.codec = child_text(entry, kCodecId);
  if (const Element* pictures = find_child(entry, kVideo)) {
    const auto side = [&](uint32_t id) {
      return static_cast<int>(std::min<uint64_t>(child_number(*pictures, id), 1 << 20));
    };
    track.size = {side(kPixelWidth), side(kPixelHeight)};
    track.v2 = parse_video(*pictures);
    track.pixel_aspect = pixel_aspect_of(*pictures);
    track.mesh = find_mesh(*pictures);
  }
  const uint64_t duration = child_number(entry, kDefaultDuration);  // nanoseconds
  track.fps = duration == 0 ? 0.0 : 1e9 / static_cast<double>(duration);
  track.v1 = v1_of(video, entry);
  return track;
}

// Calls `use(entry)` for the entries of all tracks of this type.
template <typename Use>
static void for_each_track(const Matroska& video, uint64_t type, const Use& use) {
  for (const auto& [index, part] : video.opened) {
    for (const Element& entry : part.children) {
      if (is_track_of_type(part, entry, type)) use(entry);
    }
  }
}

// A track that combines others has no pictures of its own.
static bool is_combined(const Element& entry) {
  return find_child(entry, kTrackOperation) != nullptr;
}

// The eye of a track that is a plane of a combined one; TrackPlaneType 0 is the left eye, 1 the right one.
static std::optional<int> eye_in_planes(const Matroska& video, const Element& track) {
  std::optional<int> eye;
  for_each_track(video, kTypeVideo, [&](const Element& entry) {
    const Element* operation = find_child(entry, kTrackOperation);
    const Element* planes = operation == nullptr ? nullptr : find_child(*operation, kTrackCombinePlanes);
    if (planes == nullptr) return;
    for (const Element& plane : planes->children) {
      if (plane.id != kTrackPlane || child_number(plane, kTrackPlaneUid) != child_number(track, kTrackUid)) continue;
      const uint64_t type = child_number(plane, kTrackPlaneType);
      if (type <= 1) eye = type == 0 ? kLeft : kRight;
    }
  });
  return eye;
}

VideoFile read_matroska(const FileInput& file) {
  const Matroska video = open_matroska(file);
  VideoFile info;
  info.container = child_text(video.head, kDocType) == "webm" ? Container::kWebm : Container::kMatroska;
  for_each_track(video, kTypeVideo, [&](const Element& entry) {
    if (is_combined(entry)) return;
    VideoTrack& track = info.tracks.emplace_back(read_track(video, entry));
    track.eye = eye_in_planes(video, entry);
  });
  for_each_track(video, kTypeAudio, [&](const Element& entry) {
    info.sound.push_back({child_number(entry, kTrackNumber), child_text(entry, kCodecId), 0, {}});
  });
  return info;
}

// --- writing ---------------------------------------------------------------------------------------------------------

static void tag_tracks(Matroska& video, uint64_t number, const std::optional<SphericalMetadata>& metadata) {
  const Element* tagged = nullptr;
  for (auto& [index, part] : video.opened) {
    for (Element& entry : part.children) {
      if (!is_track_of_type(part, entry, kTypeVideo) || child_number(entry, kTrackNumber) != number) continue;
      Element* pictures = find_child(entry, kVideo);
      if (pictures == nullptr) throw MalformedFile("its video track has no description of its pictures");
      if (metadata && !can_express(Container::kMatroska, read_track(video, entry), *metadata)) {
        throw MalformedFile(fmt::format("mkv and webm cannot express {}", metadata_text(*metadata)));
      }
      tag_video(*pictures, metadata);
      tagged = &entry;
    }
  }
  if (tagged == nullptr) throw MalformedFile(fmt::format("it has no video track {}", number));
  for (auto& [index, part] : video.opened) {
    for (Element& tag : part.children) {
      if (part.id == kTags && is_about(tag, *tagged)) tag_v1(tag, metadata);
    }
    if (part.id != kTags) continue;
    std::erase_if(part.children, [](const Element& e) { return e.id == kTag && find_child(e, kSimpleTag) == nullptr; });
  }
}

// Projection was introduced with version 4.
static void raise_version(Element& head, const std::optional<SphericalMetadata>& metadata) {
  Element* version = find_child(head, kDocTypeVersion);
  if (metadata && version != nullptr && number_of(*version) < 4) set_number(*version, 4);
}

namespace {

// The new position of each part, relative to the start of the segment's data.
struct Places {
  std::vector<uint64_t> offsets;
  std::vector<uint64_t> sizes;
  uint64_t end = 0;
};

}  // namespace

static Places place_parts(const Matroska& video, const std::map<size_t, Element>& parts) {
  Places places;
  int64_t growth = 0;  // growth of the parts in memory
  for (size_t i = 0; i < video.parts.size(); i++) {
    const auto part = parts.find(i);
    places.sizes.push_back(part == parts.end() ? video.parts[i].size : element_size(part->second));
    growth += static_cast<int64_t>(places.sizes[i]) - static_cast<int64_t>(video.parts[i].size);
    if (video.parts[i].id == kCluster) break;
  }
  for (size_t i = 0; i < places.sizes.size(); i++) {  // the first Void that can absorb the growth
    const int64_t left = static_cast<int64_t>(places.sizes[i]) - growth;
    if (growth == 0 || video.parts[i].id != kVoid || (left != 0 && left < 2)) continue;
    places.sizes[i] = static_cast<uint64_t>(left);
    growth = 0;
  }
  for (size_t i = places.sizes.size(); i < video.parts.size(); i++) {
    const auto part = parts.find(i);
    places.sizes.push_back(part == parts.end() ? video.parts[i].size : element_size(part->second));
  }
  for (uint64_t size : places.sizes) {
    places.offsets.push_back(places.end);
    places.end += size;
  }
  return places;
}

// The new position of the part that was at this old position.
static uint64_t moved(const Matroska& video, const Places& places, uint64_t position) {
  const uint64_t offset = video.segment.body() + position;
  const auto after = std::upper_bound(video.parts.begin(), video.parts.end(), offset,
                                      [](uint64_t at, const FileElement& part) { return at < part.offset; });
  if (after == video.parts.begin()) return position;
  const size_t i = static_cast<size_t>(after - video.parts.begin()) - 1;
  return places.offsets[i] + (offset - video.parts[i].offset);
}

static void move_positions(Element& element, const Matroska& video, const Places& places) {
  for (Element& child : element.children) {
    const bool is_position = child.id == kSeekPosition || child.id == kCueClusterPosition ||
                             (child.id == kCueCodecState && number_of(child) != 0);
    if (is_position) set_number(child, moved(video, places, number_of(child)));
    move_positions(child, video, places);
  }
}

// Positions may need more bytes than before, which moves everything again.
static std::map<size_t, Element> move_parts(const Matroska& video, Places& places) {
  places = place_parts(video, video.opened);
  constexpr int kRounds = 16;  // each field can widen only a few times
  for (int i = 0; i < kRounds; i++) {
    std::map<size_t, Element> parts = video.opened;
    for (auto& [index, part] : parts) {
      if (part.id == kSeekHead || part.id == kCues) move_positions(part, video, places);
      update_crc(part);
    }
    const Places again = place_parts(video, parts);
    if (again.sizes == places.sizes) return parts;
    places = again;
  }
  throw MalformedFile("its index cannot be updated");
}

// The position comes before the first block.
static bool records_position(const FileInput& file, const FileElement& cluster) {
  constexpr int kBefore = 6;
  uint64_t at = cluster.body();
  for (int i = 0; i < kBefore && at < cluster.end(); i++) {
    const FileElement child = scan_element(file, at, cluster.end());
    if (child.id == kClusterPosition) return true;
    at = child.end();
  }
  return false;
}

// A cluster may store its own position. Its length stays the same: if the new position does not fit, it is voided.
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

static void write_segment_header(const FileInput& file, const Matroska& video, uint64_t size, AtomicFile& to) {
  std::string bytes;
  write_element(video.head, bytes);
  append(to, bytes);
  file.copy(video.head_place.end(), video.segment.offset - video.head_place.end(), to);
  bytes = file.read(video.segment.offset, video.segment.header);
  if (!video.segment.is_endless) {
    bytes.resize(video.segment.header - video.segment.size_width);
    append_size(bytes, size, video.segment.size_width);
  }
  append(to, bytes);
}

TagResult tag_matroska(const FileInput& file, AtomicFile& to, uint64_t track,
                       const std::optional<SphericalMetadata>& metadata) {
  Matroska video = open_matroska(file);
  tag_tracks(video, track, metadata);
  raise_version(video.head, metadata);
  update_crc(video.head);
  Places places;
  const std::map<size_t, Element> parts = move_parts(video, places);
  write_segment_header(file, video, places.end, to);
  TagResult result;
  result.has_v2 = metadata.has_value();
  for (size_t i = 0; i < video.parts.size(); i++) {
    const FileElement& part = video.parts[i];
    const bool is_moved = part.id == kCluster && places.offsets[i] != part.offset - video.segment.body();
    result.moved = result.moved || is_moved;
    std::string bytes;
    if (parts.contains(i)) {
      write_element(parts.at(i), bytes);
      append(to, bytes);
    } else if (part.id == kVoid && places.sizes[i] != part.size) {
      append(to, void_bytes(places.sizes[i]));
    } else if (is_moved && records_position(file, part)) {
      write_moved_cluster(file, part, places.offsets[i], to);
    } else {
      file.copy(part.offset, part.size, to);
    }
  }
  file.copy(video.segment.end(), file.size() - video.segment.end(), to);
  return result;
}

}  // namespace ods

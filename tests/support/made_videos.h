// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Tiny videos for tests: a correct header, and samples that are words, so that tests that follow the header's offsets
// can check their targets. Written and read without the library's own code.
#pragma once
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace ods::made {

inline std::string number(uint64_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; i--) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

inline uint64_t value(const std::string& bytes, size_t at, int count) {
  uint64_t result = 0;
  for (int i = 0; i < count; i++)
    result = result << 8 | static_cast<unsigned char>(bytes.at(at + static_cast<size_t>(i)));
  return result;
}

inline std::string box(const std::string& type, const std::string& body, bool large = false) {
  if (large) return number(1, 4) + type + number(body.size() + 16, 8) + body;
  return number(body.size() + 8, 4) + type + body;
}

// --- mp4 -------------------------------------------------------------------------------------------------------------

constexpr size_t kWord = 16;  // bytes of a chunk's word

inline std::string word(int track, int chunk) {
  std::string text = "track " + std::to_string(track) + " no " + std::to_string(chunk);
  text.resize(kWord, '.');
  return text;
}

struct Mp4Options {
  bool header_first = true;
  bool wide_offsets = false;  // co64
  bool large_data = false;    // mdat has a 64 bit size
  bool endless_data = false;  // mdat's size is 0: it extends to the end
  size_t free = 0;            // bytes of a box after the header
  std::string brand = "isom";
  std::string entry_boxes;          // in the sample entry, after avcC
  std::string track_boxes;          // at the end of the first track
  std::string table_boxes;          // at the end of its tables
  std::vector<int> widths = {256};  // widths of the video tracks
  int height = 0;                   // height of the tracks; 0 for square ones
  std::string sound_boxes;          // in the sample entry of a last track, of four channels; empty for no such track
  int chunks = 3;
  size_t padding = 0;  // bytes of each chunk after its word
};

inline std::string sample_entry(int width, int height, const std::string& boxes) {
  std::string entry(6, '\0');
  entry += number(1, 2) + std::string(16, '\0') + number(static_cast<uint64_t>(width), 2) +
           number(static_cast<uint64_t>(height), 2) + std::string(50, '\0');
  return box("avc1", entry + box("avcC", "config") + boxes + box("pasp", number(1, 4) + number(1, 4)));
}

inline std::string offsets_box(const Mp4Options& options, const std::vector<uint64_t>& offsets) {
  std::string body = number(0, 4) + number(offsets.size(), 4);
  for (uint64_t offset : offsets) body += number(offset, options.wide_offsets ? 8 : 4);
  return box(options.wide_offsets ? "co64" : "stco", body);
}

inline std::string track(const Mp4Options& options, int id, const std::vector<uint64_t>& offsets) {
  const int width = options.widths.at(static_cast<size_t>(id - 1));
  const int height = options.height == 0 ? width : options.height;
  const std::string none(4, '\0');
  const std::string table =
      box("stsd", none + number(1, 4) + sample_entry(width, height, id == 1 ? options.entry_boxes : "")) +
      box("stts", none + number(1, 4) + number(offsets.size(), 4) + number(40, 4)) + offsets_box(options, offsets) +
      (id == 1 ? options.table_boxes : "");
  const std::string self = box("dinf", box("dref", none + number(1, 4) + box("url ", number(1, 4))));
  const std::string media = box("mdhd", none + std::string(8, '\0') + number(1000, 4) + number(120, 4) + none) +
                            box("hdlr", none + none + "vide" + std::string(13, '\0')) +
                            box("minf", self + box("stbl", table));
  return box("trak",
             box("tkhd", none + std::string(8, '\0') + number(static_cast<uint64_t>(id), 4) + std::string(68, '\0')) +
                 box("mdia", media) + (id == 1 ? options.track_boxes : ""));
}

// A track of four channels without samples.
inline std::string sound_track(int id, const std::string& boxes) {
  const std::string none(4, '\0');
  const std::string entry = std::string(6, '\0') + number(1, 2) + none + none + number(4, 2) + number(16, 2) + none +
                            number(48000u << 16u, 4) + boxes;
  const std::string table = box("stsd", none + number(1, 4) + box("twos", entry)) + box("stco", none + none);
  const std::string media = box("mdhd", none + std::string(8, '\0') + number(48000, 4) + none + none) +
                            box("hdlr", none + none + "soun" + std::string(13, '\0')) + box("minf", box("stbl", table));
  const std::string head = none + std::string(8, '\0') + number(static_cast<uint64_t>(id), 4) + std::string(68, '\0');
  return box("trak", box("tkhd", head) + box("mdia", media));
}

inline std::string mp4(const Mp4Options& options) {
  const std::string type = box("ftyp", options.brand + number(512, 4) + options.brand);
  const std::string free = options.free == 0 ? "" : box("free", std::string(options.free - 8, 'f'));
  std::string data;
  for (int chunk = 0; chunk < options.chunks; chunk++) {
    for (size_t i = 0; i < options.widths.size(); i++) {
      data += word(static_cast<int>(i) + 1, chunk) + std::string(options.padding, static_cast<char>('a' + chunk % 26));
    }
  }
  const auto header = [&](uint64_t first) {
    std::string tracks = box("mvhd", std::string(100, '\0'));
    for (size_t i = 0; i < options.widths.size(); i++) {
      std::vector<uint64_t> offsets;
      for (int chunk = 0; chunk < options.chunks; chunk++) {
        offsets.push_back(first + (static_cast<size_t>(chunk) * options.widths.size() + i) * (kWord + options.padding));
      }
      tracks += track(options, static_cast<int>(i) + 1, offsets);
    }
    const int last = static_cast<int>(options.widths.size()) + 1;
    if (!options.sound_boxes.empty()) tracks += sound_track(last, options.sound_boxes);
    return box("moov", tracks);
  };
  std::string video_data = box("mdat", data, options.large_data);
  if (options.endless_data) video_data.replace(0, 4, number(0, 4));
  const uint64_t data_header = options.large_data ? 16 : 8;
  if (!options.header_first) return type + video_data + header(type.size() + data_header) + free;
  return type + header(type.size() + header(0).size() + free.size() + data_header) + free + video_data;
}

// Two fragments after an index, and a table for seeking after them. Offsets count from the file's first byte (absolute)
// or from the fragment.
inline std::string fragmented_mp4(bool absolute) {
  Mp4Options options;
  options.chunks = 0;
  std::string video = mp4(options);
  video.resize(video.size() - 8);  // without mdat
  const auto fragment = [&](int chunk, uint64_t at) {
    const auto moof = [&](uint64_t data) {
      const std::string head =
          absolute ? number(1, 4) + number(1, 4) + number(at, 8) : number(0x020000, 4) + number(1, 4);
      return box("moof",
                 box("mfhd", number(0, 8)) +
                     box("traf", box("tfhd", head) + box("trun", number(1, 4) + number(1, 4) + number(data, 4))));
    };
    return moof(moof(0).size() + 8) + box("mdat", word(1, chunk));
  };
  const uint64_t piece = fragment(0, 0).size();
  const auto index = [&](uint64_t count) {
    std::string body = number(0, 4) + number(1, 4) + number(1000, 4) + number(0, 8) + number(count, 4);
    for (uint64_t i = 0; i < count; i++) body += number(piece, 4) + number(40, 4) + number(0x90000000, 4);
    return box("sidx", body);
  };
  const uint64_t first = video.size() + index(2).size();
  video += index(2) + fragment(0, first) + fragment(1, first + piece);
  std::string table = number(0x01000000, 4) + number(1, 4) + number(0, 4) + number(2, 4);
  for (uint64_t i = 0; i < 2; i++) table += number(40 * i, 8) + number(first + i * piece, 8) + std::string("\1\1\1");
  return video + box("mfra", box("tfra", table) + box("mfro", number(0, 8)));
}

// The positions of the bodies of all boxes on a path of types.
struct Found {
  size_t begin, end;  // range of the body
  size_t box;         // its first byte
};

inline std::vector<Found> find(const std::string& video, const std::vector<std::string>& path, size_t begin,
                               size_t end) {
  std::vector<Found> all;
  for (size_t at = begin; at + 8 <= end;) {
    size_t size = value(video, at, 4), header = 8;
    if (size == 1) size = value(video, at + 8, 8), header = 16;
    if (size == 0) size = end - at;
    if (video.substr(at + 4, 4) == path[0]) {
      const size_t prefix = path[0] == "stsd" ? 8 : path[0] == "avc1" ? 78 : 0;
      if (path.size() == 1)
        all.push_back({at + header, at + size, at});
      else
        for (const Found& found : find(video, {path.begin() + 1, path.end()}, at + header + prefix, at + size))
          all.push_back(found);
    }
    at += size;
  }
  return all;
}
inline std::vector<Found> find(const std::string& video, const std::vector<std::string>& path) {
  return find(video, path, 0, video.size());
}

// The words at the targets of all offsets of the video, in order.
inline std::vector<std::string> words(const std::string& video) {
  std::vector<std::string> all;
  for (const std::string type : {"stco", "co64"}) {
    for (const Found& table : find(video, {"moov", "trak", "mdia", "minf", "stbl", type})) {
      const int width = type == "stco" ? 4 : 8;
      for (size_t at = table.begin + 8; at < table.end; at += static_cast<size_t>(width)) {
        all.push_back(video.substr(value(video, at, width), kWord));
      }
    }
  }
  for (const Found& moof : find(video, {"moof"})) {
    const Found head = find(video, {"traf", "tfhd"}, moof.begin, moof.end).at(0);
    const Found run = find(video, {"traf", "trun"}, moof.begin, moof.end).at(0);
    const uint64_t base = (value(video, head.begin + 3, 1) & 1) != 0 ? value(video, head.begin + 8, 8) : moof.box;
    all.push_back(video.substr(base + value(video, run.begin + 8, 4), kWord));
  }
  return all;
}

// --- Matroska --------------------------------------------------------------------------------------------------------

inline std::string element(uint64_t id, const std::string& body, int width = 1) {
  int length = 1;
  while (id >> (8 * length) != 0) length++;
  return number(id, length) + number(body.size() | uint64_t{1} << (7 * width), width) + body;
}

struct MatroskaOptions {
  size_t room = 0;               // bytes of a Void after the tracks
  bool cues_first = false;       // before the clusters
  bool records_position = true;  // every cluster contains its position
  bool endless = false;          // the segment has an unknown size
  std::string video;             // in the Video element
  std::string tags;
  int width = 256, height = 256;
};

// SeekHead, Tracks, two clusters, Cues, with consistent positions.
inline std::string matroska(const MatroskaOptions& options) {
  const std::string head = element(0x1a45dfa3, element(0x4287, number(2, 1)) + element(0x4282, "matroska"));
  const std::string video = element(0xb0, number(static_cast<uint64_t>(options.width), 2)) +
                            element(0xba, number(static_cast<uint64_t>(options.height), 2)) + options.video;
  const std::string tracks =
      element(0x1654ae6b, element(0xae, element(0xd7, number(1, 1)) + element(0x73c5, number(7, 1)) +
                                            element(0x83, number(1, 1)) + element(0x86, "V_VP9") +
                                            element(0x23e383, number(40000000, 4)) + element(0xe0, video)));
  const std::string room = options.room == 0 ? "" : element(0xec, std::string(options.room - 9, '\0'), 8);
  const std::string tags = options.tags.empty() ? "" : element(0x1254c367, options.tags);
  const auto cluster = [&](int chunk, uint64_t at) {
    return element(0x1f43b675, element(0xe7, number(static_cast<uint64_t>(40 * chunk), 1)) +
                                   (options.records_position ? element(0xa7, number(at, 1)) : "") +
                                   element(0xa3, std::string("\x81\0\0\x80", 4) + word(1, chunk)));
  };
  const auto cues = [&](uint64_t first, uint64_t second) {
    const auto cue = [&](uint64_t at) {
      return element(
          0xbb, element(0xb3, number(0, 1)) +
                    element(0xb7, element(0xf7, number(1, 1)) + element(0xf1, number(at, options.room > 100 ? 2 : 1))));
    };
    return element(0x1c53bb6b, cue(first) + cue(second));
  };
  const auto seek = [&](uint64_t tracks_at, uint64_t cues_at) {
    const auto entry = [&](uint64_t id, uint64_t at) {
      return element(0x4dbb, element(0x53ab, number(id, 4)) + element(0x53ac, number(at, 2)));
    };
    return element(0x114d9b74, entry(0x1654ae6b, tracks_at) + entry(0x1c53bb6b, cues_at));
  };
  const uint64_t start = seek(0, 0).size(), after = start + tracks.size() + room.size() + tags.size();
  const uint64_t first = after + (options.cues_first ? cues(0, 0).size() : 0), second = first + cluster(0, 0).size();
  const uint64_t cues_at = options.cues_first ? after : second + cluster(1, 0).size();
  const std::string index = cues(first, second), clusters = cluster(0, first) + cluster(1, second);
  const std::string body = seek(start, cues_at) + tracks + room + tags + (options.cues_first ? index : "") + clusters +
                           (options.cues_first ? "" : index);
  std::string segment = element(0x18538067, body, 8);
  if (options.endless) segment.replace(4, 8, "\x01\xff\xff\xff\xff\xff\xff\xff");
  return head + segment;
}

// An element of a video.
struct Piece {
  uint64_t id;
  size_t at, begin, end;  // its first byte, its body
};

inline int leading_zeros(uint64_t byte) {
  int count = 0;
  while (count < 7 && (byte >> (7 - count) & 1) == 0) count++;
  return count;
}

inline Piece piece_at(const std::string& video, size_t at, size_t end) {
  const int length = leading_zeros(value(video, at, 1)) + 1;
  const size_t size_at = at + static_cast<size_t>(length);
  const int width = leading_zeros(value(video, size_t{size_at}, 1)) + 1;
  const uint64_t mask = (uint64_t{1} << (7 * width)) - 1, size = value(video, size_at, width) & mask;
  const size_t begin = size_at + static_cast<size_t>(width);
  return {value(video, at, length), at, begin, size == mask ? end : begin + size};
}

// All elements on a path of ids.
inline std::vector<Piece> pieces(const std::string& video, const std::vector<uint64_t>& path, size_t begin,
                                 size_t end) {
  std::vector<Piece> all;
  for (size_t at = begin; at < end;) {
    const Piece piece = piece_at(video, at, end);
    if (piece.id == path[0] && path.size() == 1) all.push_back(piece);
    if (piece.id == path[0] && path.size() > 1) {
      for (const Piece& found : pieces(video, {path.begin() + 1, path.end()}, piece.begin, piece.end))
        all.push_back(found);
    }
    at = piece.end;
  }
  return all;
}
inline std::vector<Piece> pieces(const std::string& video, const std::vector<uint64_t>& path) {
  return pieces(video, path, 0, video.size());
}

}  // namespace ods::made

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/mp4_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ods/image/format/file_format.h"
#include "ods/image/format/pixel_place.h"
#include "ods/video/container/apple.h"
#include "ods/video/container/box_offsets.h"
#include "ods/video/container/complete_metadata.h"
#include "ods/video/container/sound_entry.h"

namespace ods {

constexpr size_t kVisualEntry = 78;  // bytes of a visual sample entry before its boxes

// --- reading ---------------------------------------------------------------------------------------------------------

struct Mp4 {
  std::vector<FileBox> boxes;
  size_t header = 0;  // index of moov
  Box moov;
};

// The ancestors of the sample tables, the only large data in a header.
constexpr BoxType kSampleTables[] = {box_type("moov"), box_type("trak"), box_type("mdia"), box_type("minf"),
                                     box_type("stbl")};

// The name of another kind of file that begins like an mp4.
static std::string without_header(const FileInput& file, const std::vector<FileBox>& boxes) {
  constexpr std::pair<std::string_view, std::string_view> kOthers[] = {{"crx ", "a raw photo of a Canon camera (CR3)"},
                                                                       {"jxl ", "a JPEG XL picture"},
                                                                       {"jp2 ", "a JPEG 2000 picture"},
                                                                       {"jpx ", "a JPEG 2000 picture"},
                                                                       {"M4A ", "sound"},
                                                                       {"M4B ", "sound"}};
  const std::string brand = boxes.front().type == box_type("ftyp") && boxes.front().size >= 12
                                ? file.read(boxes.front().offset + boxes.front().header, 4)
                                : "";
  for (const auto& [name, what] : kOthers) {
    if (name == brand) return fmt::format("it is {}", what);
  }
  const auto has = [&](BoxType type) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const FileBox& box) { return box.type == type; });
  };
  if (has(box_type("meta")) && !has(box_type("mdat"))) return "it has no header of a video (moov)";
  return "it has no header (moov): the recording was not finished";
}

static Mp4 open_mp4(const FileInput& file) {
  Mp4 video;
  video.boxes = scan_boxes(file);
  const auto is_header = [](const FileBox& box) { return box.type == box_type("moov"); };
  const auto found = std::find_if(video.boxes.begin(), video.boxes.end(), is_header);
  if (found == video.boxes.end()) throw MalformedFile(without_header(file, video.boxes));
  if (std::find_if(found + 1, video.boxes.end(), is_header) != video.boxes.end())
    throw MalformedFile("it has two headers");
  video.header = static_cast<size_t>(found - video.boxes.begin());
  video.moov = read_box(file, *found, kSampleTables);
  if (find_child(video.moov, box_type("cmov"))) throw MalformedFile("its header is compressed, as QuickTime once did");
  return video;
}

static Box& sample_table(Box& track) {
  Box& media = open_child(open_child(track, box_type("mdia")), box_type("minf"));
  return open_child(media, box_type("stbl"));
}

static BoxType handler_of(Box& track) {
  const Box* handler = find_child(open_child(track, box_type("mdia")), box_type("hdlr"));
  return handler == nullptr ? 0 : static_cast<BoxType>(get_number(handler->body, 8, 4));
}

// A C string in mp4; in QuickTime it begins with its length.
static std::string name_of(Box& track) {
  constexpr size_t kName = 24;
  const Box* handler = find_child(open_child(track, box_type("mdia")), box_type("hdlr"));
  return handler == nullptr || handler->body.size() < kName ? "" : handler->body.substr(kName);
}

static bool is_video(Box& track) {
  return handler_of(track) == box_type("vide");
}

uint64_t track_id(const Box& track) {
  const Box* header = find_child(track, box_type("tkhd"));
  if (header == nullptr) throw MalformedFile("one of its tracks has no header");
  return get_number(header->body, get_number(header->body, 0, 1) == 0 ? 12 : 20, 4);
}

static double number_at(std::string_view bytes, size_t at) {
  return static_cast<double>(get_number(bytes, at, 4));
}

// The rate from the sample durations, or if all samples are in fragments, from their default duration.
static double rate_of(Box& track, Box& moov) {
  const Box* header = find_child(open_child(track, box_type("mdia")), box_type("mdhd"));
  const Box* times = find_child(sample_table(track), box_type("stts"));
  if (header == nullptr || times == nullptr) return 0.0;
  const double scale = number_at(header->body, get_number(header->body, 0, 1) == 0 ? 12 : 20);
  double samples = 0.0, duration = 0.0;
  const size_t count = std::min<size_t>(get_number(times->body, 4, 4), (times->body.size() - 8) / 8);
  for (size_t i = 0; i < count; i++) {
    const double run = number_at(times->body, 8 + 8 * i);
    samples += run;
    duration += run * number_at(times->body, 12 + 8 * i);
  }
  if (Box* fragments = find_child(moov, box_type("mvex")); fragments != nullptr && duration == 0.0) {
    open_box(*fragments, 0);
    for (const Box& defaults : fragments->children) {
      if (defaults.type != box_type("trex") || get_number(defaults.body, 4, 4) != track_id(track)) continue;
      samples = 1.0;
      duration = number_at(defaults.body, 12);
    }
  }
  return duration > 0.0 ? samples * scale / duration : 0.0;
}

static bool is_v1(const Box& box) {
  return box.type == box_type("uuid") && box.body.starts_with(kV1Id);
}

static double pixel_aspect_of(const Box& entry) {
  const Box* found = find_child(entry, box_type("pasp"));
  if (found == nullptr || found->body.size() < 8) return 1.0;
  const auto number = [&](size_t at) { return static_cast<double>(get_number(found->body, at, 4)); };
  return number(4) == 0.0 ? 1.0 : plausible_aspect(number(0) / number(4));
}

// An unreadable vexu is ignored, because it is used only by one vendor's players.
static std::optional<SphericalMetadata> read_vexu(const Box& entry) {
  try {
    return parse_vexu(entry);
  } catch (const MalformedFile&) {
    return std::nullopt;
  }
}

// MV-HEVC. A vexu without information about its layers is ignored.
static std::optional<EyeLayers> read_layers(const Box& entry) {
  try {
    return parse_layers(entry);
  } catch (const MalformedFile&) {
    return EyeLayers();
  }
}

static bool has_layers(const Box& entry) {
  return find_child(entry, box_type("lhvC")) != nullptr;
}

static VideoTrack read_video(Box& track, Box& moov) {
  VideoTrack video;
  video.id = track_id(track);
  video.name = name_of(track);
  for (Box& entry : open_child(sample_table(track), box_type("stsd"), 8).children) {
    open_box(entry, kVisualEntry);
    if (video.codec.empty()) {
      video.codec = type_text(entry.type);
      video.size.width = static_cast<int>(get_number(entry.body, 24, 2));
      video.size.height = static_cast<int>(get_number(entry.body, 26, 2));
    }
    if (!video.v2) video.v2 = parse_v2(entry);
    video.pixel_aspect = pixel_aspect_of(entry);
    if (video.mesh.empty()) video.mesh = find_mesh(entry);
    if (!video.vexu) video.vexu = read_vexu(entry);
    if (!video.layers) video.layers = read_layers(entry);
  }
  for (const Box& box : track.children) {
    if (is_v1(box) && !video.v1) video.v1 = parse_v1(box.body.substr(kV1Id.size()));
  }
  video.fps = rate_of(track, moov);
  return video;
}

// Unreadable sound metadata is ignored.
static SoundTrack read_sound(Box& track) {
  SoundTrack sound;
  sound.id = track_id(track);
  for (Box& entry : open_child(sample_table(track), box_type("stsd"), 8).children) {
    sound.codec = type_text(entry.type);
    try {
      open_sound_entry(entry);
    } catch (const MalformedFile&) {
      continue;
    }
    if (sound.channels == 0) sound.channels = count_channels(entry);
    if (const Box* box = find_child(entry, box_type("SA3D"))) sound.ambisonics = parse_sa3d(box->body);
  }
  return sound;
}

bool is_mp4(std::string_view first_bytes) {
  if (first_bytes.size() < 8) return false;
  if (format_of_bytes(std::as_bytes(std::span(first_bytes))) == FileFormat::kHeif) return false;
  const auto type = static_cast<BoxType>(get_number(first_bytes, 4, 4));
  const BoxType kFirst[] = {box_type("ftyp"), box_type("styp"), box_type("moov"), box_type("mdat"),
                            box_type("free"), box_type("skip"), box_type("wide"), box_type("pnot"),
                            box_type("uuid"), box_type("sidx"), box_type("moof")};
  return std::find(std::begin(kFirst), std::end(kFirst), type) != std::end(kFirst);
}

static Container container_of(const FileInput& file, const std::vector<FileBox>& boxes) {
  const FileBox& first = boxes.front();
  if (first.type != box_type("ftyp")) return Container::kMov;  // QuickTime files may have no ftyp
  if (first.size < first.header + 4) throw MalformedFile("it does not state its kind of mp4 (ftyp)");
  return file.read(first.offset + first.header, 4) == "qt  " ? Container::kMov : Container::kMp4;
}

VideoFile read_mp4(const FileInput& file) {
  Mp4 video = open_mp4(file);
  VideoFile info;
  info.container = container_of(file, video.boxes);
  info.is_fragmented = std::any_of(video.boxes.begin(), video.boxes.end(),
                                   [](const FileBox& box) { return box.type == box_type("moof"); });
  for (Box& track : video.moov.children) {
    if (track.type != box_type("trak")) continue;
    open_box(track, 0);
    if (is_video(track)) info.tracks.push_back(read_video(track, video.moov));
    if (handler_of(track) == box_type("soun")) info.sound.push_back(read_sound(track));
  }
  return info;
}

// --- writing ---------------------------------------------------------------------------------------------------------

// The first box of this type; removes further ones, which are not read by players.
static Box* only_child(Box& entry, BoxType type) {
  bool is_first = true;
  std::erase_if(entry.children, [&](const Box& box) { return box.type == type && !std::exchange(is_first, false); });
  return find_child(entry, type);
}

// Replaces or removes the box, or adds a new one after the codec's own boxes.
static void put_child(Box& entry, BoxType type, const std::optional<Box>& box) {
  std::vector<Box>& boxes = entry.children;
  Box* there = only_child(entry, type);
  if (!box) {
    if (there != nullptr) boxes.erase(boxes.begin() + (there - boxes.data()));
  } else if (there != nullptr) {
    *there = *box;
  } else {
    boxes.insert(
        std::find_if(boxes.begin(), boxes.end(),
                     [](const Box& each) { return each.type == box_type("pasp") || each.type == box_type("clap"); }),
        *box);
  }
}

// Keeps matching boxes byte-identical, apart from angles and source.
static void tag_v2(Box& entry, const SphericalMetadata& metadata) {
  const std::optional<SphericalMetadata> old = parse_v2(entry);
  const bool has_sphere = find_child(entry, box_type("sv3d")) != nullptr;
  const bool has_stereo = find_child(entry, box_type("st3d")) != nullptr;
  if (!old || !same_stereo(*old, metadata) || !(has_stereo || has_sphere)) {
    put_child(entry, box_type("st3d"), st3d_box(metadata));
  }
  if (has_sphere && same_sphere(*old, metadata)) {
    update_sv3d(*only_child(entry, box_type("sv3d")), metadata);
  } else if (metadata.projection && metadata.projection != VideoProjection::kFlat) {
    put_child(entry, box_type("sv3d"), sv3d_box(metadata));
  } else {
    put_child(entry, box_type("sv3d"), std::nullopt);
  }
}

static bool same_ipd(double a, double b) {
  return std::llround(a * 1e6) == std::llround(b * 1e6);
}

// Returns whether there is a vexu for this metadata. An unreadable one is kept unless a new one is requested. If the
// eyes are layers of the stream (MV-HEVC), vexu describes them and is kept unchanged.
static bool tag_vexu(Box& entry, const SphericalMetadata& metadata) {
  if (has_layers(entry)) return false;
  const std::optional<SphericalMetadata> old = read_vexu(entry);
  if (!old && !metadata.for_apple) return false;
  if (old && metadata.for_apple && same_stereo(*old, metadata) && same_sphere(*old, metadata) &&
      same_ipd(old->ipd, metadata.ipd)) {
    return true;
  }
  std::optional<Box> vexu, hfov;
  if (metadata.for_apple && fits_vexu(metadata)) {
    const Box* there = find_child(entry, box_type("vexu"));
    vexu = old ? updated_vexu(*there, metadata) : vexu_box(metadata);
    if (find_child(entry, box_type("hfov")) != nullptr) hfov = hfov_box(metadata);
  }
  put_child(entry, box_type("vexu"), vexu);
  put_child(entry, box_type("hfov"), hfov);
  return vexu.has_value();
}

static void untag_entry(Box& entry) {
  put_child(entry, box_type("st3d"), std::nullopt);
  put_child(entry, box_type("sv3d"), std::nullopt);
  if (has_layers(entry)) return;
  put_child(entry, box_type("vexu"), std::nullopt);
  put_child(entry, box_type("hfov"), std::nullopt);
}

// Updates the first V1 metadata if it can express this metadata; otherwise removes it, and writes new V1 metadata if
// possible.
static bool tag_v1(Box& track, const std::optional<SphericalMetadata>& metadata, bool has_new_source) {
  const auto first = std::find_if(track.children.begin(), track.children.end(), is_v1);
  const std::string old = first == track.children.end() ? "" : first->body.substr(kV1Id.size());
  std::optional<std::string> xml = metadata ? updated_v1(old, *metadata, has_new_source) : std::nullopt;
  if (metadata && !xml && fits_v1(*metadata)) xml = v1_xml(*metadata);
  if (xml && *xml == old) {
    bool is_first = true;
    std::erase_if(track.children, [&](const Box& box) { return is_v1(box) && !std::exchange(is_first, false); });
    return true;
  }
  std::erase_if(track.children, is_v1);
  if (!xml) return false;
  Box box;
  box.type = box_type("uuid");
  box.body = std::string(kV1Id) + *xml;
  track.children.push_back(std::move(box));
  return true;
}

static TagResult tag_track(Box& track, const std::optional<SphericalMetadata>& metadata, const VideoTrack& before) {
  TagResult result;
  if (metadata && !can_express(Container::kMp4, before, *metadata)) {
    throw MalformedFile(fmt::format("mp4 and mov cannot express {}", metadata_text(*metadata)));
  }
  for (Box& entry : open_child(sample_table(track), box_type("stsd"), 8).children) {
    open_box(entry, kVisualEntry);
    if (metadata) {
      tag_v2(entry, *metadata);
      result.has_vexu = tag_vexu(entry, *metadata);
      result.has_v2 = true;
    } else {
      untag_entry(entry);
    }
  }
  if (metadata && !result.has_v2) throw MalformedFile("its video track has no description of its pictures");
  const std::optional<SphericalMetadata> said = declared_metadata(before);
  result.has_v1 = tag_v1(track, metadata, metadata && said && said->source != metadata->source);
  return result;
}

static void tag_sound(Box& track, const Ambisonics& sound) {
  for (Box& entry : open_child(sample_table(track), box_type("stsd"), 8).children) {
    open_sound_entry(entry);
    std::erase_if(entry.children, [](const Box& box) { return box.type == box_type("SA3D"); });
    entry.children.push_back(sa3d_box(sound));
  }
}

// Rejects tracks with data in other files, whose offsets must not be moved.
static void refuse_other_files(Box& track) {
  Box& media = open_child(open_child(track, box_type("mdia")), box_type("minf"));
  Box* information = find_child(media, box_type("dinf"));
  if (information == nullptr) return;
  open_box(*information, 0);
  Box* references = find_child(*information, box_type("dref"));
  if (references == nullptr) return;
  open_box(*references, 8);
  for (const Box& reference : references->children) {
    if ((get_number(reference.body, 3, 1) & 1) == 0)
      throw MalformedFile("its samples are in other files; export it as one file");
  }
}

namespace {

struct Plan {
  Move move;
  bool uses_free = false;  // shrinks or grows the box after the header
  uint64_t free = 0;       // bytes left in the box
};

}  // namespace

static Plan plan_once(const Mp4& video, uint64_t file_size) {
  const FileBox& old = video.boxes[video.header];
  const int64_t growth = static_cast<int64_t>(box_size(video.moov)) - static_cast<int64_t>(old.size);
  Plan plan;
  plan.move = {old.offset, old.end(), growth, file_size};
  if (growth == 0 || video.header + 1 == video.boxes.size()) return plan;
  const FileBox& next = video.boxes[video.header + 1];
  const bool is_free = next.type == box_type("free") || next.type == box_type("skip");
  const int64_t left = static_cast<int64_t>(next.size) - growth;
  if (is_free && (left == 0 || left >= 8) && left <= 0xffffffff) {
    plan.move = {old.offset, next.end(), 0, file_size};
    plan.uses_free = true;
    plan.free = static_cast<uint64_t>(left);
  }
  return plan;
}

// Widening offsets may lengthen the header, so repeat until its length is stable.
static Plan plan_move(Mp4& video, uint64_t file_size) {
  for (;;) {
    const Plan plan = plan_once(video, file_size);
    bool widened = false;
    for (Box& track : video.moov.children) {
      if (track.type == box_type("trak")) widened = widen_offsets(sample_table(track), plan.move) || widened;
    }
    if (!widened) return plan;
  }
}

static void move_header(Box& moov, const Move& move) {
  for (Box& box : moov.children) {
    if (box.type == box_type("meta")) move_item_offsets(box, move);
    if (box.type != box_type("trak")) continue;
    refuse_other_files(box);
    move_offsets(sample_table(box), move);
    if (Box* meta = find_child(box, box_type("meta"))) move_item_offsets(*meta, move);
  }
}

static void write_header(const Mp4& video, const Plan& plan, AtomicFile& to) {
  write_box(video.moov, to);
  if (plan.free == 0) return;
  Box filler;
  filler.type = box_type("free");
  filler.body.resize(plan.free - 8);
  write_box(filler, to);
}

TagResult tag_mp4(const FileInput& file, AtomicFile& to, uint64_t number,
                  const std::optional<SphericalMetadata>& metadata, const OtherTags& other) {
  Mp4 video = open_mp4(file);
  TagResult result;
  size_t sounds = 0;
  for (Box& track : video.moov.children) {
    if (track.type != box_type("trak")) continue;
    open_box(track, 0);
    if (is_video(track) && track_id(track) == number) {
      add_user_data(other.user.pictures, track);
      result = tag_track(track, metadata, read_video(track, video.moov));
    }
    if (handler_of(track) != box_type("soun")) continue;
    if (sounds < other.sound.size() && other.sound[sounds]) tag_sound(track, *other.sound[sounds]);
    sounds++;
  }
  add_user_data(other.user.movie, video.moov);
  const Plan plan = plan_move(video, file.size());
  move_header(video.moov, plan.move);
  result.moved = plan.move.growth != 0;
  for (size_t i = 0; i < video.boxes.size(); i++) {
    const FileBox& box = video.boxes[i];
    if (i == video.header) {
      write_header(video, plan, to);
      if (plan.uses_free) i++;
    } else if (result.moved && may_have_offsets(box.type)) {
      Box moved = read_box(file, box);
      move_offsets(moved, box, plan.move);
      write_box(moved, to);
    } else {
      file.copy(box.offset, box.size, to);
    }
  }
  for (const Box& box : other.user.file) write_box(box, to);
  return result;
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/tracks/kept_tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/video/container/user_data.h"
#include "ods/video/tracks/ambisonics.h"
#include "ods/video/tracks/av.h"
#include "ods/video/tracks/kept_tags.h"
#include "ods/video/tracks/sound.h"
#include "ods/video/tracks/text_track.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/timecode.h>
}

namespace ods {

using av::checked, av::checked_small_input, av::made, av::Owned;

namespace {

// The handling of a stream.
enum class Fate { kCopied, kSound, kText, kCover, kAttachment, kCoverAttachment, kElsewhere, kLost };

struct Kept {
  const AVStream* from = nullptr;
  Fate fate = Fate::kLost;
  std::string why;                  // the reason why it is lost, or encoded again; else empty
  std::optional<Ambisonics> field;  // set for ambisonic sound
  bool is_field = false;            // the sound is ambisonic
  int to = -1;                      // the index of the new stream
  std::unique_ptr<SideTracks> sound;
  std::unique_ptr<TextTrack> text;
};

}  // namespace

// --- handling of the streams -----------------------------------------------------------------------------------------

static std::string tag_of(const AVStream& stream, const char* key) {
  const AVDictionaryEntry* entry = av_dict_get(stream.metadata, key, nullptr, 0);
  return entry == nullptr ? "" : entry->value;
}

// "subtitles (stream 3, subrip, deu)".
static std::string name_of(const AVStream& stream) {
  const AVCodecParameters& facts = *stream.codecpar;
  const char* kind = facts.codec_type == AVMEDIA_TYPE_AUDIO        ? "sound"
                     : facts.codec_type == AVMEDIA_TYPE_SUBTITLE   ? "subtitles"
                     : facts.codec_type == AVMEDIA_TYPE_ATTACHMENT ? "attachment"
                     : facts.codec_type == AVMEDIA_TYPE_VIDEO      ? "pictures"
                                                                   : "data";
  std::string codec = facts.codec_id == AV_CODEC_ID_NONE ? "" : avcodec_get_name(facts.codec_id);
  if (facts.codec_type == AVMEDIA_TYPE_DATA && facts.codec_tag != 0) {
    codec.clear();
    for (int shift = 0; shift < 32; shift += 8) codec += static_cast<char>(facts.codec_tag >> shift & 0xff);
  }
  std::string text = fmt::format("{} (stream {}", kind, stream.index);
  for (const std::string& each :
       {codec, tag_of(stream, "language"), tag_of(stream, "title"), tag_of(stream, "filename")}) {
    if (!each.empty() && each != "und") text += ", " + one_line(each);
  }
  return text + ")";
}

// Returns whether a track is rotated with the view, and so must be encoded again.
static bool turns(const KeepOptions& keep, const Kept& kept) {
  return keep.turn && kept.is_field;
}

static void decide_sound(const KeepOptions& keep, Container container, Kept& kept) {
  const AVCodecID codec = kept.from->codecpar->codec_id;
  const AVChannelLayout& layout = kept.from->codecpar->ch_layout;
  kept.is_field = kept.field || layout.order == AV_CHANNEL_ORDER_AMBISONIC;
  const bool is_held = can_hold(container, codec);
  if (is_held && !turns(keep, kept)) {
    kept.fate = Fate::kCopied;
    const bool may_be_field = layout.nb_channels >= 4 && ambisonic_order(layout.nb_channels) > 0;
    if (keep.turn && may_be_field) kept.why = "is not rotated with the picture: it is not marked as ambisonic";
    return;
  }
  SoundSource source{keep.path, kept.from->index, true, true, keep.cut};
  source.is_ambisonic = kept.is_field;
  source.head_locked = kept.field && kept.field->has_head_locked ? 2 : 0;
  source.turn = keep.turn;
  const std::string reason = turns(keep, kept) ? "it turns with the picture"
                                               : fmt::format("{} cannot hold it as it is", container_name(container));
  try {
    kept.sound = pack_sound(source, container);
    kept.fate = Fate::kSound;
    kept.why = fmt::format("is encoded again: {}", reason);
  } catch (const Error& error) {
    kept.fate = is_held ? Fate::kCopied : Fate::kLost;
    kept.why = fmt::format("{}: {}", is_held ? "does not turn with the picture" : "is lost", error.what());
  }
}

// Text is converted to the container's own kind; drawn subtitles cannot be.
static void decide_subtitles(Container container, Kept& kept) {
  if (can_hold(container, kept.from->codecpar->codec_id)) {
    kept.fate = Fate::kCopied;
    return;
  }
  kept.text = text_track(*kept.from, container);
  kept.fate = kept.text ? Fate::kText : Fate::kLost;
  if (!kept.text) kept.why = fmt::format("are lost: {} cannot hold them", container_name(container));
}

static void decide_pictures(const KeepOptions& keep, Container container, Kept& kept) {
  const AVCodecID codec = kept.from->codecpar->codec_id;
  const bool is_cover = (kept.from->disposition & AV_DISPOSITION_ATTACHED_PIC) != 0;
  const bool is_usual = codec == AV_CODEC_ID_MJPEG || codec == AV_CODEC_ID_PNG;
  if (!is_cover) {
    kept.why = "are lost: a new video has one track of pictures";
  } else if (has_boxes(container) && has_user_data(keep.path)) {
    kept.fate = Fate::kElsewhere;  // stored in the user data
  } else if (container == Container::kMp4 && is_usual) {
    kept.fate = Fate::kCover;
  } else if (container == Container::kMatroska) {
    kept.fate = Fate::kCoverAttachment;
  } else {
    kept.why = fmt::format("are lost: {} has no covers", container_name(container));
  }
}

// Timecode is a tag of the pictures; a text track that the demuxer does not expose contains the chapters' names.
static void decide_data(Container container, Kept& kept) {
  const uint32_t tag = kept.from->codecpar->codec_tag;
  const bool is_timecode = tag == MKTAG('t', 'm', 'c', 'd'), is_chapters = tag == MKTAG('t', 'e', 'x', 't');
  if (is_timecode || is_chapters) {
    kept.fate = Fate::kElsewhere;
  } else if (kept.from->codecpar->codec_id != AV_CODEC_ID_NONE && can_hold(container, kept.from->codecpar->codec_id)) {
    kept.fate = Fate::kCopied;
  } else {
    kept.why = "is lost: nothing here writes such a track";
  }
}

static void decide(const KeepOptions& keep, Container container, Kept& kept) {
  switch (kept.from->codecpar->codec_type) {
    case AVMEDIA_TYPE_AUDIO:
      return decide_sound(keep, container, kept);
    case AVMEDIA_TYPE_SUBTITLE:
      return decide_subtitles(container, kept);
    case AVMEDIA_TYPE_VIDEO:
      return decide_pictures(keep, container, kept);
    case AVMEDIA_TYPE_ATTACHMENT:
      kept.fate = container == Container::kMatroska ? Fate::kAttachment : Fate::kLost;
      if (kept.fate == Fate::kLost) {
        kept.why = fmt::format("is lost: {} has no attachments", container_name(container));
      }
      return;
    default:
      return decide_data(container, kept);
  }
}

// The ambisonics of the sound tracks of an mp4 or mov.
static std::vector<std::optional<Ambisonics>> fields_of(const std::string& path) {
  std::vector<std::optional<Ambisonics>> fields;
  for (const SoundTrack& each : read_video_file(path).sound) fields.push_back(each.ambisonics);
  return fields;
}

// All streams except the pictures, and the sound if it is replaced.
static std::vector<Kept> decide_all(AVFormatContext& file, const KeepOptions& keep, Container container) {
  std::vector<Kept> all;
  const AVStream* const pictures = av::pictures_of(file, keep.path, keep.track);
  const AVStream* const joined = keep.joined ? av::pictures_of(file, keep.path, *keep.joined) : nullptr;
  const std::vector<std::optional<Ambisonics>> fields = fields_of(keep.path);
  size_t sounds = 0;
  for (unsigned i = 0; i < file.nb_streams; i++) {
    Kept kept;
    kept.from = file.streams[i];
    const bool is_sound = kept.from->codecpar->codec_type == AVMEDIA_TYPE_AUDIO;
    if (is_sound && sounds < fields.size()) kept.field = fields[sounds++];
    if (kept.from == pictures || kept.from == joined || (is_sound && !keep.has_sound)) continue;
    decide(keep, container, kept);
    all.push_back(std::move(kept));
  }
  return all;
}

// --- timecode --------------------------------------------------------------------------------------------------------

// Moves the timecode of a part to its first picture.
static void move_timecode(AVStream& pictures, const TimeCut& cut, double first) {
  const std::string old = tag_of(pictures, "timecode");
  if (old.empty() || !cut.is_cut) return;
  AVTimecode timecode;
  if (av_timecode_init_from_string(&timecode, pictures.avg_frame_rate, old.c_str(), nullptr) < 0) return;
  const int frames = static_cast<int>(std::lround((cut.start - first) * av_q2d(pictures.avg_frame_rate)));
  char text[AV_TIMECODE_STR_SIZE];
  av_dict_set(&pictures.metadata, "timecode", av_timecode_make_string(&timecode, text, frames), 0);
}

static double first_time(const AVStream& stream) {
  return stream.start_time == AV_NOPTS_VALUE ? 0.0 : static_cast<double>(stream.start_time) * av_q2d(stream.time_base);
}

// --- the tracks ------------------------------------------------------------------------------------------------------

static void set_bytes(AVCodecParameters& facts, const uint8_t* bytes, int size) {
  av_freep(&facts.extradata);
  facts.extradata = static_cast<uint8_t*>(made(av_mallocz(static_cast<size_t>(size) + AV_INPUT_BUFFER_PADDING_SIZE)));
  facts.extradata_size = size;
  std::memcpy(facts.extradata, bytes, static_cast<size_t>(size));
}

// A cover in Matroska is an attachment with this name.
static void describe_cover(const AVStream& from, AVStream& to) {
  const bool is_png = from.codecpar->codec_id == AV_CODEC_ID_PNG;
  to.codecpar->codec_type = AVMEDIA_TYPE_ATTACHMENT;
  to.codecpar->codec_id = from.codecpar->codec_id;
  set_bytes(*to.codecpar, from.attached_pic.data, from.attached_pic.size);
  av_dict_set(&to.metadata, "filename", is_png ? "cover.png" : "cover.jpg", AV_DICT_DONT_OVERWRITE);
  av_dict_set(&to.metadata, "mimetype", is_png ? "image/png" : "image/jpeg", AV_DICT_DONT_OVERWRITE);
}

namespace {

class KeptTracks final : public SideTracks {
 public:
  KeptTracks(const KeepOptions& keep, Container container)
      : keep_(keep), container_(container), file_(av::open_file(keep.path, what())) {
    kept_ = decide_all(*file_, keep, container);
    for (unsigned i = 0; i < file_->nb_streams; i++) file_->streams[i]->discard = AVDISCARD_ALL;
    for (const Kept& each : kept_) {
      const bool is_read = each.fate == Fate::kCopied || each.fate == Fate::kText;
      if (is_read) file_->streams[each.from->index]->discard = AVDISCARD_DEFAULT;
    }
  }

  void add_to(AVFormatContext& file) override {
    AVStream& pictures = *file.streams[0];
    if (const AVStream* old = av::pictures_of(*file_, keep_.path, keep_.track)) {
      av::copy_tags(old->metadata, &pictures.metadata, true);
      pictures.disposition = old->disposition;
      const AVDictionaryEntry* code = av_dict_get(file_->metadata, "timecode", nullptr, 0);
      if (code != nullptr) av_dict_set(&pictures.metadata, "timecode", code->value, AV_DICT_DONT_OVERWRITE);
      move_timecode(pictures, keep_.cut, first_time(*old));
    }
    for (Kept& each : kept_) {
      if (keep_.tell && !each.why.empty()) keep_.tell(fmt::format("{} {}", name_of(*each.from), each.why));
      if (each.fate != Fate::kLost && each.fate != Fate::kElsewhere) add(each, file);
    }
    // The copied boxes contain the same.
    const AVDictionaryEntry* time = av_dict_get(file_->metadata, "creation_time", nullptr, 0);
    if (!has_boxes(container_) || !has_user_data(keep_.path)) av::copy_tags(file_->metadata, &file.metadata, false);
    if (time != nullptr) av_dict_set(&file.metadata, "creation_time", time->value, 0);
    av::copy_chapters(*file_, keep_.cut, file);
  }

  Owned<AVPacket> next(double until, bool is_end) override {
    if (!covers_.empty()) {
      Owned<AVPacket> cover = std::move(covers_.back());
      covers_.pop_back();
      return cover;
    }
    for (const Kept& each : kept_) {
      if (!each.sound) continue;
      const bool is_whole = is_end && !keep_.cut.is_cut;
      if (Owned<AVPacket> packet = each.sound->next(is_whole ? 1e9 : until, is_end)) return packet;
    }
    if (is_end && !keep_.cut.is_cut) until = INFINITY;
    if (!waiting_ && !read()) return nullptr;
    if (seconds(waiting_->pts, *waiting_) >= until) return nullptr;
    return shifted(std::move(waiting_), std::min(is_end ? until : INFINITY, keep_.cut.length));
  }

 private:
  std::string what() const { return fmt::format("cannot read '{}'", keep_.path); }

  void add(Kept& kept, AVFormatContext& file) {
    kept.to = static_cast<int>(file.nb_streams);
    if (kept.sound) {
      kept.sound->add_to(file);
    } else {
      avformat_new_stream(&file, nullptr);
    }
    if (static_cast<int>(file.nb_streams) == kept.to) throw std::bad_alloc();
    AVStream& to = *file.streams[kept.to];
    av::copy_tags(kept.from->metadata, &to.metadata, false);
    to.disposition = kept.from->disposition;
    if (kept.sound) return;
    if (kept.text) return kept.text->describe(to);
    if (kept.fate == Fate::kCoverAttachment) return describe_cover(*kept.from, to);
    checked(avcodec_parameters_copy(to.codecpar, kept.from->codecpar), ErrorKind::kOutput, what());
    if (to.codecpar->codec_type != AVMEDIA_TYPE_DATA) to.codecpar->codec_tag = 0;  // the old container's
    to.time_base = kept.from->time_base;
    // FLAC in mp4, which libavformat calls an experiment, has been standard since 2017.
    if (to.codecpar->codec_id == AV_CODEC_ID_FLAC) file.strict_std_compliance = FF_COMPLIANCE_EXPERIMENTAL;
    if (kept.fate != Fate::kCover) return;
    Owned<AVPacket> packet(made(av_packet_clone(&kept.from->attached_pic)));
    packet->stream_index = kept.to;
    packet->time_base = to.time_base;
    packet->pts = packet->dts = 0;
    covers_.push_back(std::move(packet));
  }

  // The time in seconds of the new video.
  double seconds(int64_t ticks, const AVPacket& packet) const {
    if (ticks == AV_NOPTS_VALUE) ticks = packet.dts;
    return ticks == AV_NOPTS_VALUE ? 0.0 : static_cast<double>(ticks) * av_q2d(packet.time_base) - keep_.cut.start;
  }

  Kept* kept_of(int index) {
    for (Kept& each : kept_) {
      if (each.from->index == index && (each.fate == Fate::kCopied || each.fate == Fate::kText)) return &each;
    }
    return nullptr;
  }

  // Returns whether any part of a packet belongs to the new video. A subtitle may begin earlier.
  bool is_inside(const AVPacket& packet, const Kept& kept) const {
    if (!keep_.cut.is_cut || seconds(packet.pts, packet) >= 0.0) return true;
    const bool is_shown = kept.from->codecpar->codec_type == AVMEDIA_TYPE_SUBTITLE && packet.duration > 0;
    return is_shown && seconds(packet.pts + packet.duration, packet) > 0.0;
  }

  Owned<AVPacket> shifted(Owned<AVPacket> packet, double end) const {
    const int64_t start = std::llround(keep_.cut.start / av_q2d(packet->time_base));
    if (packet->pts != AV_NOPTS_VALUE) packet->pts -= start;
    if (packet->dts != AV_NOPTS_VALUE) packet->dts -= start;
    if (keep_.cut.is_cut && is_subtitle_) {
      if (packet->pts < 0) packet->duration += packet->pts, packet->pts = packet->dts = 0;
      if (std::isfinite(end)) {
        const int64_t last = std::llround(end / av_q2d(packet->time_base));
        packet->duration = std::clamp<int64_t>(last - packet->pts, 0, packet->duration);
      }
    }
    packet->pos = -1;
    packet->stream_index = to_;
    return packet;
  }

  // Reads the next packet that is kept, in the time base of its old stream.
  bool read() {
    while (!ended_) {
      waiting_.reset(made(av_packet_alloc()));
      const int code = av_read_frame(file_.get(), waiting_.get());
      ended_ = code == AVERROR_EOF;
      if (ended_) break;
      checked_small_input(code, what());
      const Kept* kept = kept_of(waiting_->stream_index);
      if (kept == nullptr) continue;
      waiting_->time_base = kept->from->time_base;
      if (!is_inside(*waiting_, *kept)) continue;
      if (kept->text) waiting_ = kept->text->encode(*waiting_);
      if (!waiting_) continue;
      waiting_->time_base = kept->from->time_base;
      to_ = kept->to;
      is_subtitle_ = kept->from->codecpar->codec_type == AVMEDIA_TYPE_SUBTITLE;
      return true;
    }
    waiting_.reset();
    return false;
  }

  KeepOptions keep_;
  Container container_;
  Owned<AVFormatContext> file_;
  std::vector<Kept> kept_;
  std::vector<Owned<AVPacket>> covers_;
  Owned<AVPacket> waiting_;
  int to_ = 0;                // index of the new stream of the waiting packet
  bool is_subtitle_ = false;  // the waiting packet is a subtitle
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<SideTracks> keep_tracks(const KeepOptions& keep, Container container) {
  return std::make_unique<KeptTracks>(keep, container);
}

std::vector<std::optional<Ambisonics>> kept_ambisonics(const KeepOptions& keep, Container container) {
  std::vector<std::optional<Ambisonics>> fields;
  if (keep.path.empty()) return fields;
  const Owned<AVFormatContext> file = av::open_file(keep.path, fmt::format("cannot read '{}'", keep.path));
  for (const Kept& each : decide_all(*file, keep, container)) {
    const bool is_sound = each.from->codecpar->codec_type == AVMEDIA_TYPE_AUDIO;
    if (is_sound && each.fate != Fate::kLost) fields.push_back(each.field);
  }
  return fields;
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/sound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/base/error.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/audio_fifo.h>
#include <libavutil/opt.h>
#include <libswresample/swresample.h>
}

namespace ods {

using av::checked, av::checked_small_input, av::made, av::Owned;

constexpr int kSoundRate = 48000;
constexpr int kMinRate = 1000, kMaxRate = 768000;  // plausible sample rates, in Hz
constexpr int64_t kSoundBitRate = 128000;          // per channel

namespace {

struct SoundFile {
  Owned<AVFormatContext> file;
  Owned<AVCodecContext> decoder;
  const AVStream* stream = nullptr;
};

}  // namespace

// The index of the best stream with sound, and its decoder if asked for.
static int find_sound(AVFormatContext& file, const std::string& what, const AVCodec** codec) {
  const int index = av_find_best_stream(&file, AVMEDIA_TYPE_AUDIO, -1, -1, codec, 0);
  if (index == AVERROR_STREAM_NOT_FOUND) {
    throw Error(ErrorKind::kInput, fmt::format("{}: it has none; give --audio a sound file (wav, flac, mp3 ...) or a "
                                               "video with sound, or leave --audio out",
                                               what));
  }
  return checked_small_input(index, what);
}

static SoundFile open_sound_file(const std::string& path) {
  const std::string what = fmt::format("cannot read the sound of '{}'", path);
  SoundFile sound;
  sound.file = av::open_file(path, what);
  AVFormatContext* file = sound.file.get();
  const AVCodec* codec = nullptr;
  sound.stream = file->streams[find_sound(*file, what, &codec)];
  sound.decoder.reset(made(avcodec_alloc_context3(codec)));
  sound.decoder->pkt_timebase = sound.stream->time_base;
  checked_small_input(avcodec_parameters_to_context(sound.decoder.get(), sound.stream->codecpar), what);
  checked_small_input(avcodec_open2(sound.decoder.get(), codec, nullptr), what);
  const int channels = sound.decoder->ch_layout.nb_channels;
  if (channels != 1 && channels != 2 && channels != 4) {
    throw Error(ErrorKind::kInput, fmt::format("{}: it has {} channels; videos have 1, 2, or 4 of first-order "
                                               "ambisonics",
                                               what, channels));
  }
  const int rate = sound.decoder->sample_rate;
  if (rate < kMinRate || rate > kMaxRate) {
    throw Error(ErrorKind::kInput, fmt::format("{}: it claims {} samples per second", what, rate));
  }
  return sound;
}

SoundInfo read_sound_info(const std::string& path) {
  const SoundFile sound = open_sound_file(path);
  SoundInfo info{sound.decoder->ch_layout.nb_channels, 0.0};
  if (sound.stream->duration > 0) {
    info.seconds = static_cast<double>(sound.stream->duration) * av_q2d(sound.stream->time_base);
  } else if (sound.file->duration > 0) {
    info.seconds = static_cast<double>(sound.file->duration) / AV_TIME_BASE;
  }
  return info;
}

// AAC in mp4, PCM in mov, Opus in Matroska.
static Owned<AVCodecContext> open_sound_encoder(Container container, int channels) {
  const char* name = container == Container::kMp4 ? "aac" : container == Container::kMov ? "pcm_s24le" : "libopus";
  const AVCodec* codec = avcodec_find_encoder_by_name(name);
  if (codec == nullptr) {
    throw Error(ErrorKind::kUsage, fmt::format("this machine's libavcodec has no {} encoder, which sound in {} needs",
                                               name, container_name(container)));
  }
  Owned<AVCodecContext> context(made(avcodec_alloc_context3(codec)));
  context->sample_rate = kSoundRate;
  context->sample_fmt = container == Container::kMp4   ? AV_SAMPLE_FMT_FLTP
                        : container == Container::kMov ? AV_SAMPLE_FMT_S32
                                                       : AV_SAMPLE_FMT_FLT;
  context->bit_rate = kSoundBitRate * channels;
  context->time_base = {1, kSoundRate};
  context->flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;
  av_channel_layout_default(&context->ch_layout, channels);
  if (channels == 4 && !has_boxes(container)) {
    // The ambisonics mapping (RFC 8486).
    checked(av_opt_set(context->priv_data, "mapping_family", "2", 0), ErrorKind::kInput,
            "libopus does not support ambisonics");
  }
  checked(avcodec_open2(context.get(), codec, nullptr), ErrorKind::kInput,
          fmt::format("{} cannot encode the sound", name));
  return context;
}

namespace {

// A file's sound, decoded and encoded anew.
class PackedSound final : public Sound {
 public:
  PackedSound(const std::string& path, Container container)
      : path_(path),
        source_(open_sound_file(path)),
        encoder_(open_sound_encoder(container, source_.decoder->ch_layout.nb_channels)) {
    AVCodecContext &in = *source_.decoder, &out = *encoder_;
    rate_ = in.sample_rate;
    format_ = in.sample_fmt;
    SwrContext* converter = nullptr;
    // Channels keep their order, whatever layout the file declares.
    checked_small_input(swr_alloc_set_opts2(&converter, &out.ch_layout, out.sample_fmt, out.sample_rate, &out.ch_layout,
                                            in.sample_fmt, in.sample_rate, 0, nullptr),
                        what());
    converter_.reset(converter);
    checked_small_input(swr_init(converter), what());
    fifo_.reset(made(av_audio_fifo_alloc(out.sample_fmt, out.ch_layout.nb_channels, kSoundRate)));
  }

  void describe(AVStream& stream) const override {
    checked(avcodec_parameters_from_context(stream.codecpar, encoder_.get()), ErrorKind::kOutput, what());
    stream.time_base = encoder_->time_base;
  }

  Owned<AVPacket> next(double until, bool is_end) override {
    Owned<AVPacket> packet(made(av_packet_alloc()));
    for (;;) {
      const int code = avcodec_receive_packet(encoder_.get(), packet.get());
      if (code == AVERROR_EOF) return nullptr;
      if (code != AVERROR(EAGAIN)) {
        checked(code, ErrorKind::kOutput, what());
        packet->time_base = encoder_->time_base;
        return packet;
      }
      const Owned<AVFrame> frame = samples(std::llround(until * kSoundRate), is_end);
      if (!frame && !is_end) return nullptr;
      checked(avcodec_send_frame(encoder_.get(), frame.get()), ErrorKind::kOutput, what());
    }
  }

 private:
  // The next samples up to a position; none at the end. Encoders need full frames except for the last.
  Owned<AVFrame> samples(int64_t until, bool is_end) {
    const int64_t size = encoder_->frame_size > 0 ? encoder_->frame_size : 1024, most = until - position_;
    if (most < size && !is_end) return nullptr;
    while (!ended_ && av_audio_fifo_size(fifo_.get()) < size) decode();
    const int64_t count = std::min<int64_t>({size, most, av_audio_fifo_size(fifo_.get())});
    if (count <= 0) return nullptr;
    Owned<AVFrame> frame = make_frame(static_cast<int>(count));
    av_audio_fifo_read(fifo_.get(), reinterpret_cast<void**>(frame->data), static_cast<int>(count));
    frame->pts = position_;
    position_ += count;
    return frame;
  }

  std::string what() const { return fmt::format("cannot read the sound of '{}'", path_); }

  Owned<AVFrame> make_frame(int samples) const {
    Owned<AVFrame> frame(made(av_frame_alloc()));
    frame->nb_samples = samples;
    frame->format = encoder_->sample_fmt;
    frame->sample_rate = encoder_->sample_rate;
    checked(av_channel_layout_copy(&frame->ch_layout, &encoder_->ch_layout), ErrorKind::kMemory, what());
    checked(av_frame_get_buffer(frame.get(), 0), ErrorKind::kMemory, what());
    return frame;
  }

  // null: flush the converter.
  void convert(const AVFrame* in) {
    const int count = in == nullptr ? 0 : in->nb_samples;
    const Owned<AVFrame> out = make_frame(std::max(swr_get_out_samples(converter_.get(), count), 1));
    const auto from = in == nullptr ? nullptr : const_cast<const uint8_t**>(in->extended_data);
    const int got = checked_small_input(swr_convert(converter_.get(), out->data, out->nb_samples, from, count), what());
    checked(av_audio_fifo_write(fifo_.get(), reinterpret_cast<void**>(out->data), got), ErrorKind::kMemory, what());
  }

  void decode() {
    const Owned<AVFrame> frame(made(av_frame_alloc()));
    const int code = avcodec_receive_frame(source_.decoder.get(), frame.get());
    if (code == AVERROR(EAGAIN)) return feed();
    ended_ = code == AVERROR_EOF;
    if (!ended_) checked_small_input(code, what());
    const bool is_other = !ended_ && (frame->format != format_ || frame->sample_rate != rate_ ||
                                      frame->ch_layout.nb_channels != encoder_->ch_layout.nb_channels);
    if (is_other) throw Error(ErrorKind::kInput, what() + ": its channels or sample rate change midway");
    convert(ended_ ? nullptr : frame.get());
  }

  void feed() {
    const Owned<AVPacket> packet(made(av_packet_alloc()));
    const int code = av_read_frame(source_.file.get(), packet.get());
    if (code != AVERROR_EOF) checked_small_input(code, what());
    if (code >= 0 && packet->stream_index != source_.stream->index) return;
    checked_small_input(avcodec_send_packet(source_.decoder.get(), code == AVERROR_EOF ? nullptr : packet.get()),
                        what());
  }

  std::string path_;
  SoundFile source_;
  Owned<AVCodecContext> encoder_;
  Owned<SwrContext> converter_;
  Owned<AVAudioFifo> fifo_;
  int rate_ = 0, format_ = 0;  // the converter's input
  int64_t position_ = 0;
  bool ended_ = false;
};

// A file's sound packets, copied.
class CopiedSound final : public Sound {
 public:
  CopiedSound(const std::string& path, Container container, const SoundCut& cut)
      : path_(path), cut_(cut), file_(av::open_file(path, what())) {
    const int index = find_sound(*file_, what(), nullptr);
    for (unsigned i = 0; i < file_->nb_streams; i++) file_->streams[i]->discard = AVDISCARD_ALL;
    source_ = file_->streams[index];
    file_->streams[index]->discard = AVDISCARD_DEFAULT;
    const AVOutputFormat* format = av_guess_format(format_name(container), nullptr, nullptr);
    const AVCodecID codec = source_->codecpar->codec_id;
    if (avformat_query_codec(format, codec, FF_COMPLIANCE_NORMAL) == 1) return;
    throw Error(ErrorKind::kInput,
                fmt::format("{} cannot hold sound like that of '{}' ({}): add --audio '{}' to encode it anew",
                            container_name(container), path, avcodec_get_name(codec), path));
  }

  void describe(AVStream& stream) const override {
    checked(avcodec_parameters_copy(stream.codecpar, source_->codecpar), ErrorKind::kOutput, what());
    stream.codecpar->codec_tag = 0;  // the source container's tag
    stream.time_base = source_->time_base;
  }

  Owned<AVPacket> next(double until, bool is_end) override {
    if (is_end && !cut_.is_cut) until = INFINITY;
    if (!waiting_ && !read()) return nullptr;
    if (time() >= until) return nullptr;
    const int64_t start = std::llround(cut_.start / av_q2d(source_->time_base));
    if (waiting_->pts != AV_NOPTS_VALUE) waiting_->pts -= start;
    if (waiting_->dts != AV_NOPTS_VALUE) waiting_->dts -= start;
    waiting_->time_base = source_->time_base;
    waiting_->pos = -1;
    return std::move(waiting_);
  }

 private:
  std::string what() const { return fmt::format("cannot read the sound of '{}'", path_); }

  // The start of the waiting packet, in seconds of the video.
  double time() const {
    const int64_t ticks = waiting_->pts == AV_NOPTS_VALUE ? waiting_->dts : waiting_->pts;
    return ticks == AV_NOPTS_VALUE ? 0.0 : static_cast<double>(ticks) * av_q2d(source_->time_base) - cut_.start;
  }

  bool read() {
    while (!ended_) {
      waiting_.reset(made(av_packet_alloc()));
      const int code = av_read_frame(file_.get(), waiting_.get());
      ended_ = code == AVERROR_EOF;
      if (ended_) break;
      checked_small_input(code, what());
      if (waiting_->stream_index == source_->index && !(cut_.is_cut && time() < 0.0)) return true;
    }
    waiting_.reset();
    return false;
  }

  std::string path_;
  SoundCut cut_;
  Owned<AVFormatContext> file_;
  const AVStream* source_ = nullptr;
  Owned<AVPacket> waiting_;
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<Sound> open_sound(const EncodeOptions& options, Container container) {
  if (options.sound.empty()) return nullptr;
  if (options.copies_sound) return std::make_unique<CopiedSound>(options.sound, container, options.sound_cut);
  return std::make_unique<PackedSound>(options.sound, container);
}

const char* format_name(Container container) {
  return container == Container::kMatroska ? "matroska" : container_name(container).data();
}

}  // namespace ods

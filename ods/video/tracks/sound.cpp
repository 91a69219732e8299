// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/tracks/sound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "ods/base/error.h"
#include "ods/video/tracks/ambisonics.h"

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

// The index of the best stream with sound, and its decoder if `codec` is not null.
static int find_sound(AVFormatContext& file, const std::string& what, const AVCodec** codec) {
  const int index = av_find_best_stream(&file, AVMEDIA_TYPE_AUDIO, -1, -1, codec, 0);
  if (index == AVERROR_STREAM_NOT_FOUND) {
    throw Error(ErrorKind::kInput, fmt::format("{}: it has none; give `audio` a sound file (wav, flac, mp3 ...) or a "
                                               "video with sound, or leave `audio` out",
                                               what));
  }
  return checked_small_input(index, what);
}

static void check_sound(const AVCodecContext& decoder, bool any_channels, const std::string& what) {
  const int channels = decoder.ch_layout.nb_channels, rate = decoder.sample_rate;
  if (!any_channels && channels != 1 && channels != 2 && channels != 4) {
    throw Error(ErrorKind::kInput, fmt::format("{}: it has {} channels; videos have 1, 2, or 4 of first-order "
                                               "ambisonics",
                                               what, channels));
  }
  if (rate < kMinRate || rate > kMaxRate) {
    throw Error(ErrorKind::kInput, fmt::format("{}: it claims {} samples per second", what, rate));
  }
}

// stream: -1 for the best one.
static SoundFile open_sound_file(const std::string& path, int stream, bool any_channels) {
  const std::string what = fmt::format("cannot read the sound of '{}'", path);
  SoundFile sound;
  sound.file = av::open_file(path, what);
  AVFormatContext* file = sound.file.get();
  const AVCodec* codec = nullptr;
  sound.stream = file->streams[stream < 0 ? find_sound(*file, what, &codec) : stream];
  if (codec == nullptr) codec = avcodec_find_decoder(sound.stream->codecpar->codec_id);
  if (codec == nullptr) checked_small_input(AVERROR_DECODER_NOT_FOUND, what);
  for (unsigned i = 0; i < file->nb_streams; i++) {
    file->streams[i]->discard = file->streams[i] == sound.stream ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
  }
  sound.decoder.reset(made(avcodec_alloc_context3(codec)));
  sound.decoder->pkt_timebase = sound.stream->time_base;
  checked_small_input(avcodec_parameters_to_context(sound.decoder.get(), sound.stream->codecpar), what);
  checked_small_input(avcodec_open2(sound.decoder.get(), codec, nullptr), what);
  check_sound(*sound.decoder, any_channels, what);
  return sound;
}

SoundInfo read_sound_info(const std::string& path) {
  const SoundFile sound = open_sound_file(path, -1, false);
  SoundInfo info{sound.decoder->ch_layout.nb_channels, 0.0};
  if (sound.stream->duration > 0) {
    info.seconds = static_cast<double>(sound.stream->duration) * av_q2d(sound.stream->time_base);
  } else if (sound.file->duration > 0) {
    info.seconds = static_cast<double>(sound.file->duration) / AV_TIME_BASE;
  }
  return info;
}

// --- the encoder -----------------------------------------------------------------------------------------------------

// AAC in mp4, PCM in mov, Opus in Matroska.
static const char* usual_encoder(Container container) {
  return container == Container::kMp4 ? "aac" : container == Container::kMov ? "pcm_s24le" : "libopus";
}

// The name of the encoder for a codec, or null. libavcodec's own Opus and Vorbis are worse.
static const char* encoder_for(AVCodecID codec) {
  if (codec == AV_CODEC_ID_OPUS) return "libopus";
  if (codec == AV_CODEC_ID_VORBIS) return "libvorbis";
  const AVCodec* encoder = avcodec_find_encoder(codec);
  return encoder == nullptr ? nullptr : encoder->name;
}

namespace {

// The sound that an encoder has to accept.
struct SoundForm {
  AVChannelLayout layout{};  // a copy, without memory of its own
  int rate = kSoundRate;
  int64_t bit_rate = 0;  // bit rate of the usual encoder
  AVCodecID own_codec = AV_CODEC_ID_NONE;
  int64_t own_bit_rate = 0;  // 0 if unknown
  bool is_ambisonic = false;
};

}  // namespace

// Returns null if this encoder does not support the sound, or the container does not support the encoder.
static Owned<AVCodecContext> try_encoder(const char* name, Container container, const SoundForm& form) {
  const AVCodec* codec = name == nullptr ? nullptr : avcodec_find_encoder_by_name(name);
  if (codec == nullptr || !can_hold(container, codec->id)) return nullptr;
  // With other numbers of channels, AAC filters one of them as a subwoofer channel.
  if (form.is_ambisonic && codec->id == AV_CODEC_ID_AAC && form.layout.nb_channels != 4) return nullptr;
  const bool is_opus = codec->id == AV_CODEC_ID_OPUS;
  for (const AVSampleFormat format : {AV_SAMPLE_FMT_FLTP, AV_SAMPLE_FMT_FLT, AV_SAMPLE_FMT_S32, AV_SAMPLE_FMT_S16}) {
    Owned<AVCodecContext> context(made(avcodec_alloc_context3(codec)));
    context->sample_rate = is_opus ? kSoundRate : form.rate;
    context->sample_fmt = format;
    const bool is_own = codec->id == form.own_codec && form.own_bit_rate > 0;
    context->bit_rate = is_own ? form.own_bit_rate : form.bit_rate;
    context->time_base = {1, context->sample_rate};
    context->flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;
    context->ch_layout = form.layout;
    // The ambisonics mapping (RFC 8486).
    if (form.is_ambisonic && is_opus) av_opt_set(context->priv_data, "mapping_family", "2", 0);
    if (avcodec_open2(context.get(), codec, nullptr) >= 0) return context;
  }
  return nullptr;
}

static AVChannelLayout usual_layout(int channels) {
  AVChannelLayout layout{};
  av_channel_layout_default(&layout, channels);
  return layout;
}

static Owned<AVCodecContext> open_sound_encoder(const SoundSource& source, const SoundFile& sound,
                                                Container container) {
  const AVCodecContext& in = *sound.decoder;
  const int channels = in.ch_layout.nb_channels;
  const bool is_named = source.any_channels && !source.is_ambisonic && in.ch_layout.order == AV_CHANNEL_ORDER_NATIVE;
  SoundForm form;
  form.layout = is_named ? in.ch_layout : usual_layout(channels);
  form.rate = source.any_channels ? in.sample_rate : kSoundRate;
  form.bit_rate = kSoundBitRate * channels;
  if (source.keeps_codec) form.own_codec = sound.stream->codecpar->codec_id;
  form.own_bit_rate = sound.stream->codecpar->bit_rate;
  form.is_ambisonic = source.is_ambisonic || (!source.any_channels && channels == 4);
  const char* own_encoder = source.keeps_codec ? encoder_for(sound.stream->codecpar->codec_id) : nullptr;
  for (const char* name : {own_encoder, usual_encoder(container), source.any_channels ? "libopus" : nullptr}) {
    if (Owned<AVCodecContext> encoder = try_encoder(name, container, form)) return encoder;
  }
  throw Error(ErrorKind::kUsage,
              fmt::format("this machine's libavcodec cannot encode sound of {} channels for {}, which takes {}",
                          channels, container_name(container), usual_encoder(container)));
}

// --- turning ---------------------------------------------------------------------------------------------------------

namespace {

// Rotates blocks of ambisonic sound, a plane of floats per channel.
class FieldTurn {
 public:
  FieldTurn(const SoundSource& source, int channels)
      : turn_(source.is_ambisonic ? source.turn : SoundTurn()),
        order_(ambisonic_order(channels - source.head_locked)) {}

  explicit operator bool() const { return static_cast<bool>(turn_); }

  // from, to: times of the file at the start and the end of the block.
  void operator()(AVFrame& block, double from, double to) {
    if (matrix_.empty()) matrix_ = at(from);
    const std::vector<double> last = at(to);
    const size_t channels = static_cast<size_t>((order_ + 1) * (order_ + 1));
    std::vector<double> in(channels);
    for (int i = 0; i < block.nb_samples; i++) {
      const double share = (i + 0.5) / block.nb_samples;
      for (size_t c = 0; c < channels; c++) in[c] = static_cast<double>(plane(block, c)[i]);
      for (size_t row = 0; row < channels; row++) {
        double sum = 0.0;
        for (size_t c = 0; c < channels; c++) {
          const double before = matrix_[row * channels + c], after = last[row * channels + c];
          sum += (before + share * (after - before)) * in[c];
        }
        plane(block, row)[i] = static_cast<float>(sum);
      }
    }
    matrix_ = last;
  }

 private:
  static float* plane(AVFrame& block, size_t channel) { return reinterpret_cast<float*>(block.extended_data[channel]); }

  // The matrix at a time. Most rotations are constant.
  const std::vector<double>& at(double seconds) {
    const glm::dmat3 turn = turn_(seconds);
    if (known_.empty() || turn != last_) known_ = ambisonic_turn(order_, turn), last_ = turn;
    return known_;
  }

  SoundTurn turn_;
  int order_ = 0;
  glm::dmat3 last_{0.0};
  std::vector<double> known_, matrix_;  // matrices of last_; at the end of the last block
};

// A file's sound, decoded and encoded again. In between it is planes of floats if it is rotated, else in the encoder's
// format.
class PackedSound final : public SideTracks {
 public:
  PackedSound(const SoundSource& source, Container container)
      : source_(source),
        sound_(open_sound_file(source.path, source.stream, source.any_channels)),
        encoder_(open_sound_encoder(source, sound_, container)),
        turn_(source, encoder_->ch_layout.nb_channels) {
    AVCodecContext &in = *sound_.decoder, &out = *encoder_;
    rate_ = in.sample_rate;
    format_ = in.sample_fmt;
    middle_ = turn_ ? AV_SAMPLE_FMT_FLTP : out.sample_fmt;
    converter_ = make_converter(in.sample_fmt, in.sample_rate, middle_);
    if (middle_ != out.sample_fmt) packer_ = make_converter(middle_, out.sample_rate, out.sample_fmt);
    fifo_.reset(made(av_audio_fifo_alloc(middle_, out.ch_layout.nb_channels, out.sample_rate)));
  }

  void add_to(AVFormatContext& file) override {
    AVStream* stream = made(avformat_new_stream(&file, nullptr));
    checked(avcodec_parameters_from_context(stream->codecpar, encoder_.get()), ErrorKind::kOutput, what());
    stream->time_base = encoder_->time_base;
    index_ = stream->index;
  }

  Owned<AVPacket> next(double until, bool is_end) override {
    Owned<AVPacket> packet(made(av_packet_alloc()));
    for (;;) {
      const int code = avcodec_receive_packet(encoder_.get(), packet.get());
      if (code == AVERROR_EOF) return nullptr;
      if (code != AVERROR(EAGAIN)) {
        checked(code, ErrorKind::kOutput, what());
        packet->time_base = encoder_->time_base;
        packet->stream_index = index_;
        return packet;
      }
      const Owned<AVFrame> frame = samples(std::llround(until * encoder_->sample_rate), is_end);
      if (!frame && !is_end) return nullptr;
      checked(avcodec_send_frame(encoder_.get(), frame.get()), ErrorKind::kOutput, what());
    }
  }

 private:
  Owned<SwrContext> make_converter(AVSampleFormat from, int rate, AVSampleFormat to) const {
    AVCodecContext& out = *encoder_;
    SwrContext* converter = nullptr;
    // Channels keep their order, regardless of the layout that the file declares.
    checked_small_input(
        swr_alloc_set_opts2(&converter, &out.ch_layout, to, out.sample_rate, &out.ch_layout, from, rate, 0, nullptr),
        what());
    Owned<SwrContext> owned(converter);
    checked_small_input(swr_init(converter), what());
    return owned;
  }

  // The next samples up to a position; null at the end. Encoders need full frames except for the last.
  Owned<AVFrame> samples(int64_t until, bool is_end) {
    const int64_t size = encoder_->frame_size > 0 ? encoder_->frame_size : 1024, maximum = until - position_;
    if (maximum < size && !is_end) return nullptr;
    while (!ended_ && av_audio_fifo_size(fifo_.get()) < size) decode();
    if (is_first_) begin();
    const int64_t count = std::min<int64_t>({size, until - position_, av_audio_fifo_size(fifo_.get())});
    if (count <= 0) return nullptr;
    Owned<AVFrame> frame = make_frame(static_cast<int>(count), middle_);
    av_audio_fifo_read(fifo_.get(), reinterpret_cast<void**>(frame->extended_data), static_cast<int>(count));
    if (turn_) turn_(*frame, file_time(position_), file_time(position_ + count));
    if (packer_) frame = packed(*frame);
    frame->pts = position_;
    position_ += count;
    return frame;
  }

  // Positions the first sample: samples before the video's beginning are dropped.
  void begin() {
    is_first_ = false;
    const int64_t first = std::llround((start_ - source_.cut.start) * encoder_->sample_rate);
    position_ = std::max<int64_t>(first, 0);
    for (int64_t before = std::max<int64_t>(-first, 0); before > 0;) {
      while (!ended_ && av_audio_fifo_size(fifo_.get()) == 0) decode();
      const int count = static_cast<int>(std::min<int64_t>(before, av_audio_fifo_size(fifo_.get())));
      if (count == 0) return;
      av_audio_fifo_drain(fifo_.get(), count);
      before -= count;
    }
    while (!ended_ && av_audio_fifo_size(fifo_.get()) < std::max(encoder_->frame_size, 1024)) decode();
  }

  double file_time(int64_t position) const {
    return static_cast<double>(position) / encoder_->sample_rate + source_.cut.start;
  }

  std::string what() const { return fmt::format("cannot read the sound of '{}'", source_.path); }

  Owned<AVFrame> make_frame(int samples, AVSampleFormat format) const {
    Owned<AVFrame> frame(made(av_frame_alloc()));
    frame->nb_samples = samples;
    frame->format = format;
    frame->sample_rate = encoder_->sample_rate;
    checked(av_channel_layout_copy(&frame->ch_layout, &encoder_->ch_layout), ErrorKind::kMemory, what());
    checked(av_frame_get_buffer(frame.get(), 0), ErrorKind::kMemory, what());
    return frame;
  }

  Owned<AVFrame> packed(const AVFrame& frame) const {
    Owned<AVFrame> out = make_frame(frame.nb_samples, encoder_->sample_fmt);
    checked_small_input(swr_convert(packer_.get(), out->extended_data, frame.nb_samples,
                                    const_cast<const uint8_t**>(frame.extended_data), frame.nb_samples),
                        what());
    return out;
  }

  // in: null to flush the converter.
  void convert(const AVFrame* in) {
    const int count = in == nullptr ? 0 : in->nb_samples;
    const Owned<AVFrame> out = make_frame(std::max(swr_get_out_samples(converter_.get(), count), 1), middle_);
    const auto from = in == nullptr ? nullptr : const_cast<const uint8_t**>(in->extended_data);
    const int got =
        checked_small_input(swr_convert(converter_.get(), out->extended_data, out->nb_samples, from, count), what());
    checked(av_audio_fifo_write(fifo_.get(), reinterpret_cast<void**>(out->extended_data), got), ErrorKind::kMemory,
            what());
  }

  void decode() {
    const Owned<AVFrame> frame(made(av_frame_alloc()));
    const int code = avcodec_receive_frame(sound_.decoder.get(), frame.get());
    if (code == AVERROR(EAGAIN)) return feed();
    ended_ = code == AVERROR_EOF;
    if (!ended_) checked_small_input(code, what());
    const bool is_other = !ended_ && (frame->format != format_ || frame->sample_rate != rate_ ||
                                      frame->ch_layout.nb_channels != encoder_->ch_layout.nb_channels);
    if (is_other) throw Error(ErrorKind::kInput, what() + ": its channels or sample rate change midway");
    if (!ended_ && !has_begun_ && source_.any_channels && frame->pts != AV_NOPTS_VALUE) {
      start_ = static_cast<double>(frame->pts) * av_q2d(sound_.stream->time_base);
    }
    has_begun_ = true;
    convert(ended_ ? nullptr : frame.get());
  }

  void feed() {
    const Owned<AVPacket> packet(made(av_packet_alloc()));
    const int code = av_read_frame(sound_.file.get(), packet.get());
    if (code != AVERROR_EOF) checked_small_input(code, what());
    if (code >= 0 && packet->stream_index != sound_.stream->index) return;
    checked_small_input(avcodec_send_packet(sound_.decoder.get(), code == AVERROR_EOF ? nullptr : packet.get()),
                        what());
  }

  SoundSource source_;
  SoundFile sound_;
  Owned<AVCodecContext> encoder_;
  FieldTurn turn_;
  Owned<SwrContext> converter_, packer_;  // to the intermediate format; from there to the encoder's
  Owned<AVAudioFifo> fifo_;
  AVSampleFormat middle_ = AV_SAMPLE_FMT_NONE;
  int index_ = -1;             // index of the stream
  int rate_ = 0, format_ = 0;  // the converter's input
  double start_ = 0.0;         // time of the first sample, in seconds of the file
  int64_t position_ = 0;
  bool has_begun_ = false, is_first_ = true, ended_ = false;
};

}  // namespace

std::unique_ptr<SideTracks> pack_sound(const SoundSource& source, Container container) {
  return std::make_unique<PackedSound>(source, container);
}

const char* format_name(Container container) {
  return container == Container::kMatroska ? "matroska" : container_name(container).data();
}

bool can_hold(Container container, int codec) {
  const bool is_pcm = codec >= AV_CODEC_ID_PCM_S16LE && codec < AV_CODEC_ID_ADPCM_IMA_QT;
  if (is_pcm && container == Container::kMp4) return false;
  const AVOutputFormat* format = av_guess_format(format_name(container), nullptr, nullptr);
  return avformat_query_codec(format, static_cast<AVCodecID>(codec), FF_COMPLIANCE_NORMAL) == 1;
}

}  // namespace ods

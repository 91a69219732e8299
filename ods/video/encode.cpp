// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/encode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <new>

#include "ods/base/error.h"
#include "ods/base/read_file.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/audio_fifo.h>
#include <libavutil/opt.h>
#include <libswresample/swresample.h>
}

namespace ods {

// --- the encoders ----------------------------------------------------------------------------------------------------

bool has_encoder(std::string_view name) {
  return avcodec_find_encoder_by_name(std::string(name).c_str()) != nullptr;
}

// The one that is asked for, or the first that there is and that can.
static const EncoderFacts& choose_encoder(const EncodeOptions& options) {
  const Packing& packing = options.packing;
  std::string wanted, others;
  for (const EncoderFacts& facts : known_encoders()) {
    const bool fits = facts.codec == packing.codec && (packing.chroma == Chroma::k420 || !facts.only_420) &&
                      (options.encoder.empty() || options.encoder == facts.name);
    const bool is_there = has_encoder(facts.name);
    if (fits && is_there) return facts;
    if (fits) wanted += fmt::format("{}{}", wanted.empty() ? "" : " or ", facts.name);
    if (is_there) {
      others += fmt::format("{}{} ({})", others.empty() ? "" : ", ", film_codec_name(facts.codec), facts.name);
    }
  }
  throw Error(ErrorKind::kInput,
              fmt::format("this machine cannot encode {} {}{}: it has {}", film_codec_name(packing.codec),
                          chroma_name(packing.chroma), wanted.empty() ? "" : ", which takes " + wanted,
                          others.empty() ? "no encoder that ods knows" : others));
}

static AVPixelFormat pixel_format(const Packing& packing) {
  constexpr AVPixelFormat kFormats[][2] = {{AV_PIX_FMT_YUV420P, AV_PIX_FMT_YUV420P10},
                                           {AV_PIX_FMT_YUV422P, AV_PIX_FMT_YUV422P10},
                                           {AV_PIX_FMT_YUV444P, AV_PIX_FMT_YUV444P10}};
  return kFormats[static_cast<size_t>(packing.chroma)][packing.bits > 8 ? 1 : 0];
}

// --- what goes wrong -------------------------------------------------------------------------------------------------

// The last complaint of the library, which would go to the console.
static std::mutex complaint_mutex;
static std::string complaint;

static void listen(void* source, int level, const char* format, va_list words) {
  if (level > AV_LOG_ERROR) return;
  char line[512];
  int start_of_line = 1;
  av_log_format_line2(source, level, format, words, line, sizeof(line), &start_of_line);
  const std::lock_guard<std::mutex> lock(complaint_mutex);
  complaint = line;
  while (complaint.ends_with('\n')) complaint.pop_back();
}

static std::string words_for(int code) {
  const std::lock_guard<std::mutex> lock(complaint_mutex);
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof(text));
  std::string words = complaint.empty() ? text : fmt::format("{} ({})", text, complaint);
  complaint.clear();
  return words;
}

// Zero and above is well.
static int checked(int code, ErrorKind kind, const std::string& what) {
  if (code >= 0) return code;
  if (code == AVERROR(ENOMEM)) kind = ErrorKind::kMemory;
  throw Error(kind, fmt::format("{}: {}", what, words_for(code)));
}

template <typename T>
static T* made(T* object) {
  if (object == nullptr) throw std::bad_alloc();
  return object;
}

struct Free {
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwrContext* context) const { swr_free(&context); }
  void operator()(AVAudioFifo* fifo) const { av_audio_fifo_free(fifo); }
  void operator()(AVFormatContext* context) const {
    if (context->iformat != nullptr) return avformat_close_input(&context);
    avio_closep(&context->pb);
    avformat_free_context(context);
  }
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

// --- the frames ------------------------------------------------------------------------------------------------------

// The same pixels as the library has them; they go when it is done with them.
static Owned<AVFrame> wrapped(const std::shared_ptr<const FilmFrame>& frame, const AVCodecContext& context,
                              int64_t number) {
  Owned<AVFrame> result(made(av_frame_alloc()));
  result->width = context.width;
  result->height = context.height;
  result->format = context.pix_fmt;
  result->color_range = context.color_range;
  result->colorspace = context.colorspace;
  result->color_primaries = context.color_primaries;
  result->color_trc = context.color_trc;
  result->chroma_location = context.chroma_sample_location;
  result->sample_aspect_ratio = context.sample_aspect_ratio;
  result->pts = number;
  for (size_t i = 0; i < 3; i++) {
    result->data[i] = reinterpret_cast<uint8_t*>(frame->planes().first[i]);
    result->linesize[i] = static_cast<int>(frame->planes().stride[i]);
  }
  using Owner = std::shared_ptr<const FilmFrame>;
  const auto release = [](void* owner, uint8_t*) { delete static_cast<Owner*>(owner); };
  auto owner = std::make_unique<Owner>(frame);
  result->buf[0] = made(av_buffer_create(result->data[0], frame->bytes(), release, owner.get(), 0));
  static_cast<void>(owner.release());
  return result;
}

// --- the pictures' encoder -------------------------------------------------------------------------------------------

static void set(AVCodecContext& context, std::string_view name, const std::string& value) {
  checked(av_opt_set(context.priv_data, std::string(name).c_str(), value.c_str(), 0), ErrorKind::kInput,
          fmt::format("{} does not know {}={}", context.codec->name, name, value));
}

// Closed groups of about a second: what seeks finds a picture that stands alone.
static void set_groups(AVCodecContext& context, const EncodeOptions& options) {
  context.gop_size = std::max(1, static_cast<int>(std::lround(options.rate.value())));
  context.flags |= AV_CODEC_FLAG_CLOSED_GOP;
}

static void set_quality(AVCodecContext& context, const EncoderFacts& facts, const EncodeOptions& options) {
  if (!options.preset.empty() &&
      fmt::format(" {} ", facts.presets).find(" " + options.preset + " ") == std::string::npos) {
    throw Error(ErrorKind::kInput,
                fmt::format("{} has the presets {}, not '{}'", facts.name, facts.presets, options.preset));
  }
  if (!facts.preset_option.empty()) {
    set(context, facts.preset_option, options.preset.empty() ? std::string(facts.preset) : options.preset);
  }
  if (facts.worst_quality == 0) return set(context, "profile", options.packing.chroma == Chroma::k444 ? "4444" : "hq");
  if (options.bitrate) {
    context.bit_rate = std::llround(*options.bitrate * 1e6);
  } else {
    set(context, "crf", std::to_string(options.packing.quality.value_or(facts.quality)));
  }
}

static void set_own_words(AVCodecContext& context, const EncoderFacts& facts, const EncodeOptions& options) {
  const std::string_view name = facts.name;
  const Extent size{context.width, context.height};
  if (name == "libx264" && smallest_level(Codec::kH264, size, options.rate.value()) > "5.2") {
    set(context, "x264-params", "mvrange=511");  // else the decoders of early headsets show rubbish
  }
  if (name == "libx265") {  // which speaks to the console by itself
    std::string words = "log-level=none:open-gop=0";
    if (options.threads > 0) words += fmt::format(":pools={}", options.threads);
    set(context, "x265-params", words);
  }
  if (name == "libaom-av1" || name == "libvpx-vp9") set(context, "row-mt", "1");
  if (name == "libvpx-vp9") {
    set(context, "deadline", "good");
    set(context, "tile-columns", "2");
  }
}

static Owned<AVCodecContext> open_encoder(Extent size, const EncodeOptions& options, bool header_apart) {
  av_log_set_callback(listen);
  const EncoderFacts& facts = choose_encoder(options);
  const AVCodec* codec = avcodec_find_encoder_by_name(std::string(facts.name).c_str());
  Owned<AVCodecContext> context(made(avcodec_alloc_context3(codec)));
  context->width = size.width;
  context->height = size.height;
  context->pix_fmt = pixel_format(options.packing);
  context->sample_aspect_ratio = {1, 1};
  context->time_base = {options.rate.seconds, options.rate.count};
  context->framerate = {options.rate.count, options.rate.seconds};
  context->color_range = AVCOL_RANGE_MPEG;
  context->color_primaries = AVCOL_PRI_BT709;
  context->color_trc = AVCOL_TRC_BT709;
  context->colorspace = AVCOL_SPC_BT709;
  context->chroma_sample_location =
      options.packing.chroma == Chroma::k420 ? AVCHROMA_LOC_LEFT : AVCHROMA_LOC_UNSPECIFIED;
  context->thread_count = options.threads;
  context->flags |= AV_CODEC_FLAG_BITEXACT;
  if (header_apart) context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  set_groups(*context, options);
  set_quality(*context, facts, options);
  set_own_words(*context, facts, options);
  checked(avcodec_open2(context.get(), codec, nullptr), ErrorKind::kInput,
          fmt::format("{} cannot encode {}x{} pixels of {} bits, {}", facts.name, size.width, size.height,
                      options.packing.bits, chroma_name(options.packing.chroma)));
  return context;
}

// --- sound -----------------------------------------------------------------------------------------------------------

constexpr int kSoundRate = 48000;
constexpr int64_t kSoundBitRate = 128000;  // of a channel

struct SoundFile {
  Owned<AVFormatContext> file;
  Owned<AVCodecContext> decoder;
  const AVStream* stream = nullptr;
};

static SoundFile open_sound(const std::string& path) {
  av_log_set_callback(listen);
  const std::string what = fmt::format("cannot read the sound of '{}'", path);
  static_cast<void>(file_size(path));  // that it is a file, and no address
  SoundFile sound;
  AVFormatContext* file = nullptr;
  AVDictionary* only_files = nullptr;
  av_dict_set(&only_files, "protocol_whitelist", "file", 0);
  const int opened = avformat_open_input(&file, ("file:" + path).c_str(), nullptr, &only_files);
  av_dict_free(&only_files);
  checked(opened, ErrorKind::kInput, what);
  sound.file.reset(file);
  checked(avformat_find_stream_info(file, nullptr), ErrorKind::kInput, what);
  const AVCodec* codec = nullptr;
  const int index = av_find_best_stream(file, AVMEDIA_TYPE_AUDIO, -1, -1, &codec, 0);
  checked(index, ErrorKind::kInput, what);
  sound.stream = file->streams[index];
  sound.decoder.reset(made(avcodec_alloc_context3(codec)));
  sound.decoder->pkt_timebase = sound.stream->time_base;
  checked(avcodec_parameters_to_context(sound.decoder.get(), sound.stream->codecpar), ErrorKind::kInput, what);
  checked(avcodec_open2(sound.decoder.get(), codec, nullptr), ErrorKind::kInput, what);
  const int channels = sound.decoder->ch_layout.nb_channels;
  if (channels != 1 && channels != 2 && channels != 4) {
    throw Error(ErrorKind::kInput, fmt::format("{}: it has {} channels; films have 1, 2, or 4 of first-order "
                                               "ambisonics",
                                               what, channels));
  }
  return sound;
}

SoundInfo read_sound_info(const std::string& path) {
  const SoundFile sound = open_sound(path);
  SoundInfo info{sound.decoder->ch_layout.nb_channels, 0.0};
  if (sound.stream->duration > 0) {
    info.seconds = static_cast<double>(sound.stream->duration) * av_q2d(sound.stream->time_base);
  } else if (sound.file->duration > 0) {
    info.seconds = static_cast<double>(sound.file->duration) / AV_TIME_BASE;
  }
  return info;
}

// AAC in mp4, unpacked in mov, Opus in Matroska.
static Owned<AVCodecContext> open_sound_encoder(Container container, int channels) {
  const char* name = container == Container::kMp4 ? "aac" : container == Container::kMov ? "pcm_s24le" : "libopus";
  const AVCodec* codec = avcodec_find_encoder_by_name(name);
  if (codec == nullptr) {
    throw Error(ErrorKind::kInput, fmt::format("this machine's libavcodec has no {}, which sound in {} takes", name,
                                               container_name(container)));
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
  if (channels == 4 && container != Container::kMp4 && container != Container::kMov) {
    set(*context, "mapping_family", "2");  // which is that of ambisonics (RFC 8486)
  }
  checked(avcodec_open2(context.get(), codec, nullptr), ErrorKind::kInput,
          fmt::format("{} cannot encode the sound", name));
  return context;
}

// Of a file, in the samples of an encoder.
class Sound {
 public:
  Sound(const std::string& path, Container container)
      : path_(path),
        source_(open_sound(path)),
        encoder_(open_sound_encoder(container, source_.decoder->ch_layout.nb_channels)) {
    AVCodecContext &in = *source_.decoder, &out = *encoder_;
    SwrContext* converter = nullptr;
    // The channels keep their order whatever the file calls them.
    checked(swr_alloc_set_opts2(&converter, &out.ch_layout, out.sample_fmt, out.sample_rate, &out.ch_layout,
                                in.sample_fmt, in.sample_rate, 0, nullptr),
            ErrorKind::kInput, what());
    converter_.reset(converter);
    checked(swr_init(converter), ErrorKind::kInput, what());
    fifo_.reset(made(av_audio_fifo_alloc(out.sample_fmt, out.ch_layout.nb_channels, kSoundRate)));
  }

  AVCodecContext& encoder() const { return *encoder_; }

  // The next samples up to a position; none at the end. Encoders take no fewer than they like but the last time.
  Owned<AVFrame> next(int64_t until, bool is_end) {
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

 private:
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

  // null: what the converter still holds.
  void convert(const AVFrame* in) {
    const int count = in == nullptr ? 0 : in->nb_samples;
    const Owned<AVFrame> out = make_frame(std::max(swr_get_out_samples(converter_.get(), count), 1));
    const auto from = in == nullptr ? nullptr : const_cast<const uint8_t**>(in->extended_data);
    const int got =
        checked(swr_convert(converter_.get(), out->data, out->nb_samples, from, count), ErrorKind::kInput, what());
    checked(av_audio_fifo_write(fifo_.get(), reinterpret_cast<void**>(out->data), got), ErrorKind::kMemory, what());
  }

  void decode() {
    const Owned<AVFrame> frame(made(av_frame_alloc()));
    const int code = avcodec_receive_frame(source_.decoder.get(), frame.get());
    if (code == AVERROR(EAGAIN)) return feed();
    ended_ = code == AVERROR_EOF;
    if (!ended_) checked(code, ErrorKind::kInput, what());
    convert(ended_ ? nullptr : frame.get());
  }

  void feed() {
    const Owned<AVPacket> packet(made(av_packet_alloc()));
    const int code = av_read_frame(source_.file.get(), packet.get());
    if (code != AVERROR_EOF) checked(code, ErrorKind::kInput, what());
    if (code >= 0 && packet->stream_index != source_.stream->index) return;
    checked(avcodec_send_packet(source_.decoder.get(), code == AVERROR_EOF ? nullptr : packet.get()), ErrorKind::kInput,
            what());
  }

  std::string path_;
  SoundFile source_;
  Owned<AVCodecContext> encoder_;
  Owned<SwrContext> converter_;
  Owned<AVAudioFifo> fifo_;
  int64_t position_ = 0;
  bool ended_ = false;
};

// --- the film --------------------------------------------------------------------------------------------------------

// Ends an encoder whose film is given up. SVT-AV1 waits for ever when it is closed before it has seen an end, and it
// sees none before a picture.
static void abandon(AVCodecContext& encoder, const Packing& packing, bool is_new) {
  if (encoder.codec->name != std::string_view("libsvtav1")) return;
  const Extent size{encoder.width, encoder.height};
  if (is_new) avcodec_send_frame(&encoder, wrapped(std::make_shared<FilmFrame>(size, packing), encoder, 0).get());
  avcodec_send_frame(&encoder, nullptr);
  const Owned<AVPacket> packet(made(av_packet_alloc()));
  while (avcodec_receive_packet(&encoder, packet.get()) >= 0) {
  }
}

void check_encoder(Container container, const EncodeOptions& options) {
  assert(can_hold(container, options.packing.codec));
  abandon(*open_encoder({256, 256}, options, false), options.packing, true);
  if (!options.sound.empty()) Sound(options.sound, container);
}

struct FilmEncoder::State {
  std::string path;  // for messages
  EncodeOptions options;
  Owned<AVFormatContext> file;
  Owned<AVCodecContext> pictures;
  std::unique_ptr<Sound> sound;
  int64_t count = 0;  // of frames
  bool finished = false;

  ~State() {
    if (pictures && !finished) abandon(*pictures, options.packing, count == 0);
  }

  int written(int code) const { return checked(code, ErrorKind::kOutput, fmt::format("cannot write '{}'", path)); }

  AVStream& add_stream(const AVCodecContext& encoder) {
    AVStream* stream = made(avformat_new_stream(file.get(), nullptr));
    written(avcodec_parameters_from_context(stream->codecpar, &encoder));
    stream->time_base = encoder.time_base;
    return *stream;
  }

  // null: there are no more.
  void encode(AVCodecContext& encoder, const AVFrame* frame, int stream) {
    checked(avcodec_send_frame(&encoder, frame), ErrorKind::kOutput, fmt::format("cannot encode '{}'", path));
    const Owned<AVPacket> packet(made(av_packet_alloc()));
    for (;;) {
      const int code = avcodec_receive_packet(&encoder, packet.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
      checked(code, ErrorKind::kOutput, fmt::format("cannot encode '{}'", path));
      if (stream == 0 && packet->duration == 0) packet->duration = 1;
      packet->stream_index = stream;
      av_packet_rescale_ts(packet.get(), encoder.time_base, file->streams[stream]->time_base);
      written(av_interleaved_write_frame(file.get(), packet.get()));
    }
  }

  // Sound goes along with the pictures.
  void encode_sound(bool is_end) {
    if (!sound) return;
    const int64_t until = std::llround(static_cast<double>(count) / options.rate.value() * kSoundRate);
    while (const Owned<AVFrame> frame = sound->next(until, is_end)) {
      encode(sound->encoder(), frame.get(), 1);
    }
  }
};

static const char* format_name(Container container) {
  return container == Container::kMatroska ? "matroska" : container_name(container).data();
}

FilmEncoder::FilmEncoder(const AtomicFile& to, Container container, Extent size, const EncodeOptions& options)
    : state_(std::make_unique<State>()) {
  assert(can_hold(container, options.packing.codec));
  State& state = *state_;
  state.path = to.path();
  state.options = options;
  const std::string address = "file:" + to.temporary();
  AVFormatContext* file = nullptr;
  state.written(avformat_alloc_output_context2(&file, nullptr, format_name(container), address.c_str()));
  state.file.reset(file);
  file->flags |= AVFMT_FLAG_BITEXACT;
  state.pictures = open_encoder(size, options, (file->oformat->flags & AVFMT_GLOBALHEADER) != 0);
  AVStream& stream = state.add_stream(*state.pictures);
  stream.avg_frame_rate = state.pictures->framerate;
  stream.sample_aspect_ratio = {1, 1};
  const bool has_boxes = container == Container::kMp4 || container == Container::kMov;
  if (has_boxes && options.packing.codec == FilmCodec::kHevc) {
    stream.codecpar->codec_tag = MKTAG('h', 'v', 'c', '1');  // Apple plays no other
  }
  if (!options.sound.empty()) {
    state.sound = std::make_unique<Sound>(options.sound, container);
    state.add_stream(state.sound->encoder());
  }
  if (has_boxes) av_opt_set(file->priv_data, "movflags", "+faststart+write_colr", 0);
  state.written(avio_open(&file->pb, address.c_str(), AVIO_FLAG_WRITE));
  state.written(avformat_write_header(file, nullptr));
}

FilmEncoder::~FilmEncoder() = default;

void FilmEncoder::add(std::shared_ptr<const FilmFrame> frame) {
  State& state = *state_;
  state.encode(*state.pictures, wrapped(frame, *state.pictures, state.count).get(), 0);
  state.count++;
  state.encode_sound(false);
}

void FilmEncoder::finish() {
  State& state = *state_;
  state.encode(*state.pictures, nullptr, 0);
  state.finished = true;
  state.encode_sound(true);
  if (state.sound) state.encode(state.sound->encoder(), nullptr, 1);
  state.written(av_write_trailer(state.file.get()));
  state.written(avio_closep(&state.file->pb));
}

}  // namespace ods

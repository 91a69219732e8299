// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/encode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <map>
#include <thread>

#include "ods/base/error.h"
#include "ods/video/tracks/av.h"
#include "ods/video/tracks/kept_tracks.h"
#include "ods/video/tracks/sound.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/cpu.h>
#include <libavutil/mastering_display_metadata.h>
#include <libavutil/opt.h>
}

// libnuma, which x265 asks to keep its threads near their memory, prints where it cannot: without /sys, in many
// containers. A program may define these two (numa(3)); a library of ours prints nothing.
extern "C" void numa_error(char*) {}
extern "C" void numa_warn(int, char*, ...) {}

namespace ods {

using av::checked, av::made, av::Owned;

// --- the encoders ----------------------------------------------------------------------------------------------------

bool has_encoder(std::string_view name) {
  return avcodec_find_encoder_by_name(std::string(name).c_str()) != nullptr;
}

// The requested encoder, or the first available one that can encode this.
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
      others += fmt::format("{}{} ({})", others.empty() ? "" : ", ", video_codec_name(facts.codec), facts.name);
    }
  }
  throw Error(ErrorKind::kUsage,
              fmt::format("this machine cannot encode {} {}{}: it has {}", video_codec_name(packing.codec),
                          chroma_name(packing.chroma), wanted.empty() ? "" : ", which needs " + wanted,
                          others.empty() ? "no encoder that ods supports" : others));
}

static AVPixelFormat pixel_format(const Packing& packing) {
  constexpr AVPixelFormat kFormats[][2] = {{AV_PIX_FMT_YUV420P, AV_PIX_FMT_YUV420P10},
                                           {AV_PIX_FMT_YUV422P, AV_PIX_FMT_YUV422P10},
                                           {AV_PIX_FMT_YUV444P, AV_PIX_FMT_YUV444P10}};
  return kFormats[static_cast<size_t>(packing.chroma)][packing.bits > 8 ? 1 : 0];
}

// --- the frames ------------------------------------------------------------------------------------------------------

// Wraps our pixels for libavcodec without copying; released when the library is done with them.
static Owned<AVFrame> wrapped(const std::shared_ptr<const VideoFrame>& frame, const AVCodecContext& context,
                              const FrameTime& time) {
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
  result->pts = time.start;
#if LIBAVUTIL_VERSION_INT >= AV_VERSION_INT(57, 30, 100)
  result->duration = time.duration;
#else
  result->pkt_duration = time.duration;
#endif
  for (size_t i = 0; i < 3; i++) {
    result->data[i] = reinterpret_cast<uint8_t*>(frame->planes().first[i]);
    result->linesize[i] = static_cast<int>(frame->planes().stride[i]);
  }
  using Owner = std::shared_ptr<const VideoFrame>;
  const auto release = [](void* owner, uint8_t*) { delete static_cast<Owner*>(owner); };
  auto owner = std::make_unique<Owner>(frame);
  result->buf[0] = made(av_buffer_create(result->data[0], frame->bytes(), release, owner.get(), 0));
  static_cast<void>(owner.release());
  return result;
}

// --- the pictures' encoder -------------------------------------------------------------------------------------------

static void set(AVCodecContext& context, std::string_view name, const std::string& value) {
  checked(av_opt_set(context.priv_data, std::string(name).c_str(), value.c_str(), 0), ErrorKind::kUsage,
          fmt::format("{} does not know {}={}", context.codec->name, name, value));
}

static void set_clock(AVCodecContext& context, const EncodeOptions& options) {
  const FrameRate &rate = options.rate, clock = options.clock.value_or(rate);
  context.time_base = {clock.seconds, clock.count};
  context.framerate = {rate.count, rate.seconds};
#if LIBAVCODEC_VERSION_MAJOR < 61  // libvpx and libaom use this as the duration of each picture
  context.ticks_per_frame = std::max(1, static_cast<int>(std::lround(clock.value() / rate.value())));
#endif
}

static void set_colors(AVCodecContext& context, const EncodeOptions& options) {
  const ColorWords& words = options.words;
  context.color_range = options.color.has_full_range ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
  context.color_primaries = static_cast<AVColorPrimaries>(words.primaries);
  context.color_trc = static_cast<AVColorTransferCharacteristic>(words.transfer);
  context.colorspace = static_cast<AVColorSpace>(words.matrix);
  context.chroma_sample_location = options.packing.chroma == Chroma::k420
                                       ? static_cast<AVChromaLocation>(words.chroma_place)
                                       : AVCHROMA_LOC_UNSPECIFIED;
}

// About a second, so that every seek finds a key frame.
int key_interval(const FrameRate& rate) {
  return std::max(1, static_cast<int>(std::lround(rate.value())));
}

static void set_groups(AVCodecContext& context, const EncodeOptions& options) {
  context.gop_size = key_interval(options.rate);
  context.flags |= AV_CODEC_FLAG_CLOSED_GOP;
}

static void set_quality(AVCodecContext& context, const EncoderFacts& facts, const EncodeOptions& options) {
  if (!options.preset.empty() &&
      fmt::format(" {} ", facts.presets).find(" " + options.preset + " ") == std::string::npos) {
    throw Error(ErrorKind::kUsage,
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

// x265's largest block. For frames of a single block it reads uninitialized memory, so its output differs from run to
// run; such frames get smaller blocks.
static int largest_block(const AVCodecContext& context) {
  const int side = std::max(context.width, context.height);
  return side > 64 ? 64 : side > 32 ? 32 : 16;
}

// For such pictures, x264 needs a hundred megabytes or more for each one that it encodes or looks ahead at.
static bool is_large(const AVCodecContext& context) {
  return static_cast<int64_t>(context.width) * context.height > 6'000'000;
}

static int processors_for(const EncodeOptions& options) {
  return options.threads > 0 ? options.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// The threads of x265's pool. With fewer than four, its lookahead searches in another way and the output differs; more
// than 64 become several pools. If x265 is not told their number, it asks libnuma, which counts no processors where
// /sys is missing; x265 then does without a pool, and the output differs again.
static int x265_pool(const EncodeOptions& options) {
  return std::clamp(processors_for(options), 4, 64);
}

// The output must not depend on the number of threads. x264's output depends on its thread count, so that is fixed;
// x265's on the number of frames in flight, and on a busy machine it differs from run to run if there are several.
// libvpx's and libaom's differ between one thread and several. SVT-AV1's and ProRes's do not depend on it.
static void set_threads(AVCodecContext& context, const EncoderFacts& facts, const EncodeOptions& options) {
  const int x264_threads = is_large(context) ? 6 : 12;
  context.thread_count = options.threads;
  if (facts.name == "libx264") context.thread_count = x264_threads;
  if (facts.name == "libx265") context.thread_count = 1;
  if (facts.name == "libaom-av1" || facts.name == "libvpx-vp9") {
    context.thread_count = std::clamp(processors_for(options), 2, 64);
  }
}

// The light metadata of HDR pictures, which is also in the stream's own messages, in the syntax of x264, x265 and
// SVT-AV1. Units of the first two: 1/50,000 of a chromaticity and 1/10,000 of a candela per square metre.
namespace {

struct LightMetadata {
  std::string display, level;  // empty if unspecified
};

}  // namespace

static LightMetadata light_metadata(const ColorWords& words, bool in_units) {
  LightMetadata result;
  AVMasteringDisplayMetadata display;
  if (words.mastering_display.size() == sizeof display) {
    std::memcpy(&display, words.mastering_display.data(), sizeof display);
    const auto value = [&](AVRational number, int unit) {
      const double plain = number.den == 0 ? 0.0 : av_q2d(number);
      return in_units ? fmt::format("{}", std::llround(plain * unit)) : fmt::format("{:.6g}", plain);
    };
    const auto place = [&](const AVRational* xy) { return value(xy[0], 50000) + "," + value(xy[1], 50000); };
    result.display = fmt::format("G({})B({})R({})WP({})L({},{})", place(display.display_primaries[1]),
                                 place(display.display_primaries[2]), place(display.display_primaries[0]),
                                 place(display.white_point), value(display.max_luminance, 10000),
                                 value(display.min_luminance, 10000));
  }
  AVContentLightMetadata level;
  if (words.light_level.size() == sizeof level) {
    std::memcpy(&level, words.light_level.data(), sizeof level);
    result.level = fmt::format("{},{}", level.MaxCLL, level.MaxFALL);
  }
  return result;
}

// ":NAME=VALUE" for each existing value.
static std::string light_options(const LightMetadata& light, std::string_view display, std::string_view level) {
  std::string text;
  if (!light.display.empty()) text += fmt::format(":{}={}", display, light.display);
  if (!light.level.empty()) text += fmt::format(":{}={}", level, light.level);
  return text;
}

static std::string light_options(std::string_view encoder, const ColorWords& words) {
  if (encoder == "libx264") return light_options(light_metadata(words, true), "mastering-display", "cll");
  if (encoder == "libx265") return light_options(light_metadata(words, true), "master-display", "max-cll");
  if (encoder == "libsvtav1") return light_options(light_metadata(words, false), "mastering-display", "content-light");
  return "";
}

// x264's code for AVX-512 reads uninitialized memory, so its output differs from run to run, observed up to 320x160.
static bool has_avx512() {
#if defined(__x86_64__)
  return (av_get_cpu_flags() & AV_CPU_FLAG_AVX512) != 0;
#else
  return false;
#endif
}

static void set_codec_options(AVCodecContext& context, const EncoderFacts& facts, const EncodeOptions& options) {
  const std::string_view name = facts.name;
  const Extent size{context.width, context.height};
  const std::string light = light_options(name, options.words);
  if (name == "libx264") {
    const bool is_fast = smallest_level(Codec::kH264, size, options.rate.value()) > "5.2";
    // Without this the decoders of early headsets show garbage.
    const std::string words = std::string(is_fast ? ":mvrange=511" : "") + (has_avx512() ? ":asm=AVX2" : "") + light;
    if (!words.empty()) set(context, "x264-params", words.substr(1));
  }
  if (name == "libsvtav1" && !light.empty()) set(context, "svtav1-params", light.substr(1));
  if (name == "libx264" && options.preset.empty() && is_large(context)) set(context, "rc-lookahead", "20");
  if (name == "libx265") {                                          // logs to the console on its own
    const char* const kQuiet = "log-level=none:open-gop=0:info=0";  // its info SEI would contain the thread count
    set(context, "x265-params",
        fmt::format("{}:pools={}:ctu={}{}", kQuiet, x265_pool(options), largest_block(context), light));
  }
  if (name == "libaom-av1" || name == "libvpx-vp9") set(context, "row-mt", "1");
  if (name == "libvpx-vp9") {
    set(context, "deadline", "good");
    set(context, "tile-columns", "2");
  }
}

static Owned<AVCodecContext> open_encoder(Extent size, const EncodeOptions& options, bool header_apart) {
  av::keep_complaints();
  const EncoderFacts& facts = choose_encoder(options);
  const AVCodec* codec = avcodec_find_encoder_by_name(std::string(facts.name).c_str());
  Owned<AVCodecContext> context(made(avcodec_alloc_context3(codec)));
  context->width = size.width;
  context->height = size.height;
  context->pix_fmt = pixel_format(options.packing);
  context->sample_aspect_ratio = {1, 1};
  set_clock(*context, options);
  set_colors(*context, options);
  context->flags |= AV_CODEC_FLAG_BITEXACT;
  if (header_apart) context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  set_groups(*context, options);
  set_quality(*context, facts, options);
  set_threads(*context, facts, options);
  set_codec_options(*context, facts, options);
  checked(avcodec_open2(context.get(), codec, nullptr), ErrorKind::kUsage,
          fmt::format("{} cannot encode {}x{} pixels of {} bits, {}", facts.name, size.width, size.height,
                      options.packing.bits, chroma_name(options.packing.chroma)));
  return context;
}

// --- the video -------------------------------------------------------------------------------------------------------

// Ends an encoder whose video is abandoned. SVT-AV1 hangs on close unless it was flushed, and cannot be flushed before
// its first picture.
static void abandon(AVCodecContext& encoder, const Packing& packing, bool is_new) {
  if (encoder.codec->name != std::string_view("libsvtav1")) return;
  const Extent size{encoder.width, encoder.height};
  if (is_new) avcodec_send_frame(&encoder, wrapped(std::make_shared<VideoFrame>(size, packing), encoder, {}).get());
  avcodec_send_frame(&encoder, nullptr);
  const Owned<AVPacket> packet(made(av_packet_alloc()));
  while (avcodec_receive_packet(&encoder, packet.get()) >= 0) {
  }
}

static std::vector<std::unique_ptr<SideTracks>> open_side_tracks(const EncodeOptions& options, Container container) {
  std::vector<std::unique_ptr<SideTracks>> tracks;
  if (!options.keep.path.empty()) tracks.push_back(keep_tracks(options.keep, container));
  if (!options.sound.empty()) tracks.push_back(pack_sound({options.sound}, container));
  return tracks;
}

void check_encoder(Container container, const EncodeOptions& options) {
  assert(can_hold(container, options.packing.codec));
  abandon(*open_encoder({256, 256}, options, false), options.packing, true);
  open_side_tracks(options, container);
}

// Adds the light metadata of an HDR video to the container.
static void add_light(AVStream& stream, AVPacketSideDataType kind, const std::string& bytes) {
  if (bytes.empty()) return;
#if LIBAVCODEC_VERSION_INT >= AV_VERSION_INT(60, 31, 102)
  AVCodecParameters& facts = *stream.codecpar;
  const AVPacketSideData* data =
      av_packet_side_data_new(&facts.coded_side_data, &facts.nb_coded_side_data, kind, bytes.size(), 0);
  uint8_t* to = made(data)->data;
#else
  uint8_t* to = made(av_stream_new_side_data(&stream, kind, bytes.size()));
#endif
  std::copy(bytes.begin(), bytes.end(), to);
}

struct VideoEncoder::State {
  std::string path;  // for messages
  EncodeOptions options;
  Extent size;
  Owned<AVFormatContext> file;
  Owned<AVCodecContext> pictures;  // null between two parts
  AVRational tick{0, 1};
  std::vector<std::unique_ptr<SideTracks>> others;
  int64_t count = 0;                     // frames of this part so far
  int64_t end = 0;                       // over all pictures so far
  int64_t decoded = INT64_MIN;           // decode time of the last picture
  std::map<int64_t, int64_t> durations;  // durations of the frames in the encoder, by start time
  std::function<void(const EncodedPicture&)> keep;

  ~State() {
    if (pictures) abandon(*pictures, options.packing, count == 0);
  }

  void open_pictures() {
    pictures = open_encoder(size, options, (file->oformat->flags & AVFMT_GLOBALHEADER) != 0);
    tick = pictures->time_base;
    count = 0;
  }

  int written(int code) const { return checked(code, ErrorKind::kOutput, fmt::format("cannot write '{}'", path)); }

  AVStream& add_stream(const AVCodecContext& encoder) {
    AVStream* stream = made(avformat_new_stream(file.get(), nullptr));
    written(avcodec_parameters_from_context(stream->codecpar, &encoder));
    stream->time_base = encoder.time_base;
    return *stream;
  }

  // frame: null at the end of the video.
  void encode(const AVFrame* frame) {
    AVCodecContext& encoder = *pictures;
    checked(avcodec_send_frame(&encoder, frame), ErrorKind::kOutput, fmt::format("cannot encode '{}'", path));
    const Owned<AVPacket> packet(made(av_packet_alloc()));
    for (;;) {
      const int code = avcodec_receive_packet(&encoder, packet.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
      checked(code, ErrorKind::kOutput, fmt::format("cannot encode '{}'", path));
      const auto told = durations.find(packet->pts);
      if (told != durations.end()) packet->duration = told->second, durations.erase(told);
      if (packet->duration == 0) packet->duration = 1;
      if (keep) {
        const std::string_view bytes(reinterpret_cast<const char*>(packet->data), static_cast<size_t>(packet->size));
        keep({packet->pts, packet->dts, packet->duration, packet->flags, bytes});
      }
      write(*packet);
    }
  }

  void end_pictures() {
    if (pictures && count > 0) encode(nullptr);
    if (pictures && count == 0) abandon(*pictures, options.packing, true);
    pictures.reset();
  }

  // The decode times of the first pictures of a part may precede those of the last ones of the previous part.
  void write(AVPacket& packet) {
    end = std::max(end, packet.pts + packet.duration);
    if (packet.dts != AV_NOPTS_VALUE && decoded != INT64_MIN) packet.dts = std::max(packet.dts, decoded + 1);
    decoded = packet.dts;
    const int64_t until = packet.dts;
    packet.stream_index = 0;
    av_packet_rescale_ts(&packet, tick, file->streams[0]->time_base);
    written(av_interleaved_write_frame(file.get(), &packet));
    add_others(until, false);
  }

  // Adds the packets of the other tracks up to this time.
  void add_others(int64_t ticks, bool is_end) {
    const double until = static_cast<double>(ticks) * av_q2d(tick);
    for (const auto& tracks : others) {
      while (const Owned<AVPacket> packet = tracks->next(until, is_end)) {
        av_packet_rescale_ts(packet.get(), packet->time_base,
                             file->streams[static_cast<size_t>(packet->stream_index)]->time_base);
        written(av_interleaved_write_frame(file.get(), packet.get()));
      }
    }
  }
};

VideoEncoder::VideoEncoder(const AtomicFile& to, Container container, Extent size, const EncodeOptions& options)
    : state_(std::make_unique<State>()) {
  assert(can_hold(container, options.packing.codec));
  State& state = *state_;
  state.path = to.path();
  state.options = options;
  state.size = size;
  const std::string address = "file:" + to.temporary();
  AVFormatContext* file = nullptr;
  state.written(avformat_alloc_output_context2(&file, nullptr, format_name(container), address.c_str()));
  state.file.reset(file);
  file->flags |= AVFMT_FLAG_BITEXACT;
  state.open_pictures();
  AVStream& stream = state.add_stream(*state.pictures);
  stream.avg_frame_rate = state.pictures->framerate;
  stream.sample_aspect_ratio = {1, 1};
  add_light(stream, AV_PKT_DATA_MASTERING_DISPLAY_METADATA, options.words.mastering_display);
  add_light(stream, AV_PKT_DATA_CONTENT_LIGHT_LEVEL, options.words.light_level);
  if (has_boxes(container) && options.packing.codec == VideoCodec::kHevc) {
    stream.codecpar->codec_tag = MKTAG('h', 'v', 'c', '1');  // the only tag that Apple's players accept
  }
  state.others = open_side_tracks(options, container);
  for (const auto& tracks : state.others) tracks->add_to(*file);
  if (has_boxes(container)) av_opt_set(file->priv_data, "movflags", "+faststart+write_colr", 0);
  state.written(avio_open(&file->pb, address.c_str(), AVIO_FLAG_WRITE));
  state.written(avformat_write_header(file, nullptr));
}

VideoEncoder::~VideoEncoder() = default;

void VideoEncoder::add(std::shared_ptr<const VideoFrame> frame, const FrameTime& time) {
  State& state = *state_;
  if (!state.pictures) state.open_pictures();
  state.durations[time.start] = time.duration;
  state.encode(wrapped(frame, *state.pictures, time).get());
  state.count++;
}

void VideoEncoder::keep(std::function<void(const EncodedPicture&)> take) {
  state_->keep = std::move(take);
}

void VideoEncoder::end_part() {
  state_->end_pictures();
}

void VideoEncoder::add(const EncodedPicture& picture) {
  const Owned<AVPacket> packet(made(av_packet_alloc()));
  if (av_new_packet(packet.get(), static_cast<int>(picture.bytes.size())) < 0) throw std::bad_alloc();
  std::copy(picture.bytes.begin(), picture.bytes.end(), packet->data);
  packet->pts = picture.shown, packet->dts = picture.decoded;
  packet->duration = picture.duration, packet->flags = picture.flags;
  state_->write(*packet);
}

std::string VideoEncoder::header() const {
  const AVCodecParameters& facts = *state_->file->streams[0]->codecpar;
  return {reinterpret_cast<const char*>(facts.extradata), static_cast<size_t>(facts.extradata_size)};
}

void VideoEncoder::finish() {
  State& state = *state_;
  state.end_pictures();
  state.add_others(state.end, true);
  state.written(av_write_trailer(state.file.get()));
  state.written(avio_closep(&state.file->pb));
}

}  // namespace ods

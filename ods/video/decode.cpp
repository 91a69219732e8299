// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/decode.h"

#include <fmt/format.h>

#include <cmath>

#include "ods/base/error.h"
#include "ods/video/av.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/pixdesc.h>
}

namespace ods {

using av::checked, av::made, av::Owned;

// --- what the video says ---------------------------------------------------------------------------------------------

static std::optional<VideoCodec> codec_of(AVCodecID id) {
  switch (id) {
    case AV_CODEC_ID_H264:
      return VideoCodec::kH264;
    case AV_CODEC_ID_HEVC:
      return VideoCodec::kHevc;
    case AV_CODEC_ID_AV1:
      return VideoCodec::kAv1;
    case AV_CODEC_ID_VP9:
      return VideoCodec::kVp9;
    case AV_CODEC_ID_PRORES:
      return VideoCodec::kProRes;
    default:
      return std::nullopt;
  }
}

static const uint8_t* display_matrix(const AVStream& stream) {
#if LIBAVCODEC_VERSION_INT >= AV_VERSION_INT(60, 31, 102)
  const AVPacketSideData* data = av_packet_side_data_get(
      stream.codecpar->coded_side_data, stream.codecpar->nb_coded_side_data, AV_PKT_DATA_DISPLAYMATRIX);
  return data == nullptr ? nullptr : data->data;
#else
  return av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
#endif
}

static bool is_turned(const AVStream& stream) {
  const uint8_t* matrix = display_matrix(stream);
  if (matrix == nullptr) return false;
  const double angle = av_display_rotation_get(reinterpret_cast<const int32_t*>(matrix));
  return std::isfinite(angle) && std::abs(angle) > 0.5;
}

// Reads the pixel format. Returns why it is unsupported; empty if it is supported.
static std::string read_format(AVPixelFormat format, VideoStream& stream) {
  const AVPixFmtDescriptor* descriptor = av_pix_fmt_desc_get(format);
  const std::string name = descriptor == nullptr ? "unknown" : descriptor->name;
  const uint64_t kUnfit = AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_BE | AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_FLOAT |
                          AV_PIX_FMT_FLAG_BITSTREAM | AV_PIX_FMT_FLAG_HWACCEL;
  const bool fits = descriptor != nullptr && (descriptor->flags & AV_PIX_FMT_FLAG_PLANAR) != 0 &&
                    (descriptor->flags & kUnfit) == 0 && descriptor->nb_components >= 3 &&
                    descriptor->comp[1].plane == 1 && descriptor->comp[2].plane == 2 &&
                    descriptor->comp[0].shift == 0 && descriptor->comp[0].depth >= 8;
  const int shape = fits ? descriptor->log2_chroma_w * 2 + descriptor->log2_chroma_h : -1;
  if (shape != 3 && shape != 2 && shape != 0) return fmt::format("its pixels are {}, not planes of Y'CbCr", name);
  stream.chroma = shape == 3 ? Chroma::k420 : shape == 2 ? Chroma::k422 : Chroma::k444;
  stream.bits = descriptor->comp[0].depth;
  stream.has_alpha = descriptor->nb_components == 4;
  return "";
}

static std::string read_color(const AVCodecParameters& stream, ColorCode& color) {
  const AVColorTransferCharacteristic curve = stream.color_trc;
  if (curve == AVCOL_TRC_SMPTE2084 || curve == AVCOL_TRC_ARIB_STD_B67) {
    return fmt::format("it is HDR ({}); ods supports BT.709", av_color_transfer_name(curve));
  }
  const AVColorSpace space = stream.color_space;
  const bool old = space == AVCOL_SPC_SMPTE170M || space == AVCOL_SPC_BT470BG || space == AVCOL_SPC_FCC;
  if (space != AVCOL_SPC_UNSPECIFIED && space != AVCOL_SPC_BT709 && !old) {
    return fmt::format("its colour matrix is {}; ods supports BT.709 and BT.601", av_color_space_name(space));
  }
  // Players choose an unspecified matrix by the size.
  color.is_601 = old || (space == AVCOL_SPC_UNSPECIFIED && stream.height < 720);
  color.has_full_range = stream.color_range == AVCOL_RANGE_JPEG || stream.format == AV_PIX_FMT_YUVJ420P ||
                         stream.format == AV_PIX_FMT_YUVJ422P || stream.format == AV_PIX_FMT_YUVJ444P;
  return "";
}

static AVRational rate_of(const AVStream& stream) {
  const AVRational rate = stream.avg_frame_rate.num > 0 ? stream.avg_frame_rate : stream.r_frame_rate;
  return rate.num > 0 && rate.den > 0 && av_q2d(rate) >= 0.1 && av_q2d(rate) <= 1000.0 ? rate : AVRational{0, 1};
}

// --- decoding --------------------------------------------------------------------------------------------------------

struct VideoDecoder::State {
  std::string what;  // for messages
  VideoStream stream;
  Owned<AVFormatContext> file;
  const AVStream* source = nullptr;
  Owned<AVCodecContext> decoder;
  int64_t count = 0;  // frames so far

  [[noreturn]] void fail(const std::string& why) const {
    throw Error(ErrorKind::kInput, fmt::format("{}: {}", what, why));
  }

  // Some demuxers number tracks differently: then use the stream that FFmpeg ranks best, which is the largest.
  void find_stream(uint64_t track) {
    const int best = av_find_best_stream(file.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (best == AVERROR_STREAM_NOT_FOUND) fail("FFmpeg finds no pictures in it; the file may be damaged or unfinished");
    checked(best, ErrorKind::kInput, what);
    source = file->streams[best];
    for (unsigned i = 0; i < file->nb_streams; i++) {
      const AVStream* each = file->streams[i];
      const bool has_pictures = each->codecpar->codec_type == AVMEDIA_TYPE_VIDEO;
      if (has_pictures && static_cast<uint64_t>(each->id) == track) source = each;
    }
    for (unsigned i = 0; i < file->nb_streams; i++) {
      AVStream* each = file->streams[i];
      each->discard = each == source ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
    }
  }

  void read_facts() {
    const AVCodecParameters& facts = *source->codecpar;
    stream.size = {facts.width, facts.height};
    stream.codec = codec_of(facts.codec_id);
    const AVRational rate = rate_of(*source);
    if (rate.num == 0) fail("it does not state its frame rate");
    stream.rate = {rate.num, rate.den};
    if (is_turned(*source))
      fail("its pictures are stored rotated; ffmpeg -i VIDEO -c:a copy UPRIGHT turns them upright");
    std::string fault = read_format(static_cast<AVPixelFormat>(facts.format), stream);
    if (fault.empty()) fault = read_color(facts, stream.color);
    if (!fault.empty()) fail(fault);
    const Extent block = chroma_block(stream.chroma);
    if (stream.size.width < block.width || stream.size.height < block.height || stream.size.width % block.width != 0 ||
        stream.size.height % block.height != 0) {
      fail(fmt::format("{}x{} pixels with chroma {}: its sides are odd", stream.size.width, stream.size.height,
                       chroma_name(stream.chroma)));
    }
    if (source->start_time != AV_NOPTS_VALUE) {
      stream.start = static_cast<double>(source->start_time) * av_q2d(source->time_base);
    }
    const double seconds = source->duration > 0 ? static_cast<double>(source->duration) * av_q2d(source->time_base)
                                                : static_cast<double>(file->duration) / AV_TIME_BASE;
    const double frames = source->nb_frames > 0 ? static_cast<double>(source->nb_frames) : seconds * av_q2d(rate);
    stream.count = frames > 0.0 && frames < 1e9 ? static_cast<int>(std::lround(frames)) : 0;
  }

  void open_decoder(int threads) {
    const AVCodecParameters& facts = *source->codecpar;
    const AVCodec* codec = avcodec_find_decoder(facts.codec_id);
    const AVDictionaryEntry* alpha = av_dict_get(source->metadata, "alpha_mode", nullptr, 0);
    const AVCodec* other = facts.codec_id == AV_CODEC_ID_VP9 ? avcodec_find_decoder_by_name("libvpx-vp9") : nullptr;
    if (alpha != nullptr && other != nullptr) codec = other;  // FFmpeg's own decoder drops alpha
    if (codec == nullptr) fail(fmt::format("this machine has no decoder for {}", avcodec_get_name(facts.codec_id)));
    decoder.reset(made(avcodec_alloc_context3(codec)));
    checked(avcodec_parameters_to_context(decoder.get(), &facts), ErrorKind::kInput, what);
    decoder->pkt_timebase = source->time_base;
    decoder->thread_count = threads;
    decoder->thread_type = FF_THREAD_FRAME | FF_THREAD_SLICE;
    checked(avcodec_open2(decoder.get(), codec, nullptr), ErrorKind::kInput, what);
    if (alpha != nullptr && other != nullptr) stream.has_alpha = true;
  }

  // False at the end of the stream.
  bool receive(AVFrame& frame) {
    const Owned<AVPacket> packet(made(av_packet_alloc()));
    for (;;) {
      const int got = avcodec_receive_frame(decoder.get(), &frame);
      if (got == AVERROR_EOF) return false;
      if (got != AVERROR(EAGAIN)) return checked(got, ErrorKind::kInput, what) >= 0;
      const int code = av_read_frame(file.get(), packet.get());
      if (code != AVERROR_EOF) checked(code, ErrorKind::kInput, what);
      if (code >= 0 && packet->stream_index != source->index) {
        av_packet_unref(packet.get());
        continue;
      }
      const int sent = avcodec_send_packet(decoder.get(), code == AVERROR_EOF ? nullptr : packet.get());
      checked(sent, ErrorKind::kInput, fmt::format("{}: picture {}", what, count));
      av_packet_unref(packet.get());
    }
  }

  void check(const AVFrame& frame) {
    const Extent size{frame.width, frame.height};
    VideoStream own;
    const std::string fault = read_format(static_cast<AVPixelFormat>(frame.format), own);
    if (!fault.empty()) fail(fault);
    if (size.width != stream.size.width || size.height != stream.size.height || own.bits != stream.bits ||
        own.chroma != stream.chroma || own.has_alpha != stream.has_alpha) {
      fail(fmt::format("picture {} has another format than the first", count));
    }
    if (frame.decode_error_flags != 0) fail(fmt::format("picture {} is damaged", count));
    if (frame.best_effort_timestamp == AV_NOPTS_VALUE) return;
    const double time = static_cast<double>(frame.best_effort_timestamp) * av_q2d(source->time_base);
    if (count == 0) stream.start = time;
    const double due = stream.start + static_cast<double>(count) / stream.rate.value();
    if (std::abs(time - due) * stream.rate.value() < 0.75) return;
    fail(
        fmt::format("its frame times are uneven: frame {} is at {:.3f} s, not {:.3f}; ffmpeg -i VIDEO -r {:.4g} "
                    "EVEN makes them even",
                    count, time, due, stream.rate.value()));
  }
};

VideoDecoder::VideoDecoder(const std::string& path, uint64_t track, int threads) : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.what = fmt::format("cannot read '{}'", path);
  state.file = av::open_file(path, state.what);
  state.find_stream(track);
  state.read_facts();
  state.open_decoder(threads);
}

VideoDecoder::~VideoDecoder() = default;

const VideoStream& VideoDecoder::stream() const {
  return state_->stream;
}

std::optional<DecodedFrame> VideoDecoder::next() {
  State& state = *state_;
  const std::shared_ptr<AVFrame> frame(made(av_frame_alloc()), av::Free());
  if (!state.receive(*frame)) return std::nullopt;
  state.check(*frame);
  state.count++;
  DecodedFrame result;
  result.planes.bits = state.stream.bits;
  result.planes.chroma = state.stream.chroma;
  for (size_t i = 0; i < 3; i++) {
    result.planes.first[i] = reinterpret_cast<std::byte*>(frame->data[i]);
    if (frame->linesize[i] < 0) state.fail("its rows are stored upside down");
    result.planes.stride[i] = static_cast<size_t>(frame->linesize[i]);
  }
  if (state.stream.has_alpha) {
    result.alpha = reinterpret_cast<const std::byte*>(frame->data[3]);
    result.alpha_stride = static_cast<size_t>(frame->linesize[3]);
  }
  result.memory = frame;
  return result;
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/decode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "ods/base/error.h"
#include "ods/video/interleaved.h"
#include "ods/video/joined_tracks.h"
#include "ods/video/tracks/av.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/frame.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
#include <libavutil/stereo3d.h>
}

namespace ods {

using av::checked, av::made, av::Owned;

// --- the stream's properties -----------------------------------------------------------------------------------------

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

// Side data of this kind that the container has for the stream; empty if there is none.
static std::string side_data(const AVStream& stream, AVPacketSideDataType kind) {
#if LIBAVCODEC_VERSION_INT >= AV_VERSION_INT(60, 31, 102)
  const AVPacketSideData* data =
      av_packet_side_data_get(stream.codecpar->coded_side_data, stream.codecpar->nb_coded_side_data, kind);
  return data == nullptr ? "" : std::string(reinterpret_cast<const char*>(data->data), data->size);
#else
  size_t size = 0;
  const uint8_t* data = av_stream_get_side_data(&stream, kind, &size);
  return data == nullptr ? "" : std::string(reinterpret_cast<const char*>(data), size);
#endif
}

// Side data of this kind in a picture; empty if there is none.
static std::string side_data(const AVFrame& frame, AVFrameSideDataType kind) {
  const AVFrameSideData* data = av_frame_get_side_data(&frame, kind);
  return data == nullptr ? "" : std::string(reinterpret_cast<const char*>(data->data), data->size);
}

namespace {

// The rotation of the picture for display.
enum class Turn { kNone, kHalf, kOther };

}  // namespace

static Turn turn_of(const AVStream& stream) {
  const std::string bytes = side_data(stream, AV_PKT_DATA_DISPLAYMATRIX);
  int32_t matrix[9];
  if (bytes.size() != sizeof matrix) return Turn::kNone;
  std::memcpy(matrix, bytes.data(), sizeof matrix);
  const double angle = std::abs(av_display_rotation_get(matrix));
  const bool is_mirrored = 1.0 * matrix[0] * matrix[4] - 1.0 * matrix[1] * matrix[3] < 0.0;
  if (!std::isfinite(angle)) return Turn::kNone;
  if (is_mirrored) return Turn::kOther;
  return angle < 0.5 ? Turn::kNone : angle > 179.5 ? Turn::kHalf : Turn::kOther;
}

// Reads the pixel format. Returns the reason why it is unsupported; empty if it is supported.
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
  if (shape != 3 && shape != 2 && shape != 0) {
    return fmt::format(
        "its pixels are {}, not planes of Y'CbCr: make it frames (ffmpeg -i FILE 'x.%04d.png'), or a video of such "
        "planes (ffmpeg -i FILE -c:v ffv1 -pix_fmt yuv444p10le FILE.mkv)",
        name);
  }
  stream.chroma = shape == 3 ? Chroma::k420 : shape == 2 ? Chroma::k422 : Chroma::k444;
  stream.bits = descriptor->comp[0].depth;
  stream.has_alpha = descriptor->nb_components == 4;
  return "";
}

static std::string read_color(const AVCodecParameters& facts, VideoStream& stream) {
  AVColorSpace space = facts.color_space;
  // Players choose an unspecified matrix by the size.
  if (space == AVCOL_SPC_UNSPECIFIED) space = facts.height < 720 ? AVCOL_SPC_SMPTE170M : AVCOL_SPC_BT709;
  const bool is_601 = space == AVCOL_SPC_SMPTE170M || space == AVCOL_SPC_BT470BG || space == AVCOL_SPC_FCC;
  if (space != AVCOL_SPC_BT709 && space != AVCOL_SPC_BT2020_NCL && !is_601) {
    return fmt::format("its colour matrix is {}; ods supports BT.709, BT.601 and BT.2020", av_color_space_name(space));
  }
  stream.color.matrix = is_601 ? YcbcrMatrix::k601 : space == AVCOL_SPC_BT709 ? YcbcrMatrix::k709 : YcbcrMatrix::k2020;
  stream.color.has_full_range = facts.color_range == AVCOL_RANGE_JPEG || facts.format == AV_PIX_FMT_YUVJ420P ||
                                facts.format == AV_PIX_FMT_YUVJ422P || facts.format == AV_PIX_FMT_YUVJ444P;
  stream.words.matrix = space;
  if (facts.color_primaries != AVCOL_PRI_UNSPECIFIED) stream.words.primaries = facts.color_primaries;
  if (facts.color_trc != AVCOL_TRC_UNSPECIFIED) stream.words.transfer = facts.color_trc;
  if (facts.chroma_location != AVCHROMA_LOC_UNSPECIFIED) stream.words.chroma_place = facts.chroma_location;
  return "";
}

static AVRational rate_of(const AVStream& stream) {
  const AVRational rate = stream.avg_frame_rate.num > 0 ? stream.avg_frame_rate : stream.r_frame_rate;
  return rate.num > 0 && rate.den > 0 && av_q2d(rate) >= 0.1 && av_q2d(rate) <= 1000.0 ? rate : AVRational{0, 1};
}

// --- upside down -----------------------------------------------------------------------------------------------------

template <typename T>
static void turn_row(const uint8_t* from, int width, bool is_between, uint8_t* to) {
  const T* in = reinterpret_cast<const T*>(from);
  T* out = reinterpret_cast<T*>(to);
  std::reverse_copy(in, in + width, out);
  if (!is_between) return;
  for (int x = width - 1; x > 0; x--) out[x] = static_cast<T>((out[x - 1] + out[x] + 1) / 2);
}

// Chroma sited at the left one of two pixels would be at the right one after the rotation, so it is interpolated.
static Owned<AVFrame> upright(const AVFrame& from) {
  const AVPixFmtDescriptor& format = *av_pix_fmt_desc_get(static_cast<AVPixelFormat>(from.format));
  Owned<AVFrame> to(made(av_frame_alloc()));
  to->width = from.width, to->height = from.height, to->format = from.format;
  checked(av_frame_get_buffer(to.get(), 0), ErrorKind::kMemory, "cannot turn a picture");
  for (int i = 0; i < format.nb_components; i++) {
    const bool is_chroma = i == 1 || i == 2;
    const int width = is_chroma ? from.width >> format.log2_chroma_w : from.width;
    const int height = is_chroma ? from.height >> format.log2_chroma_h : from.height;
    const auto turn = format.comp[0].depth > 8 ? turn_row<uint16_t> : turn_row<uint8_t>;
    for (int y = 0; y < height; y++) {
      turn(from.data[i] + y * from.linesize[i], width, is_chroma && format.log2_chroma_w > 0,
           to->data[i] + (height - 1 - y) * to->linesize[i]);
    }
  }
  return to;
}

// --- two eyes --------------------------------------------------------------------------------------------------------

bool can_decode_both_views() {
  const AVCodec* codec = avcodec_find_decoder(AV_CODEC_ID_HEVC);
  if (codec == nullptr || codec->priv_class == nullptr) return false;
  const AVClass* options = codec->priv_class;
  return av_opt_find(&options, "view_ids", nullptr, 0, AV_OPT_SEARCH_FAKE_OBJ) != nullptr;
}

// Returns whether the second of two views is the left eye's.
static bool is_left_second(const AVFrame& first, const AVFrame& second, Views views) {
  const auto eye_of = [](const AVFrame& frame) {
    const AVFrameSideData* said = av_frame_get_side_data(&frame, AV_FRAME_DATA_STEREO3D);
    return said == nullptr ? AV_STEREO3D_VIEW_PACKED : reinterpret_cast<const AVStereo3D*>(said->data)->view;
  };
  if (eye_of(first) == AV_STEREO3D_VIEW_LEFT || eye_of(second) == AV_STEREO3D_VIEW_RIGHT) return false;
  if (eye_of(first) == AV_STEREO3D_VIEW_RIGHT || eye_of(second) == AV_STEREO3D_VIEW_LEFT) return true;
  return views == Views::kRightAndLeft;
}

// Joins two views, which have the same format.
static void put_beside(const AVFrame& left, const AVFrame& right, AVFrame& both) {
  checked(av_frame_copy_props(&both, &left), ErrorKind::kMemory, "cannot join two views");
  both.decode_error_flags |= right.decode_error_flags;
  both.width = left.width + right.width, both.height = left.height, both.format = left.format;
  checked(av_frame_get_buffer(&both, 0), ErrorKind::kMemory, "cannot join two views");
  const auto format = static_cast<AVPixelFormat>(left.format);
  const AVPixFmtDescriptor& words = *av_pix_fmt_desc_get(format);
  for (int i = 0; i < words.nb_components; i++) {
    const int bytes = av_image_get_linesize(format, left.width, i);
    const int height = i == 1 || i == 2 ? left.height >> words.log2_chroma_h : left.height;
    av_image_copy_plane(both.data[i], both.linesize[i], left.data[i], left.linesize[i], bytes, height);
    av_image_copy_plane(both.data[i] + bytes, both.linesize[i], right.data[i], right.linesize[i], bytes, height);
  }
}

// H.264's and HEVC's frame packing. Squeezed eyes are what it usually means, as in Matroska.
static std::optional<VideoStereo> packing_of(const AVFrame& frame) {
  constexpr std::pair<AVStereo3DType, EyePacking> kKinds[] = {{AV_STEREO3D_SIDEBYSIDE, EyePacking::kBeside},
                                                              {AV_STEREO3D_TOPBOTTOM, EyePacking::kStacked},
                                                              {AV_STEREO3D_LINES, EyePacking::kRows},
                                                              {AV_STEREO3D_COLUMNS, EyePacking::kColumns},
                                                              {AV_STEREO3D_CHECKERBOARD, EyePacking::kCheckerboard}};
  const AVFrameSideData* said = av_frame_get_side_data(&frame, AV_FRAME_DATA_STEREO3D);
  if (said == nullptr) return std::nullopt;
  const auto& stereo = *reinterpret_cast<const AVStereo3D*>(said->data);
  if (stereo.type == AV_STEREO3D_FRAMESEQUENCE) return VideoStereo::kLaced;
  const bool right_first = (stereo.flags & AV_STEREO3D_FLAG_INVERT) != 0;
  for (const auto& [type, how] : kKinds) {
    if (stereo.type == type) return stereo_with({how, right_first});
  }
  return std::nullopt;
}

// --- decoding --------------------------------------------------------------------------------------------------------

static std::vector<std::string> dropped_metadata(const AVFrame& frame) {
  constexpr std::pair<AVFrameSideDataType, const char*> kKinds[] = {
      {AV_FRAME_DATA_A53_CC, "closed captions in the pictures (CEA-608, CEA-708)"},
      {AV_FRAME_DATA_DYNAMIC_HDR_PLUS, "HDR10+ words in the pictures"},
      {AV_FRAME_DATA_DOVI_RPU_BUFFER, "Dolby Vision words in the pictures"}};
  std::vector<std::string> words;
  for (const auto& [kind, name] : kKinds) {
    if (av_frame_get_side_data(&frame, kind) != nullptr) words.emplace_back(name);
  }
  return words;
}

struct VideoDecoder::State {
  std::string path, what;  // what: for messages
  Views views = Views::kFirst;
  VideoStream stream;
  Extent own_size;                       // size of a picture of the track
  std::unique_ptr<VideoDecoder> joined;  // if are_tracks(views)
  Owned<AVFormatContext> file;
  const AVStream* source = nullptr;
  Owned<AVCodecContext> decoder;
  int64_t count = 0;  // frames so far
  FrameTime last;     // time of the previous frame
  std::shared_ptr<AVFrame> waiting;
  bool has_skipped = false;

  [[noreturn]] void fail(const std::string& why) const {
    throw Error(ErrorKind::kInput, fmt::format("{}: {}", what, why));
  }

  void find_stream(uint64_t track) {
    source = av::pictures_of(*file, path, track);
    if (source == nullptr) fail("FFmpeg finds no pictures in it; the file may be damaged or unfinished");
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
    const Turn turn = turn_of(*source);
    if (turn == Turn::kOther)
      fail("its pictures are stored rotated; ffmpeg -i VIDEO -c:a copy UPRIGHT turns them upright");
    stream.is_upside_down = turn == Turn::kHalf;
    if (facts.field_order != AV_FIELD_UNKNOWN && facts.field_order != AV_FIELD_PROGRESSIVE)
      fail("its pictures are interlaced; ffmpeg -i VIDEO -vf bwdif=mode=send_frame -c:a copy WHOLE joins their fields");
    std::string fault = read_format(static_cast<AVPixelFormat>(facts.format), stream);
    if (fault.empty()) fault = read_color(facts, stream);
    if (!fault.empty()) fail(fault);
    const Extent block = chroma_block(stream.chroma);
    if (stream.size.width < block.width || stream.size.height < block.height || stream.size.width % block.width != 0 ||
        stream.size.height % block.height != 0) {
      fail(fmt::format("{}x{} pixels with chroma {}: its sides are odd", stream.size.width, stream.size.height,
                       chroma_name(stream.chroma)));
    }
    if (has_layers(views)) stream.size.width *= 2;
    own_size = stream.size;
    stream.clock = {source->time_base.den, source->time_base.num};
    if (file->start_time != AV_NOPTS_VALUE) {
      stream.file_start = static_cast<double>(file->start_time) / AV_TIME_BASE;
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
    if (has_layers(views)) {
      const char* all = "-1";
      checked(av_opt_set(decoder->priv_data, "view_ids", all, 0), ErrorKind::kInput, what);
    }
    checked(avcodec_open2(decoder.get(), codec, nullptr), ErrorKind::kInput, what);
    if (alpha != nullptr && other != nullptr) stream.has_alpha = true;
  }

  // Returns false at the end of the stream.
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

  // The views of a picture are consecutive.
  bool receive_both(AVFrame& both) {
    const Owned<AVFrame> first(made(av_frame_alloc())), second(made(av_frame_alloc()));
    if (!receive(*first)) return false;
    if (!receive(*second) || second->pts != first->pts) fail(fmt::format("picture {} has one eye of two", count));
    for (const AVFrame* eye : {first.get(), second.get()}) {
      if (2 * eye->width == stream.size.width && eye->height == stream.size.height && eye->format == first->format)
        continue;
      fail(fmt::format("picture {} has eyes of other sizes or formats than the first", count));
    }
    // The eyes of a frame that is turned later are at opposite sides until then.
    const bool swap = is_left_second(*first, *second, views) != stream.is_upside_down;
    put_beside(swap ? *second : *first, swap ? *first : *second, both);
    return true;
  }

  void check(const AVFrame& frame) {
    const Extent size{frame.width, frame.height};
    VideoStream own;
    const std::string fault = read_format(static_cast<AVPixelFormat>(frame.format), own);
    if (!fault.empty()) fail(fault);
    if (size.width != own_size.width || size.height != own_size.height || own.bits != stream.bits ||
        own.chroma != stream.chroma || own.has_alpha != stream.has_alpha) {
      fail(fmt::format("picture {} has another format than the first", count));
    }
    if (frame.decode_error_flags != 0) fail(fmt::format("picture {} is damaged", count));
  }

  double ticks() const { return stream.clock.value(); }

  FrameTime time_of(const AVFrame& frame) const {
#if LIBAVUTIL_VERSION_INT >= AV_VERSION_INT(57, 30, 100)
    const int64_t duration = frame.duration;
#else
    const int64_t duration = frame.pkt_duration;
#endif
    const int64_t stamp = frame.best_effort_timestamp, usual = std::llround(ticks() / stream.rate.value());
    FrameTime time{stamp, std::max<int64_t>(duration > 0 ? duration : usual, 1)};
    if (stamp == AV_NOPTS_VALUE) time.start = count == 0 ? 0 : last.start + last.duration;
    if (count > 0) time.start = std::max(time.start, last.start + 1);
    return time;
  }

  std::shared_ptr<AVFrame> take() {
    if (waiting) return std::exchange(waiting, nullptr);
    std::shared_ptr<AVFrame> frame(made(av_frame_alloc()), av::Free());
    const bool has_frame = has_layers(views) ? receive_both(*frame) : receive(*frame);
    return has_frame ? frame : nullptr;
  }

  // HEVC has the metadata of its light only in its pictures.
  void read_light() {
    if (!stream.words.is_hdr()) return;
    std::string &display = stream.words.mastering_display, &level = stream.words.light_level;
    display = side_data(*source, AV_PKT_DATA_MASTERING_DISPLAY_METADATA);
    level = side_data(*source, AV_PKT_DATA_CONTENT_LIGHT_LEVEL);
    waiting = take();
    if (!waiting) return;
    if (display.empty()) display = side_data(*waiting, AV_FRAME_DATA_MASTERING_DISPLAY_METADATA);
    if (level.empty()) level = side_data(*waiting, AV_FRAME_DATA_CONTENT_LIGHT_LEVEL);
  }
};

VideoDecoder::VideoDecoder(const std::string& path, uint64_t track, Views views, int threads)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.path = path, state.views = views;
  state.what = fmt::format("cannot read '{}'", path);
  state.file = av::open_file(path, state.what);
  state.find_stream(track);
  state.read_facts();
  state.open_decoder(threads);
  state.read_light();
  if (!are_tracks(views)) return;
  state.joined = std::make_unique<VideoDecoder>(path, other_track(path, track), Views::kFirst, threads);
  state.stream.size = joined_size(state.own_size, views);
}

VideoDecoder::~VideoDecoder() = default;

const VideoStream& VideoDecoder::stream() const {
  return state_->stream;
}

std::optional<DecodedFrame> VideoDecoder::next() {
  State& state = *state_;
  std::shared_ptr<AVFrame> frame = state.take();
  if (!frame) return std::nullopt;
  state.check(*frame);
  DecodedFrame result;
  result.time = state.last = state.time_of(*frame);
  if (state.count == 0) state.stream.unkept = dropped_metadata(*frame);
  if (state.count++ == 0 && !state.has_skipped)
    state.stream.start = static_cast<double>(result.time.start) / state.ticks();
  result.packing = packing_of(*frame);
  if (state.stream.is_upside_down) frame = upright(*frame);
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
  if (state.joined) return join_next(result, state.stream, *state.joined, state.own_size, state.views, state.path);
  return are_interleaved(state.views) ? take_apart(result, state.stream.size, state.views) : result;
}

void VideoDecoder::skip_to(double seconds) {
  State& state = *state_;
  const double kReordered = 1.0;  // seconds: maximum delay from decoding a key frame to showing it
  const double kRounded = 0.5;    // ticks: rounding error of a time
  const int64_t wanted = static_cast<int64_t>(std::ceil(seconds * state.ticks() - kRounded));
  state.has_skipped = true;
  if (state.joined) state.joined->skip_to(seconds);
  const int64_t before = static_cast<int64_t>((seconds - kReordered) * state.ticks());
  if (av_seek_frame(state.file.get(), state.source->index, before, AVSEEK_FLAG_BACKWARD) >= 0) {
    avcodec_flush_buffers(state.decoder.get());
    state.waiting.reset();
    state.last = {std::numeric_limits<int64_t>::min() / 2, 0};  // times ascend from here on: this may be a step back
  }
  while (std::shared_ptr<AVFrame> frame = state.take()) {
    if (state.time_of(*frame).start < wanted) continue;
    state.waiting = std::move(frame);
    return;
  }
}

void refuse_other_colors(const VideoStream& stream, const std::string& path) {
  if (!stream.words.is_hdr() && stream.color.matrix != YcbcrMatrix::k2020) return;
  throw Error(ErrorKind::kInput,
              fmt::format("cannot use '{}': {}; only ods convert, from video to video, supports other colours than "
                          "BT.709's",
                          path, stream.words.is_hdr() ? "it is HDR" : "its colours are BT.2020's"));
}

std::optional<Packing> packing_like(const VideoStream& stream, Container container) {
  const int bits = stream.bits > 8 ? 10 : 8;
  if (!stream.codec || !can_hold(container, *stream.codec) || !can_have(*stream.codec, bits, stream.chroma)) {
    return std::nullopt;
  }
  return Packing{*stream.codec, bits, stream.chroma, {}};
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/tracks/text_track.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "ods/base/error.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/mem.h>
}

namespace ods {

using av::checked_small_input, av::made, av::Owned;

static AVCodecID kind_of(Container container) {
  if (has_boxes(container)) return AV_CODEC_ID_MOV_TEXT;
  return container == Container::kWebm ? AV_CODEC_ID_WEBVTT : AV_CODEC_ID_SUBRIP;
}

// Returns null if it cannot be opened.
static Owned<AVCodecContext> open_text_decoder(const AVStream& from) {
  const AVCodec* codec = avcodec_find_decoder(from.codecpar->codec_id);
  const AVCodecDescriptor* kind = avcodec_descriptor_get(from.codecpar->codec_id);
  if (codec == nullptr || kind == nullptr || (kind->props & AV_CODEC_PROP_TEXT_SUB) == 0) return nullptr;
  Owned<AVCodecContext> decoder(made(avcodec_alloc_context3(codec)));
  decoder->pkt_timebase = from.time_base;
  if (avcodec_parameters_to_context(decoder.get(), from.codecpar) < 0) return nullptr;
  return avcodec_open2(decoder.get(), codec, nullptr) < 0 ? nullptr : std::move(decoder);
}

// The decoder's style sheet becomes the encoder's.
static Owned<AVCodecContext> open_text_encoder(AVCodecID kind, const AVCodecContext& decoder) {
  const AVCodec* codec = avcodec_find_encoder(kind);
  if (codec == nullptr || decoder.subtitle_header == nullptr) return nullptr;
  Owned<AVCodecContext> encoder(made(avcodec_alloc_context3(codec)));
  encoder->time_base = {1, 1000};
  const auto size = static_cast<size_t>(decoder.subtitle_header_size);
  encoder->subtitle_header = static_cast<uint8_t*>(made(av_mallocz(size + 1)));
  std::memcpy(encoder->subtitle_header, decoder.subtitle_header, size);
  encoder->subtitle_header_size = decoder.subtitle_header_size;
  return avcodec_open2(encoder.get(), codec, nullptr) < 0 ? nullptr : std::move(encoder);
}

namespace {

class EncodedText final : public TextTrack {
 public:
  EncodedText(Owned<AVCodecContext> decoder, Owned<AVCodecContext> encoder)
      : decoder_(std::move(decoder)), encoder_(std::move(encoder)) {}

  void describe(AVStream& stream) const override {
    checked_small_input(avcodec_parameters_from_context(stream.codecpar, encoder_.get()), kWhat);
    stream.time_base = encoder_->time_base;
  }

  Owned<AVPacket> encode(const AVPacket& packet) override {
    Owned<AVPacket> copy(made(av_packet_clone(&packet)));
    AVSubtitle text{};
    int is_there = 0;
    checked_small_input(avcodec_decode_subtitle2(decoder_.get(), &text, &is_there, copy.get()), kWhat);
    if (is_there == 0) return nullptr;
    const AVRational milliseconds{1, 1000};
    text.pts = 0;
    text.start_display_time = 0;
    text.end_display_time =
        static_cast<uint32_t>(std::max<int64_t>(av_rescale_q(packet.duration, packet.time_base, milliseconds), 0));
    const int size = text.num_rects == 0 ? 0
                                         : avcodec_encode_subtitle(encoder_.get(), bytes_.data(),
                                                                   static_cast<int>(bytes_.size()), &text);
    avsubtitle_free(&text);
    if (size <= 0) return nullptr;
    Owned<AVPacket> made_packet(made(av_packet_alloc()));
    if (av_new_packet(made_packet.get(), size) < 0) throw std::bad_alloc();
    std::copy_n(bytes_.data(), size, made_packet->data);
    if (av_packet_copy_props(made_packet.get(), &packet) < 0) throw std::bad_alloc();
    return made_packet;
  }

 private:
  static constexpr const char* kWhat = "cannot read the subtitles";
  Owned<AVCodecContext> decoder_, encoder_;
  std::array<uint8_t, 1 << 16> bytes_{};
};

}  // namespace

std::unique_ptr<TextTrack> text_track(const AVStream& from, Container container) {
  Owned<AVCodecContext> decoder = open_text_decoder(from);
  if (!decoder) return nullptr;
  Owned<AVCodecContext> encoder = open_text_encoder(kind_of(container), *decoder);
  if (!encoder) return nullptr;
  return std::make_unique<EncodedText>(std::move(decoder), std::move(encoder));
}

}  // namespace ods

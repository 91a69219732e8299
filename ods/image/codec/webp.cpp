// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// WebP through libwebp; for an animation, the first frame.
#include <webp/decode.h>
#include <webp/demux.h>
#include <webp/encode.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "ods/image/codec/decoder.h"
#include "ods/image/codec/encoder.h"

namespace ods {

// --- reading ---------------------------------------------------------------------------------------------------------

namespace {

// libwebp decodes whole pictures, so this happens on the first read().
class WebpDecoder final : public Decoder {
 public:
  explicit WebpDecoder(const PictureBytes& file);
  void read(int begin, int end, size_t first, size_t count, std::byte* to) override;

 private:
  Error damaged() const { return cannot_read(name_, "the WebP is cut short or damaged"); }
  void decode();
  void decode_first_frame();

  std::string name_;
  std::vector<uint8_t> file_;  // kept until it is decoded
  WebPBitstreamFeatures features_{};
  size_t channels_ = 0;  // channels of pixels_
  std::vector<uint8_t> pixels_;
};

WebpDecoder::WebpDecoder(const PictureBytes& file) : name_(file.name), file_(file.size) {
  if (!file.read(0, file_.data(), file_.size())) throw cannot_read(name_, "reading stopped halfway");
  if (WebPGetFeatures(file_.data(), file_.size(), &features_) != VP8_STATUS_OK) throw damaged();
  info.width = features_.width, info.height = features_.height;
  check_picture_size(file, info.width, info.height);
  info.channels = {"R", "G", "B"};
  if (features_.has_alpha) info.channels.push_back("A");
  info.samples.assign(info.channels.size(), SampleType::kUint8);
  channels_ = features_.has_animation ? 4 : info.channels.size();
}

void WebpDecoder::decode() {
  const size_t row = channels_ * static_cast<size_t>(info.width);
  pixels_.resize(row * static_cast<size_t>(info.height));
  WebPDecoderConfig config;
  if (!WebPInitDecoderConfig(&config)) throw damaged();
  config.options.use_threads = 1;
  config.output.colorspace = channels_ == 4 ? MODE_RGBA : MODE_RGB;
  config.output.is_external_memory = 1;
  config.output.u.RGBA = {pixels_.data(), static_cast<int>(row), pixels_.size()};
  const VP8StatusCode status = WebPDecode(file_.data(), file_.size(), &config);
  WebPFreeDecBuffer(&config.output);
  if (status == VP8_STATUS_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status != VP8_STATUS_OK) throw damaged();
}

void WebpDecoder::decode_first_frame() {
  const WebPData data{file_.data(), file_.size()};
  WebPAnimDecoderOptions options;
  if (!WebPAnimDecoderOptionsInit(&options)) throw damaged();
  options.color_mode = MODE_RGBA;
  const std::unique_ptr<WebPAnimDecoder, void (*)(WebPAnimDecoder*)> frames(WebPAnimDecoderNew(&data, &options),
                                                                            WebPAnimDecoderDelete);
  uint8_t* pixels = nullptr;
  int time = 0;
  if (!frames || !WebPAnimDecoderGetNext(frames.get(), &pixels, &time)) throw damaged();
  pixels_.assign(pixels, pixels + 4 * static_cast<size_t>(info.width) * static_cast<size_t>(info.height));
}

void WebpDecoder::read(int begin, int end, size_t first, size_t count, std::byte* to) {
  if (pixels_.empty()) {
    features_.has_animation ? decode_first_frame() : decode();
    file_ = {};
  }
  const size_t width = static_cast<size_t>(info.width);
  const uint8_t* from = &pixels_[static_cast<size_t>(begin) * width * channels_ + first];
  if (count == channels_) return void(std::memcpy(to, from, static_cast<size_t>(end - begin) * width * count));
  for (size_t i = 0; i < static_cast<size_t>(end - begin) * width; i++, from += channels_, to += count) {
    std::memcpy(to, from, count);
  }
}

}  // namespace

std::unique_ptr<Decoder> open_webp(const PictureBytes& file) {
  return std::make_unique<WebpDecoder>(file);
}

// --- writing ---------------------------------------------------------------------------------------------------------

namespace {

struct WebpPicture : WebPPicture {
  WebpPicture() {
    if (!WebPPictureInit(this)) throw std::bad_alloc();
  }
  WebpPicture(const WebpPicture&) = delete;
  WebpPicture& operator=(const WebpPicture&) = delete;
  ~WebpPicture() { WebPPictureFree(this); }
};

// libwebp encodes whole pictures, so this happens in finish().
class WebpEncoder final : public Encoder {
 public:
  WebpEncoder(ByteSink& sink, const FileHeader& header) : sink_(sink), header_(header) {
    const size_t channels = header.channels.size();
    if ((channels != 3 && channels != 4) || header.channels[0].sample != SampleType::kUint8) {
      throw cannot_write(sink, "a WebP has three or four channels of 8 bits");
    }
    pixels_.reserve(channels * static_cast<size_t>(header.width) * static_cast<size_t>(header.height));
  }
  void write(int begin, int end, const std::byte* rows) override {
    const size_t size = header_.channels.size() * static_cast<size_t>(header_.width) * static_cast<size_t>(end - begin);
    const uint8_t* from = reinterpret_cast<const uint8_t*>(rows);
    pixels_.insert(pixels_.end(), from, from + size);
  }
  void finish() override;

 private:
  ByteSink& sink_;
  const FileHeader& header_;
  std::vector<uint8_t> pixels_;
};

void WebpEncoder::finish() {
  WebPConfig config;
  if (!WebPConfigInit(&config)) throw std::bad_alloc();
  config.quality = static_cast<float>(header_.quality);
  config.method = 6;  // the slowest, with the best compression
  config.exact = 1;   // keeps the colours of transparent pixels, which textures mix into those beside them
  WebpPicture picture;
  picture.width = header_.width, picture.height = header_.height;
  picture.custom_ptr = &sink_;
  picture.writer = [](const uint8_t* bytes, size_t size, const WebPPicture* to) {
    static_cast<ByteSink*>(to->custom_ptr)->write(bytes, size);
    return 1;
  };
  const int row = static_cast<int>(header_.channels.size()) * header_.width;
  const auto import = header_.channels.size() == 4 ? WebPPictureImportRGBA : WebPPictureImportRGB;
  const bool is_taken = import(&picture, pixels_.data(), row) != 0;
  pixels_ = {};
  if (is_taken && WebPEncode(&config, &picture)) return;
  const WebPEncodingError fault = picture.error_code;
  if (fault == VP8_ENC_ERROR_OUT_OF_MEMORY || fault == VP8_ENC_ERROR_BITSTREAM_OUT_OF_MEMORY) throw std::bad_alloc();
  throw cannot_write(sink_, fault == VP8_ENC_ERROR_PARTITION0_OVERFLOW || fault == VP8_ENC_ERROR_PARTITION_OVERFLOW
                                ? "it is too large for WebP; a lower `quality` or .png holds it"
                                : "libwebp cannot encode it; try .png");
}

}  // namespace

std::unique_ptr<Encoder> create_webp(ByteSink& sink, const FileHeader& header) {
  return std::make_unique<WebpEncoder>(sink, header);
}

}  // namespace ods

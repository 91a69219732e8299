// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Decodes HEIC and AVIF through libheif, which rotates, mirrors and crops them according to their metadata; encodes HEIC
// of one picture through it.
#include <fmt/format.h>
#include <libheif/heif.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "ods/base/bytes.h"
#include "ods/base/text.h"
#include "ods/files/memory_file.h"
#include "ods/image/codec/decoder.h"
#include "ods/image/codec/encoder.h"
#include "ods/image/format/image_limits.h"
#include "ods/image/heif_items.h"

namespace ods {

namespace {

struct Free {
  void operator()(heif_context* context) const { heif_context_free(context); }
  void operator()(heif_image_handle* handle) const { heif_image_handle_release(handle); }
  void operator()(heif_image* image) const { heif_image_release(image); }
  void operator()(heif_decoding_options* options) const { heif_decoding_options_free(options); }
  void operator()(heif_encoding_options* options) const { heif_encoding_options_free(options); }
  void operator()(heif_encoder* encoder) const { heif_encoder_release(encoder); }
  void operator()(heif_color_profile_nclx* color) const { heif_nclx_color_profile_free(color); }
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

// libheif decodes whole pictures, so this happens on the first read().
class HeifDecoder final : public Decoder {
 public:
  HeifDecoder(const PictureBytes& file, int view);
  void read(int begin, int end, size_t first, size_t count, std::byte* to) override;

 private:
  void check(const heif_error& error) const;
  void decode();

  std::string name_;
  std::vector<uint8_t> file_;
  Owned<heif_context> context_;
  Owned<heif_image_handle> handle_;
  Owned<heif_image> image_;
  const uint8_t* pixels_ = nullptr;
  size_t stride_ = 0;
  int bits_ = 8;
};

// Pictures inside other files are only checked for impossible sizes.
HeifItems items_of(const PictureBytes& file, const std::vector<uint8_t>& bytes) {
  try {
    if (file.on_disk) return read_heif_items(FileInput(file.name));
    const MemoryFile memory({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    read_heif_items(FileInput(memory.path()));
    return {};
  } catch (const MalformedFile& fault) {
    throw cannot_read(file.name, fault.what());
  }
}

HeifDecoder::HeifDecoder(const PictureBytes& file, int view) : name_(file.name), file_(file.size) {
  if (!file.read(0, file_.data(), file_.size())) throw cannot_read(name_, "reading stopped halfway");
  const HeifItems items = items_of(file, file_);
  context_.reset(heif_context_alloc());
  if (!context_) throw std::bad_alloc();
  heif_context_set_maximum_image_size_limit(context_.get(), kMaxSide);
  check(heif_context_read_from_memory_without_copy(context_.get(), file_.data(), file_.size(), nullptr));
  heif_image_handle* handle = nullptr;
  if (items.pair.size() == 2) {
    check(heif_context_get_image_handle(context_.get(), items.pair[static_cast<size_t>(view)], &handle));
  } else {
    check(heif_context_get_primary_image_handle(context_.get(), &handle));
  }
  handle_.reset(handle);
  info.width = heif_image_handle_get_width(handle), info.height = heif_image_handle_get_height(handle);
  check_picture_size(file, info.width, info.height);
  info.channels = {"R", "G", "B"};
  if (heif_image_handle_has_alpha_channel(handle)) info.channels.emplace_back("A");
  bits_ = heif_image_handle_get_luma_bits_per_pixel(handle);
  if (bits_ < 1 || bits_ > 16) throw cannot_read(name_, "the HEIF does not record the bit depth of its pixels");
  info.samples.assign(info.channels.size(), bits_ > 8 ? SampleType::kUint16 : SampleType::kUint8);
  info.is_pair = items.pair.size() == 2;
  if (items.fov > 0.0f) info.numbers["heif:fov"] = {items.fov};
  if (items.baseline > 0.0) info.numbers["heif:baseline"] = {static_cast<float>(items.baseline)};
}

void HeifDecoder::check(const heif_error& error) const {
  if (error.code == heif_error_Ok) return;
  if (error.code == heif_error_Memory_allocation_error && error.subcode != heif_suberror_Security_limit_exceeded) {
    throw std::bad_alloc();
  }
  if (error.subcode == heif_suberror_Unsupported_codec || error.code == heif_error_Unsupported_filetype) {
    throw cannot_read(name_, fmt::format("this machine's libheif has no decoder for it ({}); the packages "
                                         "libheif-plugin-libde265 (HEIC) and libheif-plugin-dav1d (AVIF) have them",
                                         error.message));
  }
  throw cannot_read(name_, "the HEIF is damaged or unusual: " + one_line(error.message));
}

void HeifDecoder::decode() {
  const bool has_alpha = info.channels.size() == 4, is_deep = bits_ > 8;
  const heif_chroma chroma = is_deep
                                 ? (has_alpha ? heif_chroma_interleaved_RRGGBBAA_LE : heif_chroma_interleaved_RRGGBB_LE)
                                 : (has_alpha ? heif_chroma_interleaved_RGBA : heif_chroma_interleaved_RGB);
  const Owned<heif_decoding_options> options(heif_decoding_options_alloc());
  if (!options) throw std::bad_alloc();
  options->convert_hdr_to_8bit = 0;
#if LIBHEIF_HAVE_VERSION(1, 16, 0)
  options->color_conversion_options.preferred_chroma_upsampling_algorithm = heif_chroma_upsampling_bilinear;
#endif
  heif_image* image = nullptr;
  check(heif_decode_image(handle_.get(), &image, heif_colorspace_RGB, chroma, options.get()));
  image_.reset(image);
  handle_.reset(), context_.reset();
  file_ = {};
  int stride = 0;
  pixels_ = heif_image_get_plane_readonly(image, heif_channel_interleaved, &stride);
  stride_ = static_cast<size_t>(stride);
  const int width = heif_image_get_width(image, heif_channel_interleaved);
  const int height = heif_image_get_height(image, heif_channel_interleaved);
  if (pixels_ == nullptr || width != info.width || height != info.height) {
    throw cannot_read(name_, "the HEIF's pixels are not of the size that it states");
  }
}

void HeifDecoder::read(int begin, int end, size_t first, size_t count, std::byte* to) {
  if (!image_) decode();
  const size_t channels = info.channels.size(), width = static_cast<size_t>(info.width);
  const uint32_t maximum = (1u << bits_) - 1;
  for (int y = begin; y < end; y++) {
    const uint8_t* row = pixels_ + static_cast<size_t>(y) * stride_;
    for (size_t x = 0; x < width; x++) {
      for (size_t c = first; c < first + count; c++) {
        const uint8_t* at = row + (x * channels + c) * (bits_ > 8 ? 2 : 1);
        if (bits_ <= 8) {
          *to++ = static_cast<std::byte>(*at);
          continue;
        }
        const uint32_t code = std::min(static_cast<uint32_t>(at[0] | at[1] << 8), maximum);
        const auto wide = static_cast<uint16_t>((code * 65535u + maximum / 2) / maximum);
        std::memcpy(to, &wide, sizeof wide);
        to += sizeof wide;
      }
    }
  }
}

// libheif encodes whole pictures, so this happens in finish().
class HeifEncoder final : public Encoder {
 public:
  HeifEncoder(ByteSink& sink, const FileHeader& header);
  void write(int begin, int end, const std::byte* rows) override;
  void finish() override;

 private:
  void check(const heif_error& error) const;

  ByteSink& sink_;
  const FileHeader& header_;
  Owned<heif_image> image_;
  uint8_t* pixels_ = nullptr;
  size_t stride_ = 0;
};

void HeifEncoder::check(const heif_error& error) const {
  if (error.code == heif_error_Memory_allocation_error) throw std::bad_alloc();
  if (error.code != heif_error_Ok) throw cannot_write(sink_, one_line(error.message));
}

// sRGB, as the pixels are. The matrix is BT.601's, which cameras use for sRGB.
Owned<heif_color_profile_nclx> srgb_color() {
  Owned<heif_color_profile_nclx> color(heif_nclx_color_profile_alloc());
  if (!color) throw std::bad_alloc();
  color->color_primaries = heif_color_primaries_ITU_R_BT_709_5;
  color->transfer_characteristics = heif_transfer_characteristic_IEC_61966_2_1;
  color->matrix_coefficients = heif_matrix_coefficients_ITU_R_BT_601_6;
  color->full_range_flag = 1;
  return color;
}

HeifEncoder::HeifEncoder(ByteSink& sink, const FileHeader& header) : sink_(sink), header_(header) {
  if (header.channels.size() != 3 || header.channels[0].sample != SampleType::kUint8) {
    throw cannot_write(sink, "a HEIC has three channels of 8 bits");
  }
  if (const std::string why = lacks_encoder(FileFormat::kHeif); !why.empty()) throw cannot_write(sink, why);
  heif_image* image = nullptr;
  check(heif_image_create(header.width, header.height, heif_colorspace_RGB, heif_chroma_interleaved_RGB, &image));
  image_.reset(image);
  check(heif_image_add_plane(image, heif_channel_interleaved, header.width, header.height, 8));
  check(heif_image_set_nclx_color_profile(image, srgb_color().get()));
  int stride = 0;
  pixels_ = heif_image_get_plane(image, heif_channel_interleaved, &stride);
  stride_ = static_cast<size_t>(stride);
}

void HeifEncoder::write(int begin, int end, const std::byte* rows) {
  const size_t row = 3 * static_cast<size_t>(header_.width);
  for (int y = begin; y < end; y++, rows += row) std::memcpy(pixels_ + static_cast<size_t>(y) * stride_, rows, row);
}

void HeifEncoder::finish() {
  const std::unique_ptr<heif_context, Free> context(heif_context_alloc());
  const Owned<heif_encoding_options> options(heif_encoding_options_alloc());
  if (!context || !options) throw std::bad_alloc();
  heif_encoder* found = nullptr;
  check(heif_context_get_encoder_for_format(context.get(), heif_compression_HEVC, &found));
  const Owned<heif_encoder> encoder(found);
  check(heif_encoder_set_lossy_quality(found, header_.quality));
  options->macOS_compatibility_workaround = 0;  // else odd sides become a grid of one tile
  options->macOS_compatibility_workaround_no_nclx_profile = 0;
  check(heif_context_encode_image(context.get(), image_.get(), found, options.get(), nullptr));
  image_.reset();
  heif_writer writer{};
  writer.writer_api_version = 1;
  writer.write = [](heif_context*, const void* data, size_t size, void* to) {
    static_cast<ByteSink*>(to)->write(data, size);
    return heif_error{heif_error_Ok, heif_suberror_Unspecified, ""};
  };
  check(heif_context_write(context.get(), &writer, &sink_));
}

}  // namespace

std::unique_ptr<Decoder> open_heif(const PictureBytes& file, int view) {
  return std::make_unique<HeifDecoder>(file, view);
}

std::unique_ptr<Encoder> create_heif(ByteSink& sink, const FileHeader& header) {
  return std::make_unique<HeifEncoder>(sink, header);
}

std::string lacks_encoder(FileFormat format) {
  if (format != FileFormat::kHeif || heif_have_encoder_for_format(heif_compression_HEVC) != 0) return {};
  return "this machine's libheif has no encoder of HEVC; the package libheif-plugin-x265 has one";
}

}  // namespace ods

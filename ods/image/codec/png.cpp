// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// PNG through libpng.
#include <png.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "ods/base/text.h"
#include "ods/image/codec/decoder.h"
#include "ods/image/codec/encoder.h"
#include "ods/image/format/png_chunks.h"

namespace ods {

namespace {

// Handles libpng's errors: it ends a call by longjmp, and must not print.
struct PngFault {
  char words[128] = "";
};

void keep_error(png_structp png, png_const_charp words) {
  PngFault& fault = *static_cast<PngFault*>(png_get_error_ptr(png));
  std::strncpy(fault.words, words, sizeof fault.words - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

// Calls libpng. Returns false if it failed. longjmp calls no destructors, so `calls` must need none.
template <class Calls>
bool succeeds(png_structp png, const Calls& calls) {
  if (setjmp(png_jmpbuf(png))) return false;
  calls();
  return true;
}

// --- reading ---------------------------------------------------------------------------------------------------------

struct PngInput {
  FileParts parts;
  size_t at = 0;
};

struct PngReading {
  png_structp png = nullptr;
  png_infop header = nullptr;
  PngReading() = default;
  PngReading(const PngReading&) = delete;
  PngReading& operator=(const PngReading&) = delete;
  ~PngReading() { end(); }
  void end() { png_destroy_read_struct(&png, &header, nullptr); }
};

void read_bytes(png_structp png, png_bytep to, size_t size) {
  PngInput& input = *static_cast<PngInput*>(png_get_io_ptr(png));
  if (input.parts.read(input.at, to, size) != size) png_error(png, "the file is cut short");
  input.at += size;
}

class PngDecoder final : public Decoder {
 public:
  PngDecoder(const PictureBytes& file, std::vector<FileRange> parts)
      : name_(file.name), input_{FileParts(file.read, std::move(parts))} {
    start();
    read_header(file);
  }

  void read(int begin, int end, size_t first, size_t count, std::byte* to) override;

 private:
  void start();
  void read_header(const PictureBytes& file);
  void read_row(png_bytep to) {
    if (!succeeds(libpng_.png, [&] { png_read_row(libpng_.png, to, nullptr); })) throw failed();
  }
  void read_interlaced();
  Error failed() const { return cannot_read(name_, library_message(fault_.words)); }

  std::string name_;
  PngInput input_;
  PngFault fault_;
  PngReading libpng_;
  int next_ = 0;  // the row that libpng decodes next
  bool is_interlaced_ = false;
  size_t pixel_size_ = 0;
  std::vector<png_byte> row_;
  std::vector<png_byte> whole_;  // for interlaced pictures
};

// Restarts from the first row. Palettes become colours, fewer than 8 bits become 8, a transparent colour becomes alpha.
void PngDecoder::start() {
  libpng_.end();
  png_structp png = libpng_.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &fault_, keep_error, ignore_warning);
  png_infop header = libpng_.header = png ? png_create_info_struct(png) : nullptr;
  if (!header) throw std::bad_alloc();
  input_.at = 0;
  next_ = 0;
  const bool good = succeeds(png, [&] {
    png_set_read_fn(png, &input_, read_bytes);
    png_set_crc_action(png, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);  // checked by essential_png()
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);     // ours are checked
    png_read_info(png, header);
    png_set_expand(png);
    png_set_swap(png);  // 16 bits: little endian, like all supported machines
    is_interlaced_ = png_set_interlace_handling(png) > 1;
    png_read_update_info(png, header);
  });
  if (!good) throw failed();
}

void PngDecoder::read_header(const PictureBytes& file) {
  png_structp png = libpng_.png;
  png_infop header = libpng_.header;
  info.width = static_cast<int>(png_get_image_width(png, header));
  info.height = static_cast<int>(png_get_image_height(png, header));
  check_picture_size(file, info.width, info.height);
  const size_t channels = png_get_channels(png, header);
  const bool deep = png_get_bit_depth(png, header) == 16;
  info.channels = channels < 3 ? std::vector<std::string>{"Y", "A"} : std::vector<std::string>{"R", "G", "B", "A"};
  info.channels.resize(channels);
  info.samples.assign(channels, deep ? SampleType::kUint16 : SampleType::kUint8);
  pixel_size_ = channels * bytes_of(info.samples[0]);
  row_.resize(pixel_size_ * static_cast<size_t>(info.width));
  png_textp words = nullptr;
  const int count = png_get_text(png, header, &words, nullptr);
  for (int i = 0; i < count; i++) info.text[words[i].key] = words[i].text;
}

// Every pass touches every row.
void PngDecoder::read_interlaced() {
  whole_.resize(row_.size() * static_cast<size_t>(info.height));
  std::vector<png_bytep> rows;
  for (size_t at = 0; at < whole_.size(); at += row_.size()) rows.push_back(&whole_[at]);
  if (!succeeds(libpng_.png, [&] { png_read_image(libpng_.png, rows.data()); })) throw failed();
}

void PngDecoder::read(int begin, int end, size_t first, size_t count, std::byte* to) {
  if (is_interlaced_ && whole_.empty()) read_interlaced();
  if (!is_interlaced_ && begin < next_) start();
  const size_t sample = bytes_of(info.samples[0]), size = count * sample;
  for (int y = is_interlaced_ ? begin : next_; y < end; y++) {
    const bool wanted = y >= begin;
    const bool at_once = wanted && size == pixel_size_ && !is_interlaced_;
    png_bytep row = at_once ? reinterpret_cast<png_bytep>(to) : row_.data();
    if (is_interlaced_) {
      row = &whole_[static_cast<size_t>(y) * row_.size()];
    } else {
      read_row(row);
      next_ = y + 1;
    }
    if (!wanted) continue;
    for (size_t from = first * sample; !at_once && from < row_.size(); from += pixel_size_, to += size) {
      std::memcpy(to, row + from, size);
    }
    if (at_once) to += row_.size();
  }
}

}  // namespace

std::unique_ptr<Decoder> open_png(const PictureBytes& file) {
  std::optional<std::vector<FileRange>> parts = essential_png(file.size, file.read);
  if (!parts) throw cannot_read(file.name, "the PNG is cut short or damaged");
  return std::make_unique<PngDecoder>(file, std::move(*parts));
}

// --- writing ---------------------------------------------------------------------------------------------------------

namespace {

void write_bytes(png_structp png, png_bytep bytes, size_t size) {
  static_cast<ByteSink*>(png_get_io_ptr(png))->write(bytes, size);
}

void flush_nothing(png_structp) {}

int color_type_of(size_t channels) {
  constexpr int kTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                            PNG_COLOR_TYPE_RGB_ALPHA};
  return kTypes[channels - 1];
}

struct PngWriting {
  png_structp png = nullptr;
  png_infop header = nullptr;
  PngWriting() = default;
  PngWriting(const PngWriting&) = delete;
  PngWriting& operator=(const PngWriting&) = delete;
  ~PngWriting() { png_destroy_write_struct(&png, &header); }
};

class PngEncoder final : public Encoder {
 public:
  PngEncoder(ByteSink& sink, const FileHeader& header);

  void write(int begin, int end, const std::byte* rows) override {
    const bool good = succeeds(libpng_.png, [&] {
      for (int y = begin; y < end; y++, rows += row_size_)
        png_write_row(libpng_.png, reinterpret_cast<png_const_bytep>(rows));
    });
    if (!good) throw failed();
  }
  void finish() override {
    if (!succeeds(libpng_.png, [&] { png_write_end(libpng_.png, nullptr); })) throw failed();
  }

 private:
  Error failed() const { return cannot_write(sink_, fault_.words); }

  ByteSink& sink_;
  PngFault fault_;
  PngWriting libpng_;
  size_t row_size_;
};

// Uncompressed, because all readers support that. The texts point into the arguments.
std::vector<png_text> texts_of(const FileHeader& header, const std::string& xmp) {
  std::vector<png_text> texts;
  const auto add = [&](int form, const char* key, const std::string& text) {
    png_text one{};
    one.compression = form;
    one.key = const_cast<char*>(key);  // libpng only reads them
    one.text = const_cast<char*>(text.c_str());
    texts.push_back(one);
  };
  for (const Attribute& attribute : header.attributes) {
    const std::string* text = std::get_if<std::string>(&attribute.value);
    if (text && !is_gpano(attribute)) add(PNG_TEXT_COMPRESSION_NONE, attribute.name.c_str(), *text);
  }
  if (!xmp.empty()) add(PNG_ITXT_COMPRESSION_NONE, kPngXmpKeyword.data(), xmp);
  return texts;
}

PngEncoder::PngEncoder(ByteSink& sink, const FileHeader& header) : sink_(sink) {
  png_structp png = libpng_.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &fault_, keep_error, ignore_warning);
  png_infop info = libpng_.header = png ? png_create_info_struct(png) : nullptr;
  if (!info) throw std::bad_alloc();
  const size_t channels = header.channels.size(), sample = bytes_of(header.channels[0].sample);
  row_size_ = bytes_of_pixel(header) * static_cast<size_t>(header.width);
  const std::string xmp = gpano_xmp(header.attributes);
  const std::vector<png_text> texts = texts_of(header, xmp);
  std::string exif = header.exif;  // libpng copies it, but does not promise to leave it unchanged
  const bool good = succeeds(png, [&] {
    png_set_write_fn(png, &sink, write_bytes, flush_nothing);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_IHDR(png, info, static_cast<png_uint_32>(header.width), static_cast<png_uint_32>(header.height),
                 static_cast<int>(8 * sample), color_type_of(channels), PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (header.writes_srgb) png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
    if (!exif.empty()) {
      png_set_eXIf_1(png, info, static_cast<png_uint_32>(exif.size()), reinterpret_cast<png_bytep>(exif.data()));
    }
    png_set_compression_level(png, 4);  // 2.5 times as fast as 6, and 3 % larger
    png_write_info(png, info);
    png_set_swap(png);
  });
  if (!good) throw failed();
}

}  // namespace

std::unique_ptr<Encoder> create_png(ByteSink& sink, const FileHeader& header) {
  return std::make_unique<PngEncoder>(sink, header);
}

}  // namespace ods

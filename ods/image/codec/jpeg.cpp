// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// JPEG through libjpeg.
#include <fmt/format.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>

// After <cstdio>, because it needs FILE.
#include <jpeglib.h>

#include "ods/base/text.h"
#include "ods/image/codec/decoder.h"
#include "ods/image/codec/encoder.h"
#include "ods/image/exif.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/xmp.h"

namespace ods {

namespace {

// Handles libjpeg's errors; by default it would end the process, and print.
struct JpegFault : jpeg_error_mgr {
  std::jmp_buf back;
  char words[JMSG_LENGTH_MAX] = "";

  JpegFault() {
    jpeg_std_error(this);
    error_exit = [](j_common_ptr jpeg) {
      JpegFault& fault = *static_cast<JpegFault*>(jpeg->err);
      fault.format_message(jpeg, fault.words);
      std::longjmp(fault.back, 1);
    };
    output_message = [](j_common_ptr) {};
  }
};

// Calls libjpeg. Returns false if it failed. longjmp calls no destructors, so `calls` must need none.
template <class Calls>
bool succeeds(JpegFault& fault, const Calls& calls) {
  if (setjmp(fault.back)) return false;
  calls();
  return true;
}

// --- reading ---------------------------------------------------------------------------------------------------------

// The input of libjpeg: a PictureBytes, through a buffer.
struct JpegInput : jpeg_source_mgr {
  const PictureBytes& file;
  size_t at = 0;  // position of the data after the buffer
  JOCTET buffer[1 << 16];

  explicit JpegInput(const PictureBytes& of) : jpeg_source_mgr{}, file(of) {
    init_source = [](j_decompress_ptr) {};
    fill_input_buffer = [](j_decompress_ptr jpeg) { return static_cast<JpegInput*>(jpeg->src)->fill(); };
    skip_input_data = [](j_decompress_ptr jpeg, long count) { static_cast<JpegInput*>(jpeg->src)->skip(count); };
    resync_to_restart = jpeg_resync_to_restart;
    term_source = [](j_decompress_ptr) {};
  }
  boolean fill() {
    const size_t count = std::min(sizeof buffer, file.size - std::min(at, file.size));
    next_input_byte = buffer;
    if (count > 0 && file.read(at, buffer, count)) {
      bytes_in_buffer = count;
    } else {  // libjpeg needs an end in any case
      buffer[0] = 0xFF, buffer[1] = JPEG_EOI;
      bytes_in_buffer = 2;
    }
    at += count;
    return TRUE;
  }
  void skip(long count) {
    if (count <= 0) return;
    const size_t here = std::min(static_cast<size_t>(count), bytes_in_buffer);
    next_input_byte += here, bytes_in_buffer -= here;
    at += std::min(static_cast<size_t>(count) - here, file.size - std::min(at, file.size));
  }
};

struct JpegReading : jpeg_decompress_struct {
  JpegReading() : jpeg_decompress_struct{} {}
  JpegReading(const JpegReading&) = delete;
  JpegReading& operator=(const JpegReading&) = delete;
  ~JpegReading() { jpeg_destroy_decompress(this); }
};

class JpegDecoder final : public Decoder {
 public:
  JpegDecoder(const PictureBytes& file, int min_width) : file_(file), min_width_(min_width), input_(file_) {
    start();
    read_header();
  }
  void read(int begin, int end, size_t first, size_t count, std::byte* to) override;

 private:
  void start();
  void read_header();
  Error failed() const { return cannot_read(file_.name, library_message(fault_.words)); }

  PictureBytes file_;
  int min_width_;  // 0 for full size
  JpegInput input_;
  JpegFault fault_;
  JpegReading jpeg_;
  bool is_started_ = false;
  std::vector<JSAMPLE> row_;
};

// Restarts from the first row.
void JpegDecoder::start() {
  input_.at = 0, input_.bytes_in_buffer = 0;
  is_started_ = false;
  const bool good = succeeds(fault_, [&] {
    jpeg_destroy_decompress(&jpeg_);
    jpeg_.err = &fault_;
    jpeg_create_decompress(&jpeg_);
    jpeg_.src = &input_;
    jpeg_read_header(&jpeg_, TRUE);
    const bool is_ink = jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
    if (is_ink) jpeg_.out_color_space = JCS_CMYK;
    if (min_width_ > 0) {
      // libjpeg scales by eighths directly from the coefficients of the blocks, which avoids nearly all of its work.
      jpeg_.scale_num = 1, jpeg_.scale_denom = 8;
      while (jpeg_.scale_num < 8 && jpeg_.image_width * jpeg_.scale_num / 8 < static_cast<JDIMENSION>(min_width_)) {
        jpeg_.scale_num *= 2;
      }
      jpeg_.do_fancy_upsampling = FALSE;
    }
    jpeg_calc_output_dimensions(&jpeg_);
  });
  if (!good) throw failed();
}

void JpegDecoder::read_header() {
  info.width = static_cast<int>(jpeg_.output_width);
  info.height = static_cast<int>(jpeg_.output_height);
  check_picture_size(file_, info.width, info.height);
  const int components = jpeg_.output_components;
  if (components != 1 && components != 3 && components != 4) {
    throw cannot_read(file_.name, fmt::format("it has {} components; 1, 3 and 4 are known", components));
  }
  info.channels = components == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  info.samples.assign(info.channels.size(), SampleType::kUint8);
  row_.resize(jpeg_.output_width * static_cast<size_t>(jpeg_.output_components));
}

// Adobe's programs store ink as 255 minus its amount, and mark this with their own marker.
void ink_to_light(std::vector<JSAMPLE>& row, bool is_inverted) {
  JSAMPLE* to = row.data();
  for (size_t at = 0; at + 4 <= row.size(); at += 4) {
    const auto paper = [&](size_t i) { return is_inverted ? row[at + i] : 255 - row[at + i]; };
    const int black = paper(3), red = paper(0), green = paper(1), blue = paper(2);
    for (const int each : {red, green, blue}) *to++ = static_cast<JSAMPLE>((each * black + 127) / 255);
  }
}

void JpegDecoder::read(int begin, int end, size_t first, size_t count, std::byte* to) {
  if (is_started_ && begin < static_cast<int>(jpeg_.output_scanline)) start();
  if (!is_started_ && !succeeds(fault_, [&] { jpeg_start_decompress(&jpeg_); })) throw failed();
  is_started_ = true;
  const size_t channels = info.channels.size();
  while (static_cast<int>(jpeg_.output_scanline) < end) {
    const bool wanted = static_cast<int>(jpeg_.output_scanline) >= begin;
    JSAMPROW row = row_.data();
    if (!succeeds(fault_, [&] { jpeg_read_scanlines(&jpeg_, &row, 1); })) throw failed();
    if (!wanted) continue;
    if (jpeg_.output_components == 4) ink_to_light(row_, jpeg_.saw_Adobe_marker == TRUE);
    for (size_t x = 0; x < jpeg_.output_width; x++, to += count) std::memcpy(to, &row_[x * channels + first], count);
  }
}

}  // namespace

// libjpeg fills missing data with grey, and only warns.
std::unique_ptr<Decoder> open_jpeg(const PictureBytes& file, int min_width) {
  if (!is_whole_jpeg(file.size, file.read)) throw cannot_read(file.name, "the JPEG is cut short or damaged");
  return std::make_unique<JpegDecoder>(file, min_width);
}

// --- writing ---------------------------------------------------------------------------------------------------------

namespace {

// The output of libjpeg.
struct JpegOutput : jpeg_destination_mgr {
  ByteSink& sink;
  JOCTET buffer[1 << 16];

  explicit JpegOutput(ByteSink& to) : jpeg_destination_mgr{}, sink(to) {
    init_destination = [](j_compress_ptr jpeg) { static_cast<JpegOutput*>(jpeg->dest)->begin(); };
    empty_output_buffer = [](j_compress_ptr jpeg) -> boolean {
      JpegOutput& output = *static_cast<JpegOutput*>(jpeg->dest);
      output.sink.write(output.buffer, sizeof output.buffer);
      output.begin();
      return TRUE;
    };
    term_destination = [](j_compress_ptr jpeg) {
      JpegOutput& output = *static_cast<JpegOutput*>(jpeg->dest);
      output.sink.write(output.buffer, sizeof output.buffer - output.free_in_buffer);
    };
  }
  void begin() { next_output_byte = buffer, free_in_buffer = sizeof buffer; }
};

struct JpegWriting : jpeg_compress_struct {
  JpegWriting() : jpeg_compress_struct{} {}
  JpegWriting(const JpegWriting&) = delete;
  JpegWriting& operator=(const JpegWriting&) = delete;
  ~JpegWriting() { jpeg_destroy_compress(this); }
};

class JpegEncoder final : public Encoder {
 public:
  JpegEncoder(ByteSink& sink, const FileHeader& header);

  void write(int begin, int end, const std::byte* rows) override {
    const bool good = succeeds(fault_, [&] {
      for (int y = begin; y < end; y++, rows += row_size_) {
        JSAMPROW row = reinterpret_cast<JSAMPROW>(const_cast<std::byte*>(rows));  // libjpeg only reads it
        jpeg_write_scanlines(&jpeg_, &row, 1);
      }
    });
    if (!good) throw failed();
  }
  void finish() override {
    if (!succeeds(fault_, [&] { jpeg_finish_compress(&jpeg_); })) throw failed();
  }

 private:
  Error failed() const { return cannot_write(sink_, fault_.words); }

  ByteSink& sink_;
  JpegOutput output_;
  JpegFault fault_;
  JpegWriting jpeg_;
  size_t row_size_;
};

// Exif and XMP with GPano come before the pixels, then text as comments.
JpegEncoder::JpegEncoder(ByteSink& sink, const FileHeader& header) : sink_(sink), output_(sink) {
  const size_t channels = header.channels.size();
  row_size_ = channels * static_cast<size_t>(header.width);
  const std::string packet = gpano_xmp(header.attributes);
  const std::string xmp = packet.empty() ? "" : std::string(kJpegXmp) + packet;
  const std::string exif = header.exif.empty() ? "" : std::string(kExifPrefix) + header.exif;
  const auto write_segment = [&](int marker, const std::string& data) {
    jpeg_write_marker(&jpeg_, marker, reinterpret_cast<const JOCTET*>(data.data()), static_cast<unsigned>(data.size()));
  };
  const bool good = succeeds(fault_, [&] {
    jpeg_.err = &fault_;
    jpeg_create_compress(&jpeg_);
    jpeg_.dest = &output_;
    jpeg_.image_width = static_cast<JDIMENSION>(header.width);
    jpeg_.image_height = static_cast<JDIMENSION>(header.height);
    jpeg_.input_components = static_cast<int>(channels);
    jpeg_.in_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&jpeg_);
    jpeg_set_quality(&jpeg_, header.quality, TRUE);
    jpeg_.comp_info[0].h_samp_factor = jpeg_.comp_info[0].v_samp_factor = 1;  // 4:4:4
    jpeg_start_compress(&jpeg_, TRUE);
    if (!exif.empty() && exif.size() <= kLongestJpegSegment) write_segment(kJpegApp1, exif);
    if (!xmp.empty()) write_segment(kJpegApp1, xmp);
    for (const Attribute& attribute : header.attributes) {
      const std::string* text = std::get_if<std::string>(&attribute.value);
      if (text && !is_gpano(attribute)) write_segment(JPEG_COM, *text);
    }
  });
  if (!good) throw failed();
}

}  // namespace

std::unique_ptr<Encoder> create_jpeg(ByteSink& sink, const FileHeader& header) {
  return std::make_unique<JpegEncoder>(sink, header);
}

}  // namespace ods

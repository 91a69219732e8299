// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Radiance pictures (.hdr): three mantissas and a shared exponent, four bytes per pixel. Sources: Greg Ward, "Real
// Pixels", in "Graphics Gems II"; "Radiance File Formats". EXPOSURE and COLORCORR are not applied.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "ods/base/text.h"
#include "ods/image/codec/decoder.h"
#include "ods/image/codec/encoder.h"

namespace ods {

namespace {

constexpr size_t kPixel = 4;                                   // red, green, blue, exponent
constexpr size_t kShortestPacked = 8, kLongestPacked = 32767;  // row widths with separately packed components
constexpr std::string_view kFormat = "32-bit_rle_rgbe";

// --- reading ---------------------------------------------------------------------------------------------------------

// Reads the bytes of a file sequentially.
class ByteStream {
 public:
  explicit ByteStream(const PictureBytes& file) : file_(file), buffer_(1 << 16) {}

  uint8_t next() {
    if (used_ == held_) fill();
    return buffer_[used_++];
  }
  void read(uint8_t* to, size_t count) {
    for (size_t i = 0; i < count; i++) to[i] = next();
  }
  size_t at() const { return end_ - held_ + used_; }
  void seek(size_t at) { end_ = at, used_ = held_ = 0; }
  Error damaged() const { return cannot_read(file_.name, "the HDR is cut short or damaged"); }

 private:
  void fill() {
    held_ = std::min(buffer_.size(), file_.size - std::min(end_, file_.size)), used_ = 0;
    if (held_ == 0 || !file_.read(end_, buffer_.data(), held_)) throw damaged();
    end_ += held_;
  }

  PictureBytes file_;
  std::vector<uint8_t> buffer_;
  size_t used_ = 0, held_ = 0;  // bytes in the buffer
  size_t end_ = 0;              // end of the buffer in the file
};

// Reads components that are packed separately: runs of up to 127 equal bytes, and up to 128 literal bytes.
void read_components(ByteStream& in, uint8_t* to, size_t length) {
  for (size_t c = 0; c < kPixel; c++) {
    for (size_t x = 0; x < length;) {
      const size_t code = in.next(), count = code > 128 ? code - 128 : code;
      if (count == 0 || count > length - x) throw in.damaged();
      const uint8_t same = code > 128 ? in.next() : uint8_t{0};
      for (const size_t end = x + count; x < end; x++) to[x * kPixel + c] = code > 128 ? same : in.next();
    }
  }
}

// Reads whole pixels, of which 1, 1, 1, n repeats the previous one n times; directly after another repetition, 256 n
// times.
void read_pixels(ByteStream& in, uint8_t* to, size_t length, const uint8_t* first) {
  unsigned shift = 0;
  for (size_t x = 0; x < length;) {
    uint8_t pixel[kPixel];
    x == 0 && shift == 0 ? void(std::memcpy(pixel, first, kPixel)) : in.read(pixel, kPixel);
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      std::memcpy(to + x++ * kPixel, pixel, kPixel);
      shift = 0;
      continue;
    }
    if (x == 0 || shift > 16) throw in.damaged();
    const size_t count = size_t{pixel[3]} << shift;
    if (count > length - x) throw in.damaged();
    for (const size_t end = x + count; x < end; x++) std::memcpy(to + x * kPixel, to + (x - 1) * kPixel, kPixel);
    shift += 8;
  }
}

void read_scanline(ByteStream& in, uint8_t* to, size_t length) {
  uint8_t start[kPixel];
  in.read(start, kPixel);
  const bool is_packed =
      length >= kShortestPacked && length <= kLongestPacked && start[0] == 2 && start[1] == 2 && (start[2] & 0x80) == 0;
  if (!is_packed) return read_pixels(in, to, length, start);
  if ((size_t{start[2]} << 8 | start[3]) != length) throw in.damaged();
  read_components(in, to, length);
}

float to_float(const uint8_t* pixel, size_t component) {
  if (pixel[3] == 0) return 0.0f;
  return std::ldexp(static_cast<float>(pixel[component]), static_cast<int>(pixel[3]) - (128 + 8));
}

// `-Y 512 +X 1024`: the scanlines are rows from the top, 1024 pixels each from the left.
struct Order {
  char axes[2] = {'Y', 'X'};
  char signs[2] = {'-', '+'};
  size_t counts[2] = {0, 0};  // number of scanlines, and of pixels in each
  bool is_usual() const { return axes[0] == 'Y' && signs[0] == '-' && signs[1] == '+'; }
};

class HdrDecoder final : public Decoder {
 public:
  explicit HdrDecoder(const PictureBytes& file) : name_(file.name), in_(file) {
    read_header();
    const bool has_rows = order_.axes[0] == 'Y';
    const auto side = [&](size_t i) { return static_cast<int>(std::min<size_t>(order_.counts[i], 1u << 30)); };
    info.width = side(has_rows ? 1 : 0), info.height = side(has_rows ? 0 : 1);
    check_picture_size(file, info.width, info.height);
    info.is_float = true;
    info.channels = {"R", "G", "B"};
    info.samples.assign(3, SampleType::kFloat);
    start_ = in_.at();
    row_.resize(kPixel * order_.counts[1]);
  }
  void read(int begin, int end, size_t first, size_t count, std::byte* to) override;

 private:
  std::string read_line();
  void read_header();
  void read_order(const std::string& line);
  void put_row(int y, size_t first, size_t count, std::byte* to);
  void read_whole();

  std::string name_;
  ByteStream in_;
  Order order_;
  size_t start_ = 0;            // start of the first scanline
  int next_ = 0;                // scanline
  std::vector<uint8_t> row_;    // one scanline
  std::vector<uint8_t> whole_;  // all scanlines, if their order is unusual
};

std::string HdrDecoder::read_line() {
  constexpr size_t kLongestHeader = 1 << 16;
  std::string line;
  while (line.empty() || line.back() != '\n') {
    if (in_.at() > kLongestHeader) throw in_.damaged();
    line += static_cast<char>(in_.next());
  }
  line.pop_back();
  if (line.ends_with('\r')) line.pop_back();
  return line;
}

void HdrDecoder::read_header() {
  for (std::string line = read_line(); !line.empty(); line = read_line()) {
    if (!line.starts_with("FORMAT=")) continue;
    const std::string format = one_line(line.substr(7));
    if (format == kFormat) continue;
    const std::string_view help = format.ends_with("xyze") ? "; Radiance's 'ra_xyze -r' converts it" : "";
    throw cannot_read(name_, fmt::format("its format is '{}', but only {} is read{}", format, kFormat, help));
  }
  read_order(read_line());
}

void HdrDecoder::read_order(const std::string& line) {
  const char *at = line.data(), *const end = at + line.size();
  for (size_t i = 0; i < 2; i++) {
    while (at < end && *at == ' ') at++;
    if (end - at < 3) throw in_.damaged();
    order_.signs[i] = *at++, order_.axes[i] = *at++;
    const bool is_known =
        (order_.signs[i] == '-' || order_.signs[i] == '+') && (order_.axes[i] == 'X' || order_.axes[i] == 'Y');
    while (at < end && *at == ' ') at++;
    const auto [after, fault] = std::from_chars(at, end, order_.counts[i]);
    if (!is_known || fault != std::errc()) throw in_.damaged();
    at = after;
  }
  if (order_.axes[0] == order_.axes[1]) throw in_.damaged();
}

// Memory grows with the data in the file.
void HdrDecoder::read_whole() {
  in_.seek(start_);
  for (size_t i = 0; i < order_.counts[0]; i++) {
    read_scanline(in_, row_.data(), order_.counts[1]);
    whole_.insert(whole_.end(), row_.begin(), row_.end());
  }
}

// Extracts row y of a picture with an unusual order, as if it were a scanline.
void HdrDecoder::put_row(int y, size_t first, size_t count, std::byte* to) {
  const bool has_rows = order_.axes[0] == 'Y';
  const size_t down = static_cast<size_t>(order_.signs[has_rows ? 0 : 1] == '-' ? y : info.height - 1 - y);
  for (int x = 0; x < info.width; x++) {
    const size_t right = static_cast<size_t>(order_.signs[has_rows ? 1 : 0] == '+' ? x : info.width - 1 - x);
    const size_t line = has_rows ? down : right, place = has_rows ? right : down;
    const uint8_t* pixel = &whole_[kPixel * (line * order_.counts[1] + place)];
    for (size_t c = first; c < first + count; c++, to += sizeof(float)) {
      const float value = to_float(pixel, c);
      std::memcpy(to, &value, sizeof value);
    }
  }
}

void HdrDecoder::read(int begin, int end, size_t first, size_t count, std::byte* to) {
  const size_t row_size = count * sizeof(float) * static_cast<size_t>(info.width);
  if (!order_.is_usual()) {
    if (whole_.empty()) read_whole();
    for (int y = begin; y < end; y++, to += row_size) put_row(y, first, count, to);
    return;
  }
  if (next_ == 0 || begin < next_) in_.seek(start_), next_ = 0;
  for (; next_ < end; next_++) {
    read_scanline(in_, row_.data(), order_.counts[1]);
    if (next_ < begin) continue;
    for (size_t at = 0; at < row_.size(); at += kPixel) {
      for (size_t c = first; c < first + count; c++, to += sizeof(float)) {
        const float value = to_float(&row_[at], c);
        std::memcpy(to, &value, sizeof value);
      }
    }
  }
}

}  // namespace

std::unique_ptr<Decoder> open_hdr(const PictureBytes& file) {
  return std::make_unique<HdrDecoder>(file);
}

// --- writing ---------------------------------------------------------------------------------------------------------

namespace {

void put_pixel(const float* light, uint8_t* to) {
  constexpr float kMin = 1e-32f, kMax = 1e38f;  // range of the shared exponent
  float values[3], largest = 0.0f;
  for (size_t c = 0; c < 3; c++) largest = std::max(largest, values[c] = finite(light[c], 0.0f, kMax));
  if (largest < kMin) return void(std::memset(to, 0, kPixel));
  int exponent = 0;
  const float scale = std::frexp(largest, &exponent) * 256.0f / largest;
  for (size_t c = 0; c < 3; c++) to[c] = static_cast<uint8_t>(values[c] * scale);
  to[3] = static_cast<uint8_t>(exponent + 128);
}

// Packs one component of a row: runs of at least four equal bytes, and the bytes between them.
void pack_component(const uint8_t* row, size_t length, std::vector<uint8_t>& to) {
  constexpr size_t kShortestRun = 4, kLongestRun = 127, kMaxBytes = 128;
  const auto run_at = [&](size_t x) {
    size_t end = x + 1;
    while (end < length && end - x < kLongestRun && row[end * kPixel] == row[x * kPixel]) end++;
    return end - x;
  };
  for (size_t x = 0; x < length;) {
    size_t end = x, run = 0;
    while (end < length && (run = run_at(end)) < kShortestRun) end += run;
    if (end >= length) run = 0;
    while (x < end) {
      const size_t count = std::min(end - x, kMaxBytes);
      to.push_back(static_cast<uint8_t>(count));
      for (const size_t stop = x + count; x < stop; x++) to.push_back(row[x * kPixel]);
    }
    if (run == 0) continue;
    to.push_back(static_cast<uint8_t>(128 + run)), to.push_back(row[x * kPixel]);
    x += run;
  }
}

class HdrEncoder final : public Encoder {
 public:
  HdrEncoder(ByteSink& sink, const FileHeader& header)
      : sink_(sink), length_(static_cast<size_t>(header.width)), row_(kPixel * length_) {
    if (header.channels.size() != 3 || header.channels[0].sample != SampleType::kFloat) {
      throw cannot_write(sink, "an HDR has three channels of floats");
    }
    const std::string head =
        fmt::format("#?RADIANCE\nFORMAT={}\n\n-Y {} +X {}\n", kFormat, header.height, header.width);
    sink_.write(head.data(), head.size());
  }
  void write(int begin, int end, const std::byte* rows) override;
  void finish() override {}

 private:
  ByteSink& sink_;
  size_t length_;
  std::vector<uint8_t> row_, packed_;
};

void HdrEncoder::write(int begin, int end, const std::byte* rows) {
  for (int y = begin; y < end; y++) {
    for (size_t x = 0; x < length_; x++) {
      float light[3];
      std::memcpy(light, rows, sizeof light);
      rows += sizeof light;
      put_pixel(light, &row_[x * kPixel]);
    }
    if (length_ < kShortestPacked || length_ > kLongestPacked) {
      sink_.write(row_.data(), row_.size());
      continue;
    }
    packed_ = {2, 2, static_cast<uint8_t>(length_ >> 8), static_cast<uint8_t>(length_ & 0xff)};
    for (size_t c = 0; c < kPixel; c++) pack_component(&row_[c], length_, packed_);
    sink_.write(packed_.data(), packed_.size());
  }
}

}  // namespace

std::unique_ptr<Encoder> create_hdr(ByteSink& sink, const FileHeader& header) {
  return std::make_unique<HdrEncoder>(sink, header);
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Encodes TIFF through libtiff, compressed by libdeflate.
#include <libdeflate.h>
#include <tbb/parallel_for.h>
#include <tiffio.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>
#include <span>

#include "ods/image/codec/encoder.h"
#include "ods/image/codec/tiff_stream.h"
#include "ods/image/format/xmp.h"

namespace ods {

namespace {

class TiffOutput final : public TiffStream {
 public:
  explicit TiffOutput(ByteSink& sink) : sink_(sink) {}
  size_t read(void*, size_t) override { return 0; }
  void write(const void* from, size_t count) override {
    if (at != sink_.position()) sink_.seek(at);
    sink_.write(from, count);
    at += count;
    size_ = std::max(size_, at);
  }
  uint64_t size() override { return size_; }

 private:
  ByteSink& sink_;
  uint64_t size_ = 0;
};

constexpr size_t kRowsPerStrip = 16;

// Strips of 16 rows, several compressed at once by libdeflate, with differences of adjacent samples if the numbers are
// integers.
class TiffEncoder final : public Encoder {
 public:
  TiffEncoder(ByteSink& sink, const FileHeader& header);
  void write(int begin, int end, const std::byte* rows) override;
  void finish() override;

 private:
  void set_fields();
  void write_strips();
  std::vector<std::byte> packed(std::span<std::byte> strip) const;
  Error failed() const { return cannot_write(sink_, output_.words); }

  ByteSink& sink_;
  const FileHeader& header_;
  TiffOutput output_;
  TiffHandle handle_;
  size_t row_size_;
  uint32_t strips_ = 0;          // number of written strips
  std::vector<std::byte> rows_;  // rows that are not written yet
};

TiffEncoder::TiffEncoder(ByteSink& sink, const FileHeader& header)
    : sink_(sink),
      header_(header),
      output_(sink),
      row_size_(bytes_of_pixel(header) * static_cast<size_t>(header.width)) {
  constexpr uint64_t kLongest = std::numeric_limits<uint32_t>::max() - (uint32_t{1} << 26);
  const bool is_big = row_size_ * static_cast<size_t>(header.height) > kLongest;
  handle_ = open_tiff_handle(output_, sink.path(), is_big ? "w8" : "w", 0);
  if (!handle_) throw failed();
  set_fields();
}

void TiffEncoder::set_fields() {
  TIFF* const tiff = handle_.get();
  const size_t channels = header_.channels.size();
  const SampleType sample = header_.channels[0].sample;
  const bool is_float = sample == SampleType::kHalf || sample == SampleType::kFloat;
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, header_.width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, header_.height);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * bytes_of(sample)));
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, is_float ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, static_cast<int>(channels));
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, channels < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, static_cast<int>(kRowsPerStrip));
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  if (!is_float) TIFFSetField(tiff, TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
  const uint16_t alpha = is_float ? EXTRASAMPLE_ASSOCALPHA : EXTRASAMPLE_UNASSALPHA;
  if (header_.channels.back().name == "A") TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &alpha);
  for (const Attribute& attribute : header_.attributes) {
    const std::string* text = std::get_if<std::string>(&attribute.value);
    if (text && attribute.name == "Software") TIFFSetField(tiff, TIFFTAG_SOFTWARE, text->c_str());
  }
  const std::string xmp = gpano_xmp(header_.attributes);
  if (!xmp.empty()) TIFFSetField(tiff, TIFFTAG_XMLPACKET, static_cast<uint32_t>(xmp.size()), xmp.data());
}

template <class T>
void subtract_neighbours(std::span<std::byte> row, size_t channels) {
  for (size_t at = row.size(); at >= (channels + 1) * sizeof(T); at -= sizeof(T)) {
    T value, before;
    std::memcpy(&value, &row[at - sizeof(T)], sizeof(T));
    std::memcpy(&before, &row[at - (channels + 1) * sizeof(T)], sizeof(T));
    value = static_cast<T>(value - before);
    std::memcpy(&row[at - sizeof(T)], &value, sizeof(T));
  }
}

std::vector<std::byte> TiffEncoder::packed(std::span<std::byte> strip) const {
  const SampleType sample = header_.channels[0].sample;
  for (size_t at = 0; at < strip.size(); at += row_size_) {
    const std::span<std::byte> row = strip.subspan(at, row_size_);
    if (sample == SampleType::kUint8) subtract_neighbours<uint8_t>(row, header_.channels.size());
    if (sample == SampleType::kUint16) subtract_neighbours<uint16_t>(row, header_.channels.size());
  }
  constexpr int kLevel = 6;
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> packer(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  if (!packer) throw std::bad_alloc();
  std::vector<std::byte> bytes(libdeflate_zlib_compress_bound(packer.get(), strip.size()));
  bytes.resize(libdeflate_zlib_compress(packer.get(), strip.data(), strip.size(), bytes.data(), bytes.size()));
  return bytes;
}

void TiffEncoder::write_strips() {
  const size_t size = kRowsPerStrip * row_size_, count = (rows_.size() + size - 1) / size;
  std::vector<std::vector<std::byte>> strips(count);
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    strips[i] = packed({&rows_[i * size], std::min(size, rows_.size() - i * size)});
  });
  for (std::vector<std::byte>& strip : strips) {
    const tmsize_t length = static_cast<tmsize_t>(strip.size());
    if (TIFFWriteRawStrip(handle_.get(), strips_++, strip.data(), length) != length) throw failed();
  }
  rows_.clear();
}

void TiffEncoder::write(int begin, int end, const std::byte* rows) {
  for (int y = begin; y < end; y++, rows += row_size_) {
    rows_.insert(rows_.end(), rows, rows + row_size_);
    const bool is_whole = rows_.size() % (kRowsPerStrip * row_size_) == 0;
    if (is_whole && (end - y <= static_cast<int>(kRowsPerStrip))) write_strips();
  }
}

void TiffEncoder::finish() {
  if (!rows_.empty()) write_strips();
  if (!TIFFWriteDirectory(handle_.get())) throw failed();
  handle_.reset();
}

}  // namespace

std::unique_ptr<Encoder> create_tiff(ByteSink& sink, const FileHeader& header) {
  return std::make_unique<TiffEncoder>(sink, header);
}

}  // namespace ods

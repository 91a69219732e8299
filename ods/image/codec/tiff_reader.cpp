// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Decodes TIFF through libtiff: the first picture of a file. Its orientation is not applied.
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tiffio.h>

#include <algorithm>
#include <mutex>

#include "ods/base/text.h"
#include "ods/image/codec/decoder.h"
#include "ods/image/codec/tiff_samples.h"
#include "ods/image/codec/tiff_stream.h"
#include "ods/image/format/image_limits.h"

namespace ods {

namespace {

template <class T>
T field(TIFF* tiff, uint32_t tag, T otherwise) {
  T value = otherwise;
  return TIFFGetFieldDefaulted(tiff, tag, &value) == 1 ? value : otherwise;
}

// One of several handles of a file: each thread decodes with its own one.
class TiffInput final : public TiffStream {
 public:
  explicit TiffInput(const PictureBytes& file) : file_(file) {
    const uint64_t kMin = uint64_t{1} << 28;
    handle_ = open_tiff_handle(*this, file.name, "rm", std::max<uint64_t>(kMin, file.size + kMin));
    if (!handle_) throw failed();
    const bool is_jpeg = field<uint16_t>(tiff(), TIFFTAG_COMPRESSION, COMPRESSION_NONE) == COMPRESSION_JPEG;
    if (is_jpeg) TIFFSetField(tiff(), TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
  }
  TIFF* tiff() const { return handle_.get(); }
  Error failed() const {
    return cannot_read(file_.name, words[0] ? library_message(words) : "the TIFF is cut short or damaged");
  }

  size_t read(void* to, size_t count) override {
    const size_t here = std::min<uint64_t>(count, file_.size - std::min<uint64_t>(at, file_.size));
    if (here == 0 || !file_.read(at, to, here)) return 0;
    at += here;
    return here;
  }
  void write(const void*, size_t) override {}
  uint64_t size() override { return file_.size; }

 private:
  PictureBytes file_;
  TiffHandle handle_;
};

// The tiles or strips of a picture.
struct TiffBlocks {
  bool are_tiles = false;
  uint32_t width = 0, height = 0;  // size of each
  uint64_t bytes = 0;              // size of each, in one plane
  uint64_t row_bytes = 0;          // size of a row in a block
};

enum class TiffWay {
  kBlocks,  // whole tiles or strips, several at once
  kLines,   // strips too large for kBlocks, row by row
  kRgba     // colour spaces and compressions that libtiff converts to RGBA
};

class TiffDecoder final : public Decoder {
 public:
  explicit TiffDecoder(const PictureBytes& file);
  void read(int begin, int end, size_t first, size_t count, std::byte* to) override;

 private:
  struct Rows {  // wanted rows
    int begin, end;
    size_t first, count;
    std::byte* to;
  };
  void describe(TIFF* tiff);
  void describe_rgba(TIFF* tiff);
  void find_blocks(const TiffInput& input);
  void check_amount() const;
  void read_blocks(const Rows& rows);
  void read_block(const Rows& rows, uint32_t left, uint32_t top);
  void read_lines(const Rows& rows);
  void read_line(size_t plane, int y, std::byte* to);
  void read_plain_line(const TiffInput& input, size_t plane, int y, std::byte* to) const;
  void read_rgba(const Rows& rows);
  std::unique_ptr<TiffInput> take_input();
  void give_back(std::unique_ptr<TiffInput> input);
  std::byte* place_of(const Rows& rows, size_t x, int y) const {
    const size_t pixel = bytes_of_pixel(rows.first, rows.count), width = static_cast<size_t>(info.width);
    return rows.to + pixel * (static_cast<size_t>(y - rows.begin) * width + x);
  }

  PictureBytes file_;
  TiffSamples samples_;
  TiffBlocks blocks_;
  TiffWay way_ = TiffWay::kBlocks;
  std::mutex inputs_mutex_;
  std::vector<std::unique_ptr<TiffInput>> inputs_;  // unused ones
  struct Line {                                     // a line of one plane
    std::unique_ptr<TiffInput> input;
    int next = 0;
  };
  std::vector<Line> lines_;
};

// --- the header

TiffNumber number_of(uint16_t format) {
  if (format == SAMPLEFORMAT_INT) return TiffNumber::kSigned;
  return format == SAMPLEFORMAT_IEEEFP ? TiffNumber::kFloat : TiffNumber::kUnsigned;
}

std::vector<std::string> names_of(size_t channels) {
  if (channels == 1) return {"Y"};
  if (channels == 2) return {"Y", "A"};
  std::vector<std::string> names = {"R", "G", "B", "A"};
  for (size_t c = 4; c < channels; c++) names.push_back(fmt::format("channel{}", c));
  names.resize(channels);
  return names;
}

// The extra samples specify which channel is alpha. Without their kinds, it is where names_of() expects it.
void find_alpha(TIFF* tiff, TiffSamples& samples) {
  std::vector<std::string>& channels = samples.channels;
  uint16_t count = 0;
  uint16_t* kinds = nullptr;
  const auto usual = std::find(channels.begin(), channels.end(), "A");
  const bool is_declared = TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds) == 1;
  if (!is_declared && usual != channels.end()) samples.alpha = usual - channels.begin(), samples.is_associated = true;
  if (!is_declared || count > channels.size()) return;
  if (usual != channels.end()) *usual = fmt::format("channel{}", usual - channels.begin());
  for (size_t i = 0; i < count; i++) {
    if (kinds[i] != EXTRASAMPLE_ASSOCALPHA && kinds[i] != EXTRASAMPLE_UNASSALPHA) continue;
    samples.alpha = channels.size() - count + i;
    samples.is_associated = kinds[i] == EXTRASAMPLE_ASSOCALPHA;
  }
  if (samples.alpha) channels[*samples.alpha] = "A";
}

// Palettes have 16 bits each; some programs write 8.
void read_palette(TIFF* tiff, TiffSamples& samples) {
  const uint16_t* colors[3] = {};
  if (samples.bits > 8 || !TIFFGetField(tiff, TIFFTAG_COLORMAP, &colors[0], &colors[1], &colors[2])) return;
  const size_t count = size_t{1} << samples.bits;
  const bool is_narrow = std::all_of(std::begin(colors), std::end(colors), [&](const uint16_t* each) {
    return std::all_of(each, each + count, [](uint16_t value) { return value < 256; });
  });
  for (size_t i = 0; i < count; i++) {
    std::array<uint8_t, 3>& color = samples.palette.emplace_back();
    for (size_t c = 0; c < 3; c++) color[c] = static_cast<uint8_t>(is_narrow ? colors[c][i] : colors[c][i] >> 8);
  }
}

void TiffDecoder::describe(TIFF* tiff) {
  const size_t inputs = field<uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  const auto photometric = field<uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  samples_.inputs = inputs;
  samples_.bits = field<uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1);
  samples_.number = number_of(field<uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT));
  samples_.is_separate = inputs > 1 && field<uint16_t>(tiff, TIFFTAG_PLANARCONFIG, 1) == PLANARCONFIG_SEPARATE;
  const std::optional<SampleType> sample = tiff_sample(samples_.number, samples_.bits);
  constexpr size_t kMaxChannels = 1024;
  if (!sample) {
    throw cannot_read(file_.name,
                      fmt::format("its numbers of {} bits are of a kind that ods does not read; save it with "
                                  "8 or 16 bits, or as floats",
                                  samples_.bits));
  }
  if (inputs < 1 || inputs > kMaxChannels) {
    throw cannot_read(file_.name, fmt::format("it has {} channels; at most {} are read", inputs, kMaxChannels));
  }
  samples_.sample = *sample;
  samples_.zero_is_white = photometric == PHOTOMETRIC_MINISWHITE && !samples_.is_float();
  samples_.is_ink = photometric == PHOTOMETRIC_SEPARATED && inputs >= 4 &&
                    field<uint16_t>(tiff, TIFFTAG_INKSET, INKSET_CMYK) == INKSET_CMYK;
  if (samples_.is_ink && samples_.is_float()) throw cannot_read(file_.name, "its inks are floats; save it in RGB");
  if (photometric == PHOTOMETRIC_PALETTE) {
    read_palette(tiff, samples_);
    if (samples_.palette.empty()) throw cannot_read(file_.name, "its palette is missing or damaged");
    samples_.sample = SampleType::kUint8;
  }
  samples_.channels = names_of(!samples_.palette.empty() ? 3 : samples_.is_ink ? inputs - 1 : inputs);
  if (samples_.palette.empty()) find_alpha(tiff, samples_);
}

// The output of libtiff's conversion: red, green, blue of 8 bits.
void TiffDecoder::describe_rgba(TIFF* tiff) {
  char why[1024] = "";
  if (!TIFFRGBAImageOK(tiff, why)) throw cannot_read(file_.name, library_message(why));
  const bool is_grey = field<uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1) == 1;
  samples_ = {};
  samples_.inputs = 4;
  samples_.channels = names_of(is_grey ? 1 : 3);
}

// Returns whether a file's samples are not supported by TiffSamples.
bool is_unusual(TIFF* tiff) {
  const auto compression = field<uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  const bool is_separate = field<uint16_t>(tiff, TIFFTAG_PLANARCONFIG, 1) == PLANARCONFIG_SEPARATE;
  switch (field<uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK)) {
    case PHOTOMETRIC_YCBCR:
      return compression != COMPRESSION_JPEG || is_separate;
    case PHOTOMETRIC_CIELAB:
    case PHOTOMETRIC_ICCLAB:
    case PHOTOMETRIC_ITULAB:
    case PHOTOMETRIC_LOGL:
    case PHOTOMETRIC_LOGLUV:
      return true;
    default:
      return compression == COMPRESSION_OJPEG;
  }
}

// Called before pixels are allocated.
void TiffDecoder::find_blocks(const TiffInput& input) {
  TIFF* const tiff = input.tiff();
  const auto side = [&](uint32_t tag, uint32_t otherwise) {
    return static_cast<int>(std::min(field<uint32_t>(tiff, tag, otherwise), uint32_t{1} << 30));
  };
  info.width = side(TIFFTAG_IMAGEWIDTH, 0), info.height = side(TIFFTAG_IMAGELENGTH, 0);
  check_picture_size(file_, info.width, info.height);
  if (side(TIFFTAG_IMAGEDEPTH, 1) > 1) throw cannot_read(file_.name, "it is not a flat image");
  blocks_.are_tiles = TIFFIsTiled(tiff) != 0;
  if (blocks_.are_tiles) {
    check_picture_size(file_, side(TIFFTAG_TILEWIDTH, 0), side(TIFFTAG_TILELENGTH, 0));
    blocks_.width = field<uint32_t>(tiff, TIFFTAG_TILEWIDTH, 0);
    blocks_.height = field<uint32_t>(tiff, TIFFTAG_TILELENGTH, 0);
    blocks_.bytes = TIFFTileSize64(tiff), blocks_.row_bytes = TIFFTileRowSize64(tiff);
  } else {
    const uint32_t height = static_cast<uint32_t>(info.height);
    blocks_.width = static_cast<uint32_t>(info.width);
    blocks_.height = std::min(height, field<uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP, height));
    blocks_.bytes = TIFFVStripSize64(tiff, blocks_.height), blocks_.row_bytes = TIFFScanlineSize64(tiff);
  }
  if (blocks_.height < 1 || blocks_.bytes < 1 || blocks_.row_bytes < 1) throw input.failed();
}

// A few bytes may claim many numbers for each pixel.
void TiffDecoder::check_amount() const {
  constexpr int64_t kUsual = 4;  // numbers per pixel
  const int64_t maximum = std::max(kSmallPixels, kMaxPixelsPerByte * static_cast<int64_t>(file_.size));
  const int64_t pixels = std::max(int64_t{info.width} * info.height, int64_t{blocks_.width} * blocks_.height);
  if (pixels * static_cast<int64_t>(samples_.inputs) <= kUsual * maximum) return;
  throw cannot_read(file_.name, fmt::format("{}x{} pixels of {} numbers in {} bytes: the file is broken or hostile",
                                            info.width, info.height, samples_.inputs, file_.size));
}

TiffDecoder::TiffDecoder(const PictureBytes& file) : file_(file) {
  auto input = std::make_unique<TiffInput>(file);
  TIFF* const tiff = input->tiff();
  find_blocks(*input);
  constexpr uint64_t kLargestStrip = uint64_t{1} << 23;
  if (is_unusual(tiff)) {
    way_ = TiffWay::kRgba;
    describe_rgba(tiff);
  } else {
    describe(tiff);
    const size_t planes = samples_.is_separate ? samples_.inputs : 1;
    if (!blocks_.are_tiles && blocks_.bytes * planes > kLargestStrip) {
      way_ = TiffWay::kLines;
      lines_.resize(planes);
    }
  }
  check_amount();
  info.channels = samples_.channels;
  info.samples.assign(info.channels.size(), samples_.sample);
  info.is_float = samples_.is_float();
  rows_together = way_ == TiffWay::kLines ? 1 : static_cast<int>(blocks_.height);
  const char* word = nullptr;
  if (TIFFGetField(tiff, TIFFTAG_PIXAR_TEXTUREFORMAT, &word) == 1 && word) info.text["textureformat"] = word;
  give_back(std::move(input));
}

// --- the pixels

std::unique_ptr<TiffInput> TiffDecoder::take_input() {
  {
    const std::lock_guard lock(inputs_mutex_);
    if (!inputs_.empty()) {
      std::unique_ptr<TiffInput> input = std::move(inputs_.back());
      inputs_.pop_back();
      return input;
    }
  }
  return std::make_unique<TiffInput>(file_);
}

void TiffDecoder::give_back(std::unique_ptr<TiffInput> input) {
  const std::lock_guard lock(inputs_mutex_);
  inputs_.push_back(std::move(input));
}

// Reads the wanted rows of the block with this corner.
void TiffDecoder::read_block(const Rows& rows, uint32_t left, uint32_t top) {
  TiffRows convert(samples_, rows.first, rows.count);
  std::vector<std::byte> bytes(blocks_.bytes * convert.planes());
  std::unique_ptr<TiffInput> input = take_input();
  for (size_t p = 0; p < convert.planes(); p++) {
    const auto plane = static_cast<uint16_t>(convert.first_plane() + p);
    std::byte* const to = &bytes[p * blocks_.bytes];
    const auto size = static_cast<tmsize_t>(blocks_.bytes);
    const tmsize_t done =
        blocks_.are_tiles
            ? TIFFReadEncodedTile(input->tiff(), TIFFComputeTile(input->tiff(), left, top, 0, plane), to, size)
            : TIFFReadEncodedStrip(input->tiff(), TIFFComputeStrip(input->tiff(), top, plane), to, size);
    if (done < 0) throw input->failed();
  }
  give_back(std::move(input));
  const size_t width = std::min(blocks_.width, static_cast<uint32_t>(info.width) - left);
  std::vector<const std::byte*> planes(convert.planes());
  const int from = static_cast<int>(top), end = std::min(rows.end, from + static_cast<int>(blocks_.height));
  for (int y = std::max(from, rows.begin); y < end; y++) {
    for (size_t p = 0; p < planes.size(); p++) {
      planes[p] = &bytes[p * blocks_.bytes + static_cast<size_t>(y - from) * blocks_.row_bytes];
    }
    convert.convert(planes, width, place_of(rows, left, y));
  }
}

void TiffDecoder::read_blocks(const Rows& rows) {
  const uint32_t begin = static_cast<uint32_t>(rows.begin) / blocks_.height;
  const uint32_t end = (static_cast<uint32_t>(rows.end) + blocks_.height - 1) / blocks_.height;
  const uint32_t across = (static_cast<uint32_t>(info.width) + blocks_.width - 1) / blocks_.width;
  tbb::parallel_for(begin * across, end * across,
                    [&](uint32_t i) { read_block(rows, i % across * blocks_.width, i / across * blocks_.height); });
}

// libtiff would read the whole of an uncompressed strip.
void TiffDecoder::read_plain_line(const TiffInput& input, size_t plane, int y, std::byte* to) const {
  const uint32_t row = static_cast<uint32_t>(y),
                 strip = TIFFComputeStrip(input.tiff(), row, static_cast<uint16_t>(plane));
  const uint64_t start = TIFFGetStrileOffset(input.tiff(), strip),
                 at = start + row % blocks_.height * blocks_.row_bytes;
  const tmsize_t size = static_cast<tmsize_t>(blocks_.row_bytes);
  if (start == 0 || at > file_.size || !file_.read(at, to, blocks_.row_bytes)) throw input.failed();
  if (!TIFFIsByteSwapped(input.tiff())) return;
  void* const numbers = to;
  if (samples_.bits == 16) TIFFSwabArrayOfShort(static_cast<uint16_t*>(numbers), size / 2);
  if (samples_.bits == 24) TIFFSwabArrayOfTriples(static_cast<uint8_t*>(numbers), size / 3);
  if (samples_.bits == 32) TIFFSwabArrayOfLong(static_cast<uint32_t*>(numbers), size / 4);
  if (samples_.bits == 64) TIFFSwabArrayOfDouble(static_cast<double*>(numbers), size / 8);
}

// A strip can only be decoded from its first row on.
void TiffDecoder::read_line(size_t plane, int y, std::byte* to) {
  Line& line = lines_[plane];
  if (!line.input) line.input = take_input();
  TIFF* const tiff = line.input->tiff();
  const bool is_plain = field<uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE) == COMPRESSION_NONE &&
                        field<uint16_t>(tiff, TIFFTAG_FILLORDER, FILLORDER_MSB2LSB) == FILLORDER_MSB2LSB;
  if (is_plain) return read_plain_line(*line.input, plane, y, to);
  const int top = y - y % static_cast<int>(blocks_.height);
  if (y < line.next || line.next < top) line.next = top;
  for (; line.next <= y; line.next++) {
    const int good = TIFFReadScanline(tiff, to, static_cast<uint32_t>(line.next), static_cast<uint16_t>(plane));
    if (good < 0) throw line.input->failed();
  }
}

void TiffDecoder::read_lines(const Rows& rows) {
  TiffRows convert(samples_, rows.first, rows.count);
  std::vector<std::byte> bytes(blocks_.row_bytes * convert.planes());
  std::vector<const std::byte*> planes(convert.planes());
  for (int y = rows.begin; y < rows.end; y++) {
    for (size_t p = 0; p < planes.size(); p++) {
      planes[p] = &bytes[p * blocks_.row_bytes];
      read_line(convert.first_plane() + p, y, &bytes[p * blocks_.row_bytes]);
    }
    convert.convert(planes, static_cast<size_t>(info.width), place_of(rows, 0, y));
  }
}

void TiffDecoder::read_rgba(const Rows& rows) {
  const std::unique_ptr<TiffInput> input = take_input();
  char why[1024] = "";
  TIFFRGBAImage image;
  if (!TIFFRGBAImageBegin(&image, input->tiff(), 1, why)) throw cannot_read(file_.name, library_message(why));
  const std::unique_ptr<TIFFRGBAImage, void (*)(TIFFRGBAImage*)> ending(&image, TIFFRGBAImageEnd);
  image.orientation = image.req_orientation = ORIENTATION_TOPLEFT;
  image.row_offset = rows.begin;
  const size_t width = static_cast<size_t>(info.width), height = static_cast<size_t>(rows.end - rows.begin);
  std::vector<uint32_t> pixels(width * height);  // red in the lowest byte
  if (!TIFFRGBAImageGet(&image, pixels.data(), static_cast<uint32_t>(width), static_cast<uint32_t>(height))) {
    throw input->failed();
  }
  TiffRows convert(samples_, rows.first, rows.count);
  for (size_t y = 0; y < height; y++) {
    const auto* row = reinterpret_cast<const std::byte*>(&pixels[y * width]);
    convert.convert({&row, 1}, width, place_of(rows, 0, rows.begin + static_cast<int>(y)));
  }
}

void TiffDecoder::read(int begin, int end, size_t first, size_t count, std::byte* to) {
  const Rows rows{begin, end, first, count, to};
  if (way_ == TiffWay::kBlocks) return read_blocks(rows);
  way_ == TiffWay::kLines ? read_lines(rows) : read_rgba(rows);
}

}  // namespace

std::unique_ptr<Decoder> open_tiff(const PictureBytes& file) {
  return std::make_unique<TiffDecoder>(file);
}

}  // namespace ods

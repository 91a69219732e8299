// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>

#include "ods/base/error.h"
#include "ods/base/suggest.h"
#include "ods/base/text.h"
#include "ods/files/read_file.h"
#include "ods/image/codec/exr_rows.h"
#include "ods/image/codec/openimageio.h"
#include "ods/image/color_tags.h"
#include "ods/image/format/exr_guard.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/image_file.h"
#include "ods/image/tone.h"

namespace ods::openimageio {

static OIIO::TypeDesc type_of(SampleType sample) {
  return OIIO::TypeDesc(type_name(sample));
}

static void check_size(const OIIO::ImageSpec& spec, size_t file_size, const std::string& name) {
  if (spec.deep || spec.depth > 1 || spec.nchannels < 1) throw cannot_read(name, "it is not a flat image");
  const int longest = std::max({spec.width, spec.height, spec.tile_width, spec.tile_height});
  const std::string fault = image_size_fault(spec.width, spec.height, longest, file_size);
  if (!fault.empty()) throw cannot_read(name, fault);
}

namespace {

// What OpenImageIO reads of a PNG.
class PngSource final : public OIIO::Filesystem::IOProxy {
 public:
  explicit PngSource(FileParts parts) : IOProxy("", Read), parts_(std::move(parts)) {}
  const char* proxytype() const override { return "ods"; }
  size_t size() const override { return parts_.size(); }
  bool seek(int64_t offset) override { return m_pos = offset, true; }
  size_t read(void* to, size_t size) override {
    const size_t done = pread(to, size, m_pos);
    m_pos += static_cast<int64_t>(done);
    return done;
  }
  size_t pread(void* to, size_t size, int64_t offset) override {
    return parts_.read(static_cast<size_t>(offset), to, size);
  }

 private:
  FileParts parts_;
};

struct Reader {
  std::unique_ptr<OIIO::Filesystem::IOProxy> source;  // where OpenImageIO does not open the file itself
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
  FileFormat format;
  FileInfo info;
  ColorSpace color;
};

}  // namespace

// In a file of floats whole numbers are as large as floats, and become such.
static SampleType sample_of(const OIIO::TypeDesc& type, bool is_float) {
  for (const SampleType sample : {SampleType::kUint8, SampleType::kUint16, SampleType::kHalf}) {
    if (type == type_of(sample)) return sample;
  }
  return is_float ? SampleType::kFloat : SampleType::kUint16;
}

static FileInfo info_of(const OIIO::ImageSpec& spec) {
  FileInfo info;
  info.width = spec.width;
  info.height = spec.height;
  info.channels = spec.channelnames;
  for (int c = 0; c < spec.nchannels; c++) {
    info.is_float = info.is_float || spec.channelformat(c).is_floating_point();
  }
  for (int c = 0; c < spec.nchannels; c++) info.samples.push_back(sample_of(spec.channelformat(c), info.is_float));
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    const std::string name = attribute.name().string();
    if (attribute.type() == OIIO::TypeString) info.text[name] = attribute.get_string();
    const size_t count = attribute.type().basevalues();  // get_float_indexed() knows no vectors
    const float* floats = static_cast<const float*>(attribute.data());
    const int* ints = static_cast<const int*>(attribute.data());
    const auto base = attribute.type().basetype;
    if (base == OIIO::TypeDesc::FLOAT) info.numbers[name].assign(floats, floats + count);
    if (base == OIIO::TypeDesc::INT) info.numbers[name].assign(ints, ints + count);
  }
  return info;
}

constexpr std::string_view kVideoExtensions[] = {".mp4", ".mov", ".mkv", ".webm"};  // for a message

static bool is_named_as_video(const std::string& name) {
  const std::string low = small_letters(name);
  return std::any_of(std::begin(kVideoExtensions), std::end(kVideoExtensions),
                     [&](std::string_view extension) { return low.ends_with(extension); });
}

// `start` is that of the file.
static Reader create_reader(std::span<const std::byte> start, const std::string& name) {
  set_up_openimageio();
  const std::optional<FileFormat> format = format_of_bytes(start);
  if (!format && is_named_as_video(name)) {
    throw cannot_read(name,
                      "it is a video; ods convert VIDEO -o 'x.####.png' makes pictures of it; ods "
                      "probe, lint, inject, view and over take videos, too");
  }
  if (!format) {
    const std::string_view bytes(reinterpret_cast<const char*>(start.data()), start.size());
    throw cannot_read(name, fmt::format("it is none of {}{}", known_extensions(), taken_by(bytes)));
  }
  Reader reader;
  reader.format = *format;
  reader.input = OIIO::ImageInput::create(plugin_name(*format));
  if (!reader.input) throw cannot_read(name, no_plugin(plugin_name(*format), "reader"));
  return reader;
}

// libpng comments on damaged files; libjpeg fills what is missing with grey, and only warns; OpenEXR makes room first.
static void check_whole(Reader& reader, size_t size, const ByteReader& bytes, const std::string& name) {
  if (reader.format == FileFormat::kJpeg && !is_whole_jpeg(size, bytes)) {
    throw cannot_read(name, "the JPEG is cut short or damaged");
  }
  if (reader.format == FileFormat::kExr) {
    const std::string fault = exr_header_fault(size, bytes);
    if (!fault.empty()) throw cannot_read(name, fault);
  }
  if (reader.format != FileFormat::kPng) return;
  std::optional<std::vector<FileRange>> parts = essential_png(size, bytes);
  if (!parts) throw cannot_read(name, "the PNG is cut short or damaged");
  reader.source = std::make_unique<PngSource>(FileParts(bytes, std::move(*parts)));
}

static void open(Reader& reader, size_t file_size, const std::string& name, bool keep_alpha) {
  if (reader.source) reader.input->set_ioproxy(reader.source.get());
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", keep_alpha ? 1 : 0);
  if (!reader.input->open(name, reader.spec, config)) throw cannot_read(name, library_words(reader.input->geterror()));
  check_size(reader.spec, file_size, name);
  reader.info = info_of(reader.spec);
}

static Reader open_reader(const std::string& path, bool keep_alpha = true) {
  const std::vector<unsigned char> start = read_start(path, 16);
  Reader reader = create_reader(std::as_bytes(std::span(start)), path);
  const auto file = std::make_shared<OIIO::Filesystem::IOFile>(path, OIIO::Filesystem::IOProxy::Read);
  const ByteReader bytes = [file](size_t offset, void* to, size_t count) {
    return file->pread(to, count, static_cast<int64_t>(offset)) == count;
  };
  check_whole(reader, file->size(), bytes, path);
  open(reader, file->size(), path, keep_alpha);
  reader.color = read_color_space(path, reader.format, reader.info);
  reader.info.color = reader.color.name;
  reader.info.color_fault = reader.color.fault;
  return reader;
}

static Reader open_memory(std::span<const std::byte> file, const std::string& name) {
  Reader reader = create_reader(file, name);
  const ByteReader bytes = [file](size_t offset, void* to, size_t count) {
    if (offset > file.size() || count > file.size() - offset) return false;
    std::memcpy(to, file.data() + offset, count);
    return true;
  };
  check_whole(reader, file.size(), bytes, name);
  if (!reader.source) {
    reader.source = std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<std::byte*>(file.data()), file.size());
  }
  open(reader, file.size(), name, true);
  return reader;
}

// Channels of a file, by their numbers and in their order, as floats.
static Image read_floats(Reader& reader, const std::vector<int>& indices, const std::string& path) {
  const int count = static_cast<int>(indices.size());
  Image image(reader.spec.width, reader.spec.height, count);
  // At once where they are neighbours, as decoding one decodes all.
  bool neighbours = true;
  for (int c = 0; c < count; c++) neighbours = neighbours && indices[static_cast<size_t>(c)] == indices[0] + c;
  const int step = neighbours ? count : 1;
  const OIIO::stride_t pixel = count * static_cast<OIIO::stride_t>(sizeof(float));
  for (int c = 0; c < count; c += step) {
    const int first = indices[static_cast<size_t>(c)];
    float* out = image.pixels.data() + c;
    if (!reader.input->read_image(0, 0, first, first + step, OIIO::TypeDesc::FLOAT, out, pixel)) {
      throw cannot_read(path, library_words(reader.input->geterror()));
    }
  }
  return image;
}

Image read_image(const std::string& path, std::string* color_fault) {
  Reader reader = open_reader(path);
  Image image = read_floats(reader, reader.spec.nchannels < 3 ? std::vector{0, 0, 0} : std::vector{0, 1, 2}, path);
  const bool is_float = reader.spec.format.is_floating_point();
  for (size_t i = 0; i < image.pixels.size() && !(is_float && reader.color.has_our_primaries); i += 3) {
    vec3 value(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]);
    value = is_float ? light_of_floats(reader.color, value) : linear_from_encoded(reader.color, value);
    std::copy_n(&value.x, 3, &image.pixels[i]);
  }
  if (color_fault) *color_fault = reader.color.fault;
  return image;
}

FileInfo read_info(const std::string& path) {
  return open_reader(path).info;
}

Image read_channels(const std::string& path, const std::vector<std::string>& names) {
  Reader reader = open_reader(path);
  std::vector<int> indices;
  for (const std::string& name : names) {
    indices.push_back(reader.spec.channelindex(name));
    if (indices.back() < 0) throw cannot_read(path, fmt::format("it has no channel '{}'", name));
  }
  Image image = read_floats(reader, indices, path);
  if (!reader.spec.format.is_floating_point()) {
    for (float& value : image.pixels) value = srgb_decode(value);
  }
  return image;
}

// The first `count` channels, converted to the type of `Code`.
template <class Code>
static std::vector<Code> read_codes(Reader& reader, int count, const std::string& name) {
  std::vector<Code> values(static_cast<size_t>(reader.spec.width) * static_cast<size_t>(reader.spec.height) *
                           static_cast<size_t>(count));
  if (!reader.input->read_image(0, 0, 0, count, OIIO::BaseTypeFromC<Code>::value, values.data())) {
    throw cannot_read(name, library_words(reader.input->geterror()));
  }
  return values;
}

CodeImage decode_image(std::span<const std::byte> file, const std::string& name, bool keep_depth) {
  Reader reader = open_memory(file, name);
  const int count = std::min(reader.spec.nchannels, 4);
  CodeImage image{reader.spec.width, reader.spec.height, {}, {}};
  if (keep_depth && reader.spec.format == OIIO::TypeDesc::UINT16) {
    const std::vector<uint16_t> values = read_codes<uint16_t>(reader, count, name);
    for (size_t i = 0; i < values.size(); i += static_cast<size_t>(count)) {
      for (size_t c = 0; c < 3; c++) image.deep.push_back(values[i + (count < 3 ? 0 : c)]);
    }
    return image;
  }
  const std::vector<uint8_t> values = read_codes<uint8_t>(reader, count, name);
  image.pixels.resize(values.size() / static_cast<size_t>(count));
  const bool grey = count < 3, has_alpha = count == 2 || count == 4;
  for (size_t i = 0; i < image.pixels.size(); i++) {
    const uint8_t* v = &values[i * static_cast<size_t>(count)];
    const uint32_t alpha = has_alpha ? v[count - 1] : 255u;
    image.pixels[i] =
        v[0] | static_cast<uint32_t>(v[grey ? 0 : 1]) << 8 | static_cast<uint32_t>(v[grey ? 0 : 2]) << 16 | alpha << 24;
  }
  return image;
}

// --- reading by rows -----------------------------------------------------------------------------------------------

namespace {

class FileRows final : public RowReader {
 public:
  explicit FileRows(const std::string& path);
  const FileInfo& info() const override { return info_; }
  const ColorSpace& color_space() const override { return reader_.color; }
  void widen() override;
  bool is_whole_number(size_t channel) const override;
  int band_rows() const override;
  void read(int begin, int end, size_t channels, std::byte* to) override;
  const std::map<size_t, unsigned>& beyond_floats() const override { return beyond_floats_; }

 private:
  std::string path_;
  Reader reader_;
  FileInfo info_;
  OIIO::TypeDesc type_;           // of all samples; UNKNOWN: as info_.samples has them
  std::unique_ptr<ExrRows> exr_;  // for rows of EXRs that it knows
  std::map<size_t, unsigned> beyond_floats_;
  std::optional<SrgbConverter> to_srgb_;  // for integers of another colour space
  float multiplied_ = 0.0f;  // integers that OpenImageIO hands out multiplied by alpha to this power; 0: not
};

}  // namespace

static bool says_unassociated(const OIIO::ImageSpec& spec) {
  return spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
}

FileRows::FileRows(const std::string& path) : path_(path), reader_(open_reader(path)) {
  info_ = reader_.info;
  if (info_.is_float && says_unassociated(reader_.spec)) reader_ = open_reader(path, false);
  const OIIO::ImageSpec& spec = reader_.spec;
  if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
      spec.height != spec.full_height) {
    throw cannot_read(path, "its data window is not its whole picture; crop or fill it first");
  }
  bool as_they_are = true;
  for (int c = 0; c < spec.nchannels; c++) {
    const OIIO::TypeDesc type = spec.channelformat(c);
    const bool whole = info_.is_float && type == OIIO::TypeDesc::UINT32;
    as_they_are = as_they_are && (whole || type == type_of(info_.samples[static_cast<size_t>(c)]));
  }
  type_ = as_they_are ? OIIO::TypeDesc() : type_of(info_.is_float ? SampleType::kFloat : SampleType::kUint16);
  if (!as_they_are) {
    for (SampleType& sample : info_.samples) sample = info_.is_float ? SampleType::kFloat : SampleType::kUint16;
  }
  if (reader_.format == FileFormat::kExr && as_they_are) exr_ = ExrRows::open(path, spec.channelnames);
  // OpenImageIO multiplies WebP whatever it is asked, with a curve of its own.
  if (!info_.is_float && spec.alpha_channel >= 0 && !says_unassociated(spec)) {
    multiplied_ = reader_.format == FileFormat::kWebp ? 1.0f / 2.2f : 1.0f;
  }
  if (!info_.is_float && !is_our_own(reader_.color, false)) {
    to_srgb_.emplace(reader_.color);
    widen();
  }
}

void FileRows::widen() {
  if (info_.is_float) return;
  type_ = type_of(SampleType::kUint16);
  for (SampleType& sample : info_.samples) sample = SampleType::kUint16;
}

bool FileRows::is_whole_number(size_t channel) const {
  return info_.is_float && reader_.spec.channelformat(static_cast<int>(channel)) == OIIO::TypeDesc::UINT32;
}

int FileRows::band_rows() const {
  const int kBand = 64, together = std::max(reader_.spec.tile_height, 1);
  return (kBand + together - 1) / together * together;
}

void FileRows::read(int begin, int end, size_t channels, std::byte* to) {
  OIIO::ImageInput& input = *reader_.input;
  const OIIO::ImageSpec& spec = reader_.spec;
  const int count = static_cast<int>(channels), top = spec.y + begin, bottom = spec.y + end;
  const auto read_by_openimageio = [&] {
    return spec.tile_width > 0
               ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, top, bottom, 0, 1, 0, count, type_, to)
               : input.read_scanlines(0, 0, top, bottom, 0, 0, count, type_, to);
  };
  if (exr_) {
    exr_->read(begin, end, channels, to);
  } else if (!read_by_openimageio()) {
    throw cannot_read(path_, library_words(input.geterror()));
  }
  const std::vector<SampleType>& samples = info_.samples;
  size_t stride = 0;
  for (size_t c = 0; c < channels; c++) stride += bytes_of(samples[c]);
  const size_t size = static_cast<size_t>(end - begin) * static_cast<size_t>(spec.width) * stride;
  if (multiplied_ != 0.0f && spec.alpha_channel < count) {
    divide_by_alpha(samples[0], {to, size}, channels, static_cast<size_t>(spec.alpha_channel), multiplied_);
  }
  if (to_srgb_) to_srgb_->convert({reinterpret_cast<uint16_t*>(to), size / sizeof(uint16_t)}, channels);
  size_t offset = 0;
  for (size_t c = 0; c < channels; offset += bytes_of(samples[c]), c++) {
    if (!is_whole_number(c) || type_ != OIIO::TypeDesc()) continue;
    const unsigned number = whole_numbers_to_floats({to + offset, size - offset}, stride);
    if (number > 0) beyond_floats_.emplace(c, number);
  }
}

std::unique_ptr<RowReader> open_rows(const std::string& path) {
  return std::make_unique<FileRows>(path);
}

}  // namespace ods::openimageio

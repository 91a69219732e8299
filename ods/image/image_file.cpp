// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <mutex>

#include "ods/base/error.h"
#include "ods/base/read_file.h"
#include "ods/image/png_chunks.h"
#include "ods/image/tone.h"

namespace ods {

static const char* plugin_name(FileFormat format) {
  switch (format) {
    case FileFormat::kPng:
      return "png";
    case FileFormat::kJpeg:
      return "jpeg";
    case FileFormat::kTiff:
      return "tiff";
    case FileFormat::kWebp:
      return "webp";
    case FileFormat::kHdr:
      return "hdr";
    case FileFormat::kExr:
      return "openexr";
  }
  return "";
}

// Debian builds OpenImageIO so that it comments on broken files on stderr; that is not a library's place. It and
// OpenEXR have threads of their own: as many as TBB may have, so that one limit (tbb::global_control) holds for all.
static void set_up_openimageio() {
  static std::mutex setting;
  static int threads = 0;
  const std::lock_guard lock(setting);
  const int allowed = static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  if (allowed == threads) return;
  threads = allowed;
  OIIO::attribute("debug", 0);
  OIIO::attribute("threads", threads);
  OIIO::attribute("exr_threads", threads);
}

static std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// --- reading -------------------------------------------------------------------------------------------------------

static Error cannot_read(const std::string& name, const std::string& why) {
  return Error(ErrorKind::kInput, fmt::format("cannot read '{}': {}", name, why));
}

static std::string unknown_format() {
  return fmt::format("it is none of {}", known_extensions());
}

static void check_size(const OIIO::ImageSpec& spec, size_t file_size, const std::string& name) {
  if (spec.deep || spec.depth > 1 || spec.nchannels < 1) throw cannot_read(name, "it is not a flat image");
  const int sides[] = {spec.width, spec.height, spec.tile_width, spec.tile_height};
  if (spec.width < 1 || spec.height < 1) throw cannot_read(name, "it has no pixels");
  const int64_t pixels = int64_t{spec.width} * spec.height;
  const int64_t most = std::max(kSmallPixels, kMaxPixelsPerByte * static_cast<int64_t>(file_size));
  if (*std::max_element(std::begin(sides), std::end(sides)) > kMaxSide || pixels > kMaxPixels) {
    throw cannot_read(name, fmt::format("{}x{} pixels are more than the limit of {} a side, {} in all", spec.width,
                                        spec.height, kMaxSide, kMaxPixels));
  }
  if (pixels > most) {
    throw cannot_read(name, fmt::format("{}x{} pixels in {} bytes: the file is broken or hostile", spec.width,
                                        spec.height, file_size));
  }
}

struct Reader {
  std::vector<std::byte> png;  // where it is one
  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
};

static Reader open_reader(std::span<const std::byte> file, const std::string& name) {
  set_up_openimageio();
  const std::optional<FileFormat> format = format_of_bytes(file);
  if (!format) throw cannot_read(name, unknown_format());
  Reader reader;
  reader.input = OIIO::ImageInput::create(plugin_name(*format));
  if (!reader.input) throw cannot_read(name, fmt::format("OpenImageIO here has no {} reader", plugin_name(*format)));
  std::span<const std::byte> content = file;
  if (*format == FileFormat::kPng) {
    std::optional<std::vector<std::byte>> png = essential_png(file);
    if (!png) throw cannot_read(name, "the PNG is cut short or damaged");
    reader.png = std::move(*png);
    content = reader.png;
  }
  reader.memory =
      std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<std::byte*>(content.data()), content.size());
  reader.input->set_ioproxy(reader.memory.get());
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  if (!reader.input->open(name, reader.spec, config)) throw cannot_read(name, one_line(reader.input->geterror()));
  check_size(reader.spec, file.size(), name);
  return reader;
}

// The first four channels at most, in the order of the file (for EXR that is R, G, B, A before all others).
template <typename T>
static std::vector<T> read_channels(Reader& reader, int count, const std::string& name) {
  const OIIO::ImageSpec& spec = reader.spec;
  std::vector<T> values(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) *
                        static_cast<size_t>(count));
  if (!reader.input->read_image(0, 0, 0, count, OIIO::BaseTypeFromC<T>::value, values.data())) {
    throw cannot_read(name, one_line(reader.input->geterror()));
  }
  return values;
}

// The bytes of a file that starts as an image does.
static std::vector<unsigned char> read_image_bytes(const std::string& path) {
  const std::vector<unsigned char> start = read_start(path, 16);
  if (!format_of_bytes(std::as_bytes(std::span(start)))) throw cannot_read(path, unknown_format());
  return read_file(path, kMaxFileBytes);
}

Image read_image(const std::string& path) {
  const std::vector<unsigned char> file = read_image_bytes(path);
  Reader reader = open_reader(std::as_bytes(std::span(file)), path);
  const int count = reader.spec.nchannels < 3 ? 1 : 3;
  Image image(reader.spec.width, reader.spec.height, 3);
  std::vector<float> values = read_channels<float>(reader, count, path);
  if (count == 3) {
    image.pixels = std::move(values);
  } else {
    for (size_t i = 0; i < image.pixels.size(); i++) image.pixels[i] = values[i / 3];
  }
  if (!reader.spec.format.is_floating_point()) {
    for (float& value : image.pixels) value = srgb_decode(value);
  }
  return image;
}

FileInfo read_info(const std::string& path) {
  const std::vector<unsigned char> file = read_image_bytes(path);
  const Reader reader = open_reader(std::as_bytes(std::span(file)), path);
  FileInfo info;
  info.width = reader.spec.width;
  info.height = reader.spec.height;
  info.is_float = reader.spec.format.is_floating_point();
  info.channels = reader.spec.channelnames;
  for (const OIIO::ParamValue& attribute : reader.spec.extra_attribs) {
    if (attribute.type() == OIIO::TypeString) info.text[attribute.name().string()] = attribute.get_string();
  }
  return info;
}

Image read_channels(const std::string& path, const std::vector<std::string>& names) {
  const std::vector<unsigned char> file = read_image_bytes(path);
  Reader reader = open_reader(std::as_bytes(std::span(file)), path);
  std::vector<int> indices;
  for (const std::string& name : names) {
    indices.push_back(reader.spec.channelindex(name));
    if (indices.back() < 0) throw cannot_read(path, fmt::format("it has no channel '{}'", name));
  }
  const int count = static_cast<int>(names.size());
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
      throw cannot_read(path, one_line(reader.input->geterror()));
    }
  }
  if (!reader.spec.format.is_floating_point()) {
    for (float& value : image.pixels) value = srgb_decode(value);
  }
  return image;
}

CodeImage decode_image(std::span<const std::byte> file, const std::string& name) {
  Reader reader = open_reader(file, name);
  const int count = std::min(reader.spec.nchannels, 4);
  const std::vector<uint8_t> values = read_channels<uint8_t>(reader, count, name);
  CodeImage image;
  image.width = reader.spec.width;
  image.height = reader.spec.height;
  image.pixels.resize(values.size() / static_cast<size_t>(count));
  const bool grey = count < 3;
  const bool has_alpha = count == 2 || count == 4;
  for (size_t i = 0; i < image.pixels.size(); i++) {
    const uint8_t* v = &values[i * static_cast<size_t>(count)];
    const uint32_t alpha = has_alpha ? v[count - 1] : 255u;
    image.pixels[i] =
        v[0] | static_cast<uint32_t>(v[grey ? 0 : 1]) << 8 | static_cast<uint32_t>(v[grey ? 0 : 2]) << 16 | alpha << 24;
  }
  return image;
}

// --- writing -------------------------------------------------------------------------------------------------------

static OIIO::TypeDesc type_of(Sample sample) {
  switch (sample) {
    case Sample::kUint8:
      return OIIO::TypeDesc::UINT8;
    case Sample::kUint16:
      return OIIO::TypeDesc::UINT16;
    case Sample::kHalf:
      return OIIO::TypeDesc::HALF;
    case Sample::kFloat:
      return OIIO::TypeDesc::FLOAT;
  }
  return OIIO::TypeDesc::FLOAT;
}

static void set_attribute(OIIO::ImageSpec& spec, const Attribute& attribute) {
  const std::string& name = attribute.name;
  if (const int* i = std::get_if<int>(&attribute.value)) spec.attribute(name, *i);
  if (const float* f = std::get_if<float>(&attribute.value)) spec.attribute(name, *f);
  if (const std::string* s = std::get_if<std::string>(&attribute.value)) spec.attribute(name, *s);
  if (const auto* list = std::get_if<std::vector<float>>(&attribute.value)) {
    const int count = static_cast<int>(list->size());
    const OIIO::TypeDesc vector3(OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::VEC3);
    spec.attribute(name, count == 3 ? vector3 : OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, count), list->data());
  }
  if (const auto* list = std::get_if<std::vector<std::string>>(&attribute.value)) {
    std::vector<const char*> words;
    for (const std::string& word : *list) words.push_back(word.c_str());
    spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::STRING, static_cast<int>(words.size())), words.data());
  }
}

static bool is_gpano(const Attribute& attribute) {
  return attribute.name.starts_with("GPano:");
}

static OIIO::ImageSpec make_spec(const FileHeader& header) {
  OIIO::ImageSpec spec(header.width, header.height, static_cast<int>(header.channels.size()),
                       type_of(header.channels.front().sample));
  spec.channelnames.clear();
  for (const Channel& channel : header.channels) {
    spec.channelnames.push_back(channel.name);
    spec.channelformats.push_back(type_of(channel.sample));
  }
  for (const Attribute& attribute : header.attributes) {
    if (header.format != FileFormat::kPng || !is_gpano(attribute)) set_attribute(spec, attribute);
  }
  return spec;
}

static std::string png_xmp_chunk(const FileHeader& header) {
  std::vector<XmpProperty> properties;
  for (const Attribute& attribute : header.attributes) {
    if (!is_gpano(attribute)) continue;
    std::string text;
    if (const int* i = std::get_if<int>(&attribute.value)) text = fmt::format("{}", *i);
    if (const float* f = std::get_if<float>(&attribute.value)) text = fmt::format("{}", *f);
    if (const std::string* s = std::get_if<std::string>(&attribute.value)) text = *s;
    properties.emplace_back(attribute.name, text);
  }
  return properties.empty() ? std::string() : xmp_chunk(gpano_packet(properties));
}

// Where encoders write. It never reports a failure, because libjpeg would end the process; the stream remembers it for
// AtomicFile::finish(). On the way it slips a chunk in behind a PNG's header.
class Sink final : public OIIO::Filesystem::IOProxy {
 public:
  Sink(std::FILE* stream, std::string chunk) : IOProxy("", Write), stream_(stream), chunk_(std::move(chunk)) {}
  const char* proxytype() const override { return "ods"; }
  void close() override {}
  bool seek(int64_t offset) override {
    m_pos = offset;
    fseeko(stream_, offset, SEEK_SET);
    return true;
  }
  size_t write(const void* bytes, size_t size) override {
    const char* begin = static_cast<const char*>(bytes);
    const size_t position = static_cast<size_t>(m_pos);
    size_t head = 0;
    if (!chunk_.empty() && position + size >= kPngAfterHeader) {
      head = kPngAfterHeader - position;
      std::fwrite(begin, 1, head, stream_);
      std::fwrite(chunk_.data(), 1, chunk_.size(), stream_);
      chunk_.clear();
    }
    std::fwrite(begin + head, 1, size - head, stream_);
    m_pos += static_cast<int64_t>(size);
    return size;
  }

 private:
  std::FILE* stream_;
  std::string chunk_;
};

// Rows go out in bands: enough for OpenEXR to compress on all cores, few enough that no second picture is in memory.
static bool write_rows(OIIO::ImageOutput& output, const FileHeader& header, const RowSource& rows) {
  const int kBand = 64;
  const size_t row_size = static_cast<size_t>(header.width) * header.channels.size();
  std::vector<float> band(row_size * static_cast<size_t>(std::min(kBand, header.height)));
  for (int begin = 0; begin < header.height; begin += kBand) {
    const int end = std::min(begin + kBand, header.height);
    for (int y = begin; y < end; y++) rows(y, {&band[static_cast<size_t>(y - begin) * row_size], row_size});
    if (!output.write_scanlines(begin, end, 0, OIIO::TypeDesc::FLOAT, band.data())) return false;
  }
  return true;
}

void write_image(AtomicFile& file, const FileHeader& header, const RowSource& rows) {
  assert(header.width > 0 && header.height > 0 && !header.channels.empty());
  set_up_openimageio();
  const char* plugin = plugin_name(header.format);
  const auto failed = [&](const std::string& why) {
    return Error(ErrorKind::kOutput, fmt::format("cannot write '{}': {}", file.path(), one_line(why)));
  };
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(plugin);
  if (!output) throw failed(fmt::format("OpenImageIO here has no {} writer", plugin));

  Sink sink(file.stream(), header.format == FileFormat::kPng ? png_xmp_chunk(header) : std::string());
  // libtiff goes back and reads what it wrote, which OpenImageIO does not hand through.
  if (header.format != FileFormat::kTiff) output->set_ioproxy(&sink);
  const bool written = output->open(file.temporary(), make_spec(header)) && write_rows(*output, header, rows);
  const bool closed = output->close();
  // A full disk says so itself; what the format's library made of it is of no help. libtiff wrote through a stream of
  // its own, so ours asks the disk for a little more.
  if (!written || !closed) {
    fseeko(file.stream(), 0, SEEK_END);
    const std::vector<char> more(1 << 20);
    std::fwrite(more.data(), 1, more.size(), file.stream());
    file.finish();
    throw failed(output->geterror());
  }
}

}  // namespace ods

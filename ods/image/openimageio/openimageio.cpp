// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// TIFF, WebP and HDR through OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <iterator>
#include <mutex>
#include <new>

#include "ods/base/names.h"
#include "ods/base/text.h"
#include "ods/image/codec/other_formats.h"

namespace ods {

// OpenImageIO's names of its plugin and of a number type.
static const char* plugin_name(FileFormat format) {
  constexpr const char* kNames[] = {"png", "jpeg", "tiff", "webp", "hdr", "openexr"};  // in the order of FileFormat
  static_assert(std::size(kNames) == enumerator_count<FileFormat>());
  return kNames[static_cast<size_t>(format)];
}

static OIIO::TypeDesc type_of(SampleType sample) {
  constexpr const char* kNames[] = {"uint8", "uint16", "half", "float"};  // in the order of SampleType
  static_assert(std::size(kNames) == enumerator_count<SampleType>());
  return OIIO::TypeDesc(kNames[static_cast<size_t>(sample)]);
}

// Before anything else of it is called. Debian builds OpenImageIO so that it comments on broken files on stderr; that
// is not a library's place. It has threads of its own: as many as TBB may have, so that one limit
// (tbb::global_control) holds for all.
static void set_up() {
  static std::mutex setting;
  static int threads = 0;
  const std::lock_guard lock(setting);
  const int allowed = static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  if (allowed == threads) return;
  threads = allowed;
  OIIO::attribute("debug", 0);
  OIIO::attribute("threads", threads);
}

// Why there is no reader or writer of that name: this build has none. Throws std::bad_alloc where it has, and memory
// was lacking to make it.
static std::string no_plugin(const char* plugin, const char* kind) {
  if (OIIO::get_string_attribute("format_list").find(plugin) != OIIO::string_view::npos) throw std::bad_alloc();
  return fmt::format("OpenImageIO here has no {} {}", plugin, kind);
}

// --- reading ---------------------------------------------------------------------------------------------------------

namespace {

// What OpenImageIO reads.
class Source final : public OIIO::Filesystem::IOProxy {
 public:
  explicit Source(const PictureBytes& file) : IOProxy("", Read), file_(file) {}
  const char* proxytype() const override { return "ods"; }
  size_t size() const override { return file_.size; }
  bool seek(int64_t offset) override { return m_pos = offset, true; }
  size_t read(void* to, size_t size) override {
    const size_t done = pread(to, size, m_pos);
    m_pos += static_cast<int64_t>(done);
    return done;
  }
  size_t pread(void* to, size_t size, int64_t offset) override {
    const size_t at = std::min(static_cast<size_t>(offset), file_.size), count = std::min(size, file_.size - at);
    return file_.read(at, to, count) ? count : 0;
  }

 private:
  PictureBytes file_;
};

class OiioDecoder final : public Decoder {
 public:
  OiioDecoder(const PictureBytes& file, FileFormat format);
  void read(int begin, int end, size_t first, size_t count, std::byte* to) override;

 private:
  void open(const PictureBytes& file, FileFormat format, bool keep_alpha);
  Error failed() { return cannot_read(name_, library_words(input_->geterror())); }

  std::string name_;
  Source source_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
  OIIO::TypeDesc type_;      // of all samples
  float multiplied_ = 0.0f;  // integers that OpenImageIO hands out multiplied by alpha to this power; 0: not
};

bool says_unassociated(const OIIO::ImageSpec& spec) {
  return spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
}

// Integers of other sizes than 8 and 16 bits become 16, doubles floats.
SampleType sample_of(const OIIO::ImageSpec& spec) {
  for (const SampleType sample : {SampleType::kUint8, SampleType::kUint16, SampleType::kHalf}) {
    if (spec.channelformats.empty() && spec.format == type_of(sample)) return sample;
  }
  return spec.format.is_floating_point() ? SampleType::kFloat : SampleType::kUint16;
}

OiioDecoder::OiioDecoder(const PictureBytes& file, FileFormat format) : name_(file.name), source_(file) {
  set_up();
  open(file, format, true);
  if (spec_.format.is_floating_point() && says_unassociated(spec_)) open(file, format, false);
  info.width = spec_.width;
  info.height = spec_.height;
  info.channels = spec_.channelnames;
  info.is_float = spec_.format.is_floating_point();
  info.samples.assign(info.channels.size(), sample_of(spec_));
  for (const OIIO::ParamValue& attribute : spec_.extra_attribs) {
    if (attribute.type() == OIIO::TypeString) info.text[attribute.name().string()] = attribute.get_string();
  }
  type_ = type_of(info.samples[0]);
  rows_together = std::max(spec_.tile_height, 1);
  // It multiplies WebP whatever it is asked, with a curve of its own.
  if (!info.is_float && spec_.alpha_channel >= 0 && !says_unassociated(spec_)) {
    multiplied_ = format == FileFormat::kWebp ? 1.0f / 2.2f : 1.0f;
  }
}

void OiioDecoder::open(const PictureBytes& file, FileFormat format, bool keep_alpha) {
  const char* plugin = plugin_name(format);
  input_ = OIIO::ImageInput::create(plugin);
  if (!input_) throw cannot_read(name_, no_plugin(plugin, "reader"));
  source_.seek(0);
  input_->set_ioproxy(&source_);
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", keep_alpha ? 1 : 0);
  if (!input_->open(name_, spec_, config)) throw failed();
  if (spec_.deep || spec_.depth > 1 || spec_.nchannels < 1) throw cannot_read(name_, "it is not a flat image");
  check_picture_size(file, spec_.width, spec_.height, std::max(spec_.tile_width, spec_.tile_height));
}

void OiioDecoder::read(int begin, int end, size_t first, size_t count, std::byte* to) {
  const int from = static_cast<int>(first), until = static_cast<int>(first + count);
  const int left = spec_.x, top = spec_.y + begin, bottom = spec_.y + end;
  const bool good = spec_.tile_width > 0
                        ? input_->read_tiles(0, 0, left, left + spec_.width, top, bottom, 0, 1, from, until, type_, to)
                        : input_->read_scanlines(0, 0, top, bottom, 0, from, until, type_, to);
  if (!good) throw failed();
  if (multiplied_ == 0.0f || first > 0 || spec_.alpha_channel >= until) return;
  const size_t pixels = static_cast<size_t>(end - begin) * static_cast<size_t>(spec_.width);
  divide_by_alpha(info.samples[0], {to, pixels * bytes_of_pixel(first, count)}, count,
                  static_cast<size_t>(spec_.alpha_channel), multiplied_);
}

// --- writing ---------------------------------------------------------------------------------------------------------

// The output of encoders. It never reports a failure: the stream remembers it for AtomicFile::finish().
class Sink final : public OIIO::Filesystem::IOProxy {
 public:
  explicit Sink(std::FILE* stream) : IOProxy("", Write), stream_(stream) {}
  const char* proxytype() const override { return "ods"; }
  void close() override {}
  bool seek(int64_t offset) override {
    m_pos = offset;
    fseeko(stream_, offset, SEEK_SET);
    return true;
  }
  size_t write(const void* bytes, size_t size) override {
    std::fwrite(bytes, 1, size, stream_);
    m_pos += static_cast<int64_t>(size);
    return size;
  }

 private:
  std::FILE* stream_;
};

OIIO::ImageSpec spec_of(const FileHeader& header) {
  OIIO::ImageSpec spec(header.width, header.height, static_cast<int>(header.channels.size()),
                       type_of(header.channels.front().sample));
  spec.channelnames.clear();
  for (const Channel& channel : header.channels) spec.channelnames.push_back(channel.name);
  const auto alpha = std::find(spec.channelnames.begin(), spec.channelnames.end(), "A");
  spec.alpha_channel = alpha == spec.channelnames.end() ? -1 : static_cast<int>(alpha - spec.channelnames.begin());
  for (const Attribute& attribute : header.attributes) {
    if (const int* i = std::get_if<int>(&attribute.value)) spec.attribute(attribute.name, *i);
    if (const float* f = std::get_if<float>(&attribute.value)) spec.attribute(attribute.name, *f);
    if (const std::string* s = std::get_if<std::string>(&attribute.value)) spec.attribute(attribute.name, *s);
  }
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("oiio:ColorSpace", header.format == FileFormat::kHdr ? "Linear" : "sRGB");
  if (header.format == FileFormat::kTiff) spec.attribute("compression", "zip");
  if (header.format == FileFormat::kWebp) spec.attribute("CompressionQuality", header.quality);
  // Otherwise it writes the time of day, and equal pictures would not be equal files.
  if (header.format == FileFormat::kTiff) spec.attribute("DateTime", "");
  return spec;
}

class OiioEncoder final : public Encoder {
 public:
  OiioEncoder(AtomicFile& file, const FileHeader& header);
  void write(int begin, int end, const std::byte* rows) override {
    if (!output_->write_scanlines(begin, end, 0, type_, rows)) throw failed();
  }
  void finish() override {
    if (!output_->close()) throw failed();
  }

 private:
  Error failed();

  AtomicFile& file_;
  Sink sink_;
  std::unique_ptr<OIIO::ImageOutput> output_;
  OIIO::TypeDesc type_;
};

OiioEncoder::OiioEncoder(AtomicFile& file, const FileHeader& header)
    : file_(file), sink_(file.stream()), type_(type_of(header.channels.front().sample)) {
  set_up();
  const char* plugin = plugin_name(header.format);
  output_ = OIIO::ImageOutput::create(plugin);
  if (!output_) throw cannot_write(file, no_plugin(plugin, "writer"));
  // libtiff reads back what it wrote, which OpenImageIO's proxy does not pass on.
  if (header.format != FileFormat::kTiff) output_->set_ioproxy(&sink_);
  if (!output_->open(file.temporary(), spec_of(header))) throw failed();
}

// If the disk is full, that is the message to show, not the format library's. libtiff wrote through its own stream, so
// ours writes a little more to find out.
Error OiioEncoder::failed() {
  const std::string words = output_->geterror();
  output_->close();
  fseeko(file_.stream(), 0, SEEK_END);
  const std::vector<char> more(1 << 20);
  std::fwrite(more.data(), 1, more.size(), file_.stream());
  file_.finish();
  return cannot_write(file_, words);
}

constexpr OtherFormats kFormats = {[](const PictureBytes& file, FileFormat format) -> std::unique_ptr<Decoder> {
                                     return std::make_unique<OiioDecoder>(file, format);
                                   },
                                   [](AtomicFile& file, const FileHeader& header) -> std::unique_ptr<Encoder> {
                                     return std::make_unique<OiioEncoder>(file, header);
                                   }};

}  // namespace

const OtherFormats& other_formats() {
  return kFormats;
}

}  // namespace ods

// For programs that load this library at run time.
extern "C" const ods::OtherFormats* ods_other_formats() {
  return &ods::kFormats;
}

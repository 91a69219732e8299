// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <memory>
#include <mutex>
#include <new>

#include "ods/base/error.h"
#include "ods/base/names.h"
#include "ods/base/text.h"
#include "ods/image/codec/openimageio.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/image_codec.h"

namespace ods::openimageio {

const char* plugin_name(FileFormat format) {
  constexpr const char* kNames[] = {"png", "jpeg", "tiff", "webp", "hdr", "openexr"};  // in the order of FileFormat
  static_assert(std::size(kNames) == enumerator_count<FileFormat>());
  return kNames[static_cast<size_t>(format)];
}

const char* type_name(SampleType sample) {
  constexpr const char* kNames[] = {"uint8", "uint16", "half", "float"};  // in the order of SampleType
  static_assert(std::size(kNames) == enumerator_count<SampleType>());
  return kNames[static_cast<size_t>(sample)];
}

void set_up_openimageio() {
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

std::string no_plugin(const char* plugin, const char* kind) {
  if (OIIO::get_string_attribute("format_list").find(plugin) != OIIO::string_view::npos) throw std::bad_alloc();
  return fmt::format("OpenImageIO here has no {} {}", plugin, kind);
}

static OIIO::TypeDesc type_of(SampleType sample) {
  return OIIO::TypeDesc(type_name(sample));
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

static OIIO::ImageSpec make_spec(const FileHeader& header) {
  OIIO::ImageSpec spec(header.width, header.height, static_cast<int>(header.channels.size()),
                       type_of(header.channels.front().sample));
  spec.channelnames.clear();
  for (const Channel& channel : header.channels) {
    spec.channelnames.push_back(channel.name);
    spec.channelformats.push_back(type_of(channel.sample));
  }
  const auto alpha = std::find(spec.channelnames.begin(), spec.channelnames.end(), "A");
  spec.alpha_channel = alpha == spec.channelnames.end() ? -1 : static_cast<int>(alpha - spec.channelnames.begin());
  for (const Attribute& attribute : header.attributes) {
    if (header.format != FileFormat::kPng || !is_gpano(attribute)) set_attribute(spec, attribute);
  }
  return spec;
}

namespace {

// The output of encoders. It never reports a failure, because libjpeg would end the process; the stream remembers it
// for AtomicFile::finish(). It inserts a chunk after a PNG's header.
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

}  // namespace

// Writes rows in bands: large enough for OpenEXR to compress on all cores, small enough that no second picture is in
// memory. Computes the next band meanwhile, as most formats compress on one core.
static bool write_rows(OIIO::ImageOutput& output, const FileHeader& header, const RowSource& rows,
                       const std::function<void()>& band_done) {
  const int kBand = 64;
  // OpenImageIO converts floats to integers well, but to halves slowly.
  std::vector<SampleType> samples;
  size_t pixel_size = 0;
  for (const Channel& channel : header.channels) {
    samples.push_back(channel.sample == SampleType::kHalf ? SampleType::kHalf : SampleType::kFloat);
    pixel_size += bytes_of(samples.back());
  }
  const bool floats = pixel_size == samples.size() * sizeof(float);  // else in the file's sample types
  const OIIO::TypeDesc type = floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc();
  const size_t width = static_cast<size_t>(header.width), row_size = width * pixel_size;
  std::vector<std::byte> made(row_size * static_cast<size_t>(std::min(kBand, header.height))), written(made.size());
  const auto make = [&](int begin) {
    tbb::parallel_for(begin, std::min(begin + kBand, header.height), [&](int y) {
      std::vector<float> row(width * samples.size());
      rows(y, row);
      pack_floats(samples, row, &made[static_cast<size_t>(y - begin) * row_size]);
    });
    if (band_done) band_done();
  };
  make(0);
  bool good = true;
  for (int begin = 0; begin < header.height && good; begin += kBand) {
    const int end = std::min(begin + kBand, header.height);
    std::swap(made, written);
    tbb::task_group next;
    if (end < header.height) next.run([&] { make(end); });
    good = output.write_scanlines(begin, end, 0, type, written.data());
    next.wait();
  }
  return good;
}

void write_image(AtomicFile& file, const FileHeader& header, const RowSource& rows,
                 const std::function<void()>& band_done) {
  assert(header.width > 0 && header.height > 0 && !header.channels.empty());
  set_up_openimageio();
  const char* plugin = plugin_name(header.format);
  const auto failed = [&](const std::string& why) {
    return Error(ErrorKind::kOutput, fmt::format("cannot write '{}': {}", file.path(), one_line(why)));
  };
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(plugin);
  if (!output) throw failed(no_plugin(plugin, "writer"));

  Sink sink(file.stream(), header.format == FileFormat::kPng ? gpano_chunk(header.attributes) : std::string());
  // libtiff reads back what it wrote, which OpenImageIO's proxy does not pass on.
  if (header.format != FileFormat::kTiff) output->set_ioproxy(&sink);
  const bool written =
      output->open(file.temporary(), make_spec(header)) && write_rows(*output, header, rows, band_done);
  const bool closed = output->close();
  // If the disk is full, that is the message to show, not the format library's. libtiff wrote through its own stream,
  // so ours writes a little more to find out.
  if (!written || !closed) {
    fseeko(file.stream(), 0, SEEK_END);
    const std::vector<char> more(1 << 20);
    std::fwrite(more.data(), 1, more.size(), file.stream());
    file.finish();
    throw failed(library_words(output->geterror()));
  }
}

}  // namespace ods::openimageio

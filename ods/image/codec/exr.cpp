// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// EXR through OpenEXR.
#include <OpenEXR/IexBaseExc.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfEnvmapAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "ods/base/text.h"
#include "ods/image/codec/decoder.h"
#include "ods/image/codec/encoder.h"
#include "ods/image/codec/exr_rows.h"
#include "ods/image/format/exr_guard.h"
#include "ods/image/format/exr_header.h"

namespace ods {

// OpenEXR's threads: the number that TBB may use, so that one limit (tbb::global_control) applies to all.
static int exr_threads() {
  static std::mutex setting;
  const std::lock_guard lock(setting);
  const int allowed = static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  if (Imf::globalThreadCount() != allowed) Imf::setGlobalThreadCount(allowed);
  return allowed;
}

// --- reading ---------------------------------------------------------------------------------------------------------

namespace {

// OpenEXR's functions throw exceptions of their own; `make` converts their text to an Error.
template <class Calls, class MakeError>
auto guarded(const Calls& calls, const MakeError& make) {
  try {
    return calls();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& exception) {
    throw make(library_message(exception.what()));
  }
}

class ExrInput final : public Imf::IStream {
 public:
  explicit ExrInput(const PictureBytes& file) : IStream(file.name.c_str()), file_(file) {}
  bool read(char to[], int size) override {
    if (!file_.read(at_, to, static_cast<size_t>(size))) throw Iex::InputExc("it is cut short");
    at_ += static_cast<size_t>(size);
    return at_ < file_.size;
  }
  uint64_t tellg() override { return at_; }
  void seekg(uint64_t to) override { at_ = to; }

 private:
  PictureBytes file_;
  uint64_t at_ = 0;
};

struct ExrChannel {
  std::string name;    // with the view of its part
  std::string stored;  // its name in the part
  int part = 0;
  Imf::PixelType type;
  std::string layer() const { return name.substr(0, name.rfind('.') + 1); }  // npos + 1: none
  // R, G, B, A, then all others.
  size_t rank() const {
    const std::string own = name.substr(layer().size());
    return own.size() == 1 ? std::min(std::string_view("RGBA").find(own), size_t{4}) : 4;
  }
};

// Sorts a part's channels, which are in alphabetical order, by layer, and in it first R, G, B, A.
void sort_channels(std::vector<ExrChannel>& channels) {
  std::stable_sort(channels.begin(), channels.end(), [](const ExrChannel& a, const ExrChannel& b) {
    const std::string one = a.layer(), other = b.layer();
    return one != other ? one < other : a.rank() < b.rank();
  });
}

// view: inserted before the last component, as in files of one part: right.R, normal.right.X; empty for none.
std::vector<ExrChannel> channels_of(const Imf::Header& header, int part, const std::string& view,
                                    const std::string& path) {
  std::vector<ExrChannel> channels;
  const Imf::ChannelList& list = header.channels();
  for (auto each = list.begin(); each != list.end(); ++each) {
    if (each.channel().xSampling != 1 || each.channel().ySampling != 1) {
      throw cannot_read(path, fmt::format("its channel {} has fewer pixels than the picture", each.name()));
    }
    std::string name = each.name();
    if (!view.empty()) name.insert(name.rfind('.') + 1, view + ".");  // if there is no dot, npos + 1 is the start
    channels.push_back({name, each.name(), part, each.channel().type});
  }
  return channels;
}

bool is_deep(const Imf::Header& header) {
  return header.hasType() && Imf::isDeepData(header.type());
}

// The view of a part. Empty if unspecified.
std::string view_of(const Imf::Header& header) {
  return header.hasView() ? header.view() : "";
}

Imath::Box2i around(const Imath::Box2i& a, const Imath::Box2i& b) {
  Imath::Box2i both = a;
  both.extendBy(b);
  return both;
}

double area_of(const Imath::Box2i& window) {
  const auto side = [](int from, int to) { return static_cast<double>(to) - static_cast<double>(from) + 1.0; };
  return side(window.min.x, window.max.x) * side(window.min.y, window.max.y);
}

// Returns whether two data windows are crops of one picture: both together are not much larger than they.
bool are_crops(const Imath::Box2i& a, const Imath::Box2i& b) {
  constexpr double kMaxGrowth = 4.0;
  return area_of(around(a, b)) <= kMaxGrowth * std::max(area_of(a), area_of(b));
}

// The parts of both eyes if they show the same display window; otherwise only the first. Compositing programs crop the
// data window of each eye.
std::vector<int> parts_of(const Imf::MultiPartInputFile& file) {
  std::vector<int> parts;
  bool has_left = false, has_right = false;
  for (int i = 0; i < file.parts(); i++) {
    const Imf::Header& header = file.header(i);
    const std::string view = view_of(header);
    const bool fits = header.displayWindow() == file.header(0).displayWindow() &&
                      are_crops(header.dataWindow(), file.header(0).dataWindow());
    if (is_deep(header) || !fits || (view != "left" && view != "right")) continue;
    parts.push_back(i);
    (view == "left" ? has_left : has_right) = true;
  }
  return has_left && has_right && parts[0] == 0 ? parts : std::vector{0};
}

// Adds attributes under their names in FileInfo.
void add_attributes(const Imf::Header& header, FileInfo& info) {
  for (auto each = header.begin(); each != header.end(); ++each) {
    const std::string name = each.name();
    const Imf::Attribute* const value = &each.attribute();
    std::vector<float>& numbers = info.numbers[name];
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(value)) info.text[name] = text->value();
    if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(value)) numbers = {number->value()};
    if (const auto* number = dynamic_cast<const Imf::IntAttribute*>(value)) {
      numbers = {static_cast<float>(number->value())};
    }
    if (const auto* pair = dynamic_cast<const Imf::V2fAttribute*>(value)) numbers = {pair->value().x, pair->value().y};
    if (const auto* three = dynamic_cast<const Imf::V3fAttribute*>(value)) {
      numbers = {three->value().x, three->value().y, three->value().z};
    }
    if (const auto* colours = dynamic_cast<const Imf::ChromaticitiesAttribute*>(value)) {
      const Imf::Chromaticities& xy = colours->value();
      numbers = {xy.red.x, xy.red.y, xy.green.x, xy.green.y, xy.blue.x, xy.blue.y, xy.white.x, xy.white.y};
    }
    const auto* envmap = dynamic_cast<const Imf::EnvmapAttribute*>(value);
    if (envmap && envmap->value() == Imf::ENVMAP_LATLONG) info.text["textureformat"] = "LatLong Environment";
    if (numbers.empty()) info.numbers.erase(name);
  }
}

class ExrDecoder final : public Decoder {
 public:
  explicit ExrDecoder(const PictureBytes& file);
  void read(int begin, int end, size_t first, size_t count, std::byte* to) override;
  // The data window's first pixel, relative to the display window's, and the display window's size.
  Imath::V2i place() const { return window_.min - file_->header(0).displayWindow().min; }
  Imath::V2i shown() const { return file_->header(0).displayWindow().size() + Imath::V2i(1); }

 private:
  void describe();
  int add_parts();
  bool read_fast(int begin, int end, size_t first, size_t count, std::byte* to);
  void read_any(int begin, int end, size_t first, size_t count, std::byte* to);

  std::string name_;
  bool on_disk_;
  std::unique_ptr<ExrInput> input_;
  std::unique_ptr<Imf::MultiPartInputFile> file_;
  std::map<int, Imf::InputPart> parts_;  // for read_any(): they allocate rows
  Imath::Box2i window_;
  std::vector<ExrChannel> channels_;
  bool has_views_ = false;         // views are in separate parts
  bool has_crops_ = false;         // of different data windows; window_ is around them
  std::unique_ptr<ExrRows> rows_;  // the channels from first_ on; nullptr if ExrRows cannot read the file
  std::optional<size_t> first_;
};

ExrDecoder::ExrDecoder(const PictureBytes& file) : name_(file.name), on_disk_(file.on_disk) {
  const int threads = exr_threads();
  guarded(
      [&] {
        input_ = std::make_unique<ExrInput>(file);
        file_ = std::make_unique<Imf::MultiPartInputFile>(*input_, threads);
        if (is_deep(file_->header(0)))
          throw cannot_read(name_,
                            "it is a deep image, with many depths in a pixel: flatten it, for example with oiiotool");
        describe();
      },
      [&](const std::string& words) { return cannot_read(name_, words); });
}

// Returns the number of parts that are read.
int ExrDecoder::add_parts() {
  const std::vector<int> parts = parts_of(*file_);
  int count = 0;
  std::set<std::string> names;
  for (const int part : parts) {
    const Imf::Header& header = file_->header(part);
    const std::vector<ExrChannel> more = channels_of(header, part, parts.size() > 1 ? view_of(header) : "", name_);
    if (std::ranges::any_of(more, [&](const ExrChannel& each) { return names.contains(each.name); })) continue;
    for (const ExrChannel& each : more) names.insert(each.name);
    channels_.insert(channels_.end(), more.begin(), more.end());
    if (part != 0) has_crops_ |= header.dataWindow() != window_, window_ = around(window_, header.dataWindow());
    count++;
  }
  sort_channels(channels_);
  return count;
}

void ExrDecoder::describe() {
  const Imf::Header& header = file_->header(0);
  window_ = header.dataWindow();
  const int read = add_parts();
  if (channels_.empty()) throw cannot_read(name_, "it has no channels");
  info.width = window_.max.x - window_.min.x + 1;
  info.height = window_.max.y - window_.min.y + 1;
  info.is_float = true;
  info.unread_parts = file_->parts() - read;
  for (const ExrChannel& channel : channels_) {
    info.channels.push_back(channel.name);
    info.samples.push_back(channel.type == Imf::HALF ? SampleType::kHalf : SampleType::kFloat);
    whole_numbers.push_back(channel.type == Imf::UINT);
  }
  add_attributes(header, info);
  has_views_ = read > 1;
  if (has_views_) info.text.erase("view");  // belongs to one part only
  if (header.hasTileDescription())
    rows_together = std::min(info.height, static_cast<int>(std::min(header.tileDescription().ySize, 1u << 30)));
}

bool ExrDecoder::read_fast(int begin, int end, size_t first, size_t count, std::byte* to) {
  if (!on_disk_ || has_views_) return false;
  if (first_ != first) {
    first_ = first;
    rows_ = ExrRows::open(name_, {info.channels.begin() + static_cast<ptrdiff_t>(first), info.channels.end()});
  }
  if (rows_) rows_->read(begin, end, count, to);
  return rows_ != nullptr;
}

void ExrDecoder::read_any(int begin, int end, size_t first, size_t count, std::byte* to) {
  const size_t pixel = bytes_of_pixel(first, count), row = pixel * static_cast<size_t>(info.width);
  std::map<int, Imf::FrameBuffer> buffers;
  if (has_crops_) std::fill_n(to, row * static_cast<size_t>(end - begin), std::byte{});
  char* at = reinterpret_cast<char*>(to) - static_cast<ptrdiff_t>(pixel) * window_.min.x -
             static_cast<ptrdiff_t>(row) * (window_.min.y + begin);  // the position of pixel 0, 0
  for (size_t c = first; c < first + count; c++) {
    const ExrChannel& channel = channels_[c];
    buffers[channel.part].insert(channel.stored, Imf::Slice(channel.type, at, pixel, row));
    at += bytes_of(info.samples[c]);
  }
  guarded(
      [&] {
        for (const auto& [number, buffer] : buffers) {
          Imf::InputPart& part = parts_.try_emplace(number, *file_, number).first->second;
          part.setFrameBuffer(buffer);
          const Imath::Box2i& own = part.header().dataWindow();
          const int top = std::max(window_.min.y + begin, own.min.y);
          const int bottom = std::min(window_.min.y + end - 1, own.max.y);
          if (top <= bottom) part.readPixels(top, bottom);
        }
      },
      [&](const std::string& words) { return cannot_read(name_, words); });
}

void ExrDecoder::read(int begin, int end, size_t first, size_t count, std::byte* to) {
  if (!read_fast(begin, end, first, count, to)) read_any(begin, end, first, count, to);
  const size_t pixel = bytes_of_pixel(first, count);
  const size_t size = pixel * static_cast<size_t>(info.width) * static_cast<size_t>(end - begin);
  for (size_t c = first; c < first + count; c++) {
    if (!whole_numbers[c]) continue;
    const size_t offset = bytes_of_pixel(first, c - first);
    const unsigned number = whole_numbers_to_floats({to + offset, size - offset}, pixel);
    if (number > 0) beyond_floats.emplace(c, number);
  }
}

}  // namespace

// OpenEXR allocates memory for the header's claims before it checks the file.
std::unique_ptr<Decoder> open_exr(const PictureBytes& file) {
  const std::string fault = exr_header_fault(file.size, file.read);
  if (!fault.empty()) throw cannot_read(file.name, fault);
  auto decoder = std::make_unique<ExrDecoder>(file);
  const Imath::V2i place = decoder->place(), size = decoder->shown();
  check_picture_size(file, size.x, size.y);
  return windowed(std::move(decoder), place.x, place.y, size.x, size.y);
}

// --- writing ---------------------------------------------------------------------------------------------------------

namespace {

// The output of OpenEXR.
class ExrOutput final : public Imf::OStream {
 public:
  explicit ExrOutput(ByteSink& sink) : OStream(sink.path().c_str()), sink_(sink) {}
  void write(const char bytes[], int size) override { sink_.write(bytes, static_cast<size_t>(size)); }
  uint64_t tellp() override { return sink_.position(); }
  void seekp(uint64_t to) override { sink_.seek(to); }

 private:
  ByteSink& sink_;
};

void insert_floats(Imf::Header& header, const char* name, const std::vector<float>& f) {
  if (std::string_view(name) == "chromaticities" && f.size() == 8) {
    Imf::Chromaticities xy({f[0], f[1]}, {f[2], f[3]}, {f[4], f[5]}, {f[6], f[7]});
    header.insert(name, Imf::ChromaticitiesAttribute(xy));
  }
  if (f.size() == 2) header.insert(name, Imf::V2fAttribute({f[0], f[1]}));
  if (f.size() == 3) header.insert(name, Imf::V3fAttribute({f[0], f[1], f[2]}));
}

void insert_attribute(Imf::Header& header, const Attribute& attribute) {
  const char* name = attribute.name.c_str();
  if (const int* i = std::get_if<int>(&attribute.value)) header.insert(name, Imf::IntAttribute(*i));
  if (const float* f = std::get_if<float>(&attribute.value)) header.insert(name, Imf::FloatAttribute(*f));
  if (const auto* text = std::get_if<std::string>(&attribute.value)) header.insert(name, Imf::StringAttribute(*text));
  if (const auto* floats = std::get_if<std::vector<float>>(&attribute.value)) insert_floats(header, name, *floats);
  if (const auto* words = std::get_if<std::vector<std::string>>(&attribute.value)) {
    header.insert(name, Imf::StringVectorAttribute(*words));
  }
}

// The header as OpenEXR will write it.
ExrHeader written(const Imf::Header& header) {
  constexpr int kVersion = 2;  // version of the file format
  ExrHeader result;
  for (auto each = header.begin(); each != header.end(); ++each) {
    MemorySink value(each.name());
    ExrOutput output(value);
    each.attribute().writeValueTo(output, kVersion);
    result.attributes.push_back({each.name(), each.attribute().typeName(), value.take()});
  }
  return result;
}

class ExrEncoder final : public Encoder {
 public:
  ExrEncoder(ByteSink& sink, const FileHeader& header);
  void write(int begin, int end, const std::byte* rows) override;
  void finish() override { output_.reset(); }  // writes the offset table

 private:
  ByteSink& sink_;
  const FileHeader& header_;
  ExrOutput stream_;
  std::unique_ptr<Imf::OutputFile> output_;
};

Imf::PixelType type_of(SampleType sample) {
  return sample == SampleType::kHalf ? Imf::HALF : Imf::FLOAT;
}

ExrEncoder::ExrEncoder(ByteSink& sink, const FileHeader& header) : sink_(sink), header_(header), stream_(sink) {
  const int threads = exr_threads();
  guarded(
      [&] {
        Imf::Header words(header.width, header.height);
        words.compression() = header.rows_alone ? Imf::ZIPS_COMPRESSION : Imf::ZIP_COMPRESSION;
        for (const Channel& channel : header.channels) {
          words.channels().insert(channel.name, Imf::Channel(type_of(channel.sample)));
        }
        for (const Attribute& attribute : header.attributes) insert_attribute(words, attribute);
        if (header.is_environment) Imf::addEnvmap(words, Imf::ENVMAP_LATLONG);
        if (header.has_checksum) insert_attribute(words, {kExrChecksum, exr_checksum(written(words))});
        output_ = std::make_unique<Imf::OutputFile>(stream_, words, threads);
      },
      [&](const std::string& what) { return cannot_write(sink, what); });
}

void ExrEncoder::write(int begin, int end, const std::byte* rows) {
  const size_t pixel = bytes_of_pixel(header_), row = pixel * static_cast<size_t>(header_.width);
  Imf::FrameBuffer buffer;
  // OpenEXR only reads it.
  char* at = reinterpret_cast<char*>(const_cast<std::byte*>(rows)) - static_cast<ptrdiff_t>(row) * begin;
  for (const Channel& channel : header_.channels) {
    buffer.insert(channel.name, Imf::Slice(type_of(channel.sample), at, pixel, row));
    at += bytes_of(channel.sample);
  }
  guarded(
      [&] {
        output_->setFrameBuffer(buffer);
        output_->writePixels(end - begin);
      },
      [&](const std::string& words) { return cannot_write(sink_, words); });
}

}  // namespace

std::unique_ptr<Encoder> create_exr(ByteSink& sink, const FileHeader& header) {
  return std::make_unique<ExrEncoder>(sink, header);
}

}  // namespace ods

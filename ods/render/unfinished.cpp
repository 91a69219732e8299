// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/unfinished.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

#include "ods/base/checksum.h"
#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/files/atomic_file.h"
#include "ods/files/file_input.h"

namespace ods {

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr std::string_view kMark = "ods unfinished\n";
constexpr int kVersion = 2;

class Writer {
 public:
  explicit Writer(std::FILE* stream) : stream_(stream) {}

  void bytes(std::span<const std::byte> bytes) {
    if (bytes.empty()) return;  // fwrite() needs an address even then
    checksum_ = crc32(bytes, checksum_);
    std::fwrite(bytes.data(), 1, bytes.size(), stream_);  // AtomicFile reports errors
  }
  template <typename Number>
  void number(const Number& value) {
    bytes(std::as_bytes(std::span(&value, 1)));
  }
  template <typename List>
  void list(const List& values) {
    number(uint64_t{values.size()});
    bytes(std::as_bytes(std::span(values)));
  }
  void settings(const Settings& values) { list(settings_text(values)); }
  void checksum() { number(uint32_t{checksum_}); }

 private:
  std::FILE* stream_;
  uint32_t checksum_ = 0;
};

class Reader {
 public:
  explicit Reader(const std::string& path) : file_(path) {}

  void bytes(std::span<std::byte> to) {
    constexpr size_t kPiece = size_t{4} << 20;
    while (!to.empty()) {
      const std::string piece = file_.read(at_, std::min(to.size(), kPiece));
      std::memcpy(to.data(), piece.data(), piece.size());
      checksum_ = crc32(piece, checksum_);
      at_ += piece.size();
      to = to.subspan(piece.size());
    }
  }
  template <typename Number>
  void number(Number& value) {
    bytes(std::as_writable_bytes(std::span(&value, 1)));
  }
  void number(bool& value) {
    uint8_t byte = 0;
    number(byte);
    if (byte > 1) fail();
    value = byte == 1;
  }
  template <typename List>
  void list(List& values) {
    constexpr size_t kSize = sizeof(typename List::value_type);
    uint64_t count = 0;
    number(count);
    if (count > (file_.size() - at_) / kSize) fail();
    check_memory(count * kSize, fmt::format("'{}'", file_.path()), "resume where there is more");
    values.resize(count);
    bytes(std::as_writable_bytes(std::span(values)));
  }
  void settings(Settings& values) {
    std::string text;
    list(text);
    const std::optional<Settings> found = parse_settings(text);
    if (!found) fail();
    values = *found;
  }
  void checksum() {
    const uint32_t computed = checksum_;
    uint32_t written = 0;
    number(written);
    if (written != computed || at_ != file_.size()) fail();
  }
  [[noreturn]] void fail() const {
    throw Error(
        ErrorKind::kInput,
        fmt::format("'{}' is damaged: remove it, and the picture is rendered from the beginning", file_.path()));
  }

 private:
  FileInput file_;
  uint64_t at_ = 0;
  uint32_t checksum_ = 0;
};

// Calls stream.number() or stream.list() for every field of the file.
template <typename Stream, typename About, typename Samples>
void each_field(Stream& stream, About& picture, Samples& samples) {
  stream.settings(picture.settings), stream.list(picture.camera);
  stream.number(picture.exposure), stream.number(picture.tone);
  auto& o = picture.options;
  stream.number(o.width), stream.number(o.height), stream.number(o.samples), stream.number(o.noise);
  stream.number(o.part.number), stream.number(o.part.count), stream.number(o.eyes), stream.number(o.share_paths);
  stream.number(o.layers), stream.number(o.transparent), stream.number(o.statistics);
  stream.number(samples.width), stream.number(samples.height), stream.number(samples.done);
  stream.number(samples.pass_to), stream.number(samples.blocks_done), stream.list(samples.noisy);
  stream.number(samples.judged_at);
  for (auto& eye : samples.eyes) {
    stream.number(eye.eye);
    each_plane(eye, [&](const char*, auto& plane) { stream.list(plane); });
  }
}

bool is_sensible(const SampledPicture& picture) {
  const RenderOptions& o = picture.options;
  return std::isfinite(picture.exposure) && !name_in(kToneCurveTable, picture.tone).empty() && o.width > 0 &&
         o.height > 0 && o.samples > 0 && o.samples <= kMaxSamples && o.part.number > 0 &&
         o.part.number <= o.part.count;
}

}  // namespace

void write_unfinished(const std::string& path, const SampledPicture& picture, const PictureSamples& samples) {
  AtomicFile file(path);
  Writer writer(file.stream());
  writer.bytes(std::as_bytes(std::span(kMark)));
  writer.number(kVersion);
  writer.number(samples.eyes.size());
  each_field(writer, picture, samples);
  writer.checksum();
  file.commit();
}

bool is_unfinished(const std::string& path) {
  const FileInput file(path);
  return file.size() >= kMark.size() && file.read(0, kMark.size()) == kMark;
}

SampledPicture read_unfinished(const std::string& path, PictureSamples& samples) {
  Reader reader(path);
  std::string mark(kMark.size(), '\0');
  int version = 0;
  reader.bytes(std::as_writable_bytes(std::span(mark)));
  reader.number(version);
  if (mark != kMark || version != kVersion) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' is not an unfinished picture of this version of ods", path));
  }
  size_t eyes = 0;
  reader.number(eyes);
  if (eyes != 1 && eyes != 2) reader.fail();
  samples.eyes.resize(eyes);
  SampledPicture picture;
  each_field(reader, picture, samples);
  reader.checksum();
  if (!is_sensible(picture) || !fit(samples, picture.options)) reader.fail();
  return picture;
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/png_chunks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "ods/base/bytes.h"
#include "ods/base/checksum.h"
#include "ods/base/error.h"

namespace ods {

std::string png_chunk(std::string_view type, std::string_view data) {
  const std::string typed = std::string(type) + std::string(data);
  std::string chunk;
  append_number(chunk, data.size(), 4);
  chunk += typed;
  append_number(chunk, crc32(typed), 4);
  return chunk;
}

std::string xmp_chunk(const std::string& packet) {
  return png_chunk("iTXt", std::string(kPngXmpKeyword) + std::string(4, '\0') + packet);
}

PngChunk read_png_chunk(const FileInput& file, uint64_t at) {
  const std::string start = file.read(at, 8);
  const PngChunk chunk{start.substr(4), get_number(start, 0, 4)};
  if (chunk.length + 12 > file.size() - at) {
    throw Error(ErrorKind::kInput, fmt::format("cannot use '{}': the PNG is cut short or damaged", file.path()));
  }
  return chunk;
}

constexpr uint64_t kHeaderBytes = 13;

static bool has_sane_size(std::string_view header) {
  const uint32_t kLongest = 1000000;  // limit of libpng
  const uint64_t width = get_number(header, 0, 4), height = get_number(header, 4, 4);
  return width > 0 && width <= kLongest && height > 0 && height <= kLongest;
}

Extent png_size(const FileInput& file) {
  const PngChunk header = read_png_chunk(file, 8);
  const std::string sides = file.read(16, 8);
  if (header.type != "IHDR" || header.length != kHeaderBytes || !has_sane_size(sides)) {
    throw Error(ErrorKind::kInput, fmt::format("cannot use '{}': the PNG has no header", file.path()));
  }
  return {static_cast<int>(get_number(sides, 0, 4)), static_cast<int>(get_number(sides, 4, 4))};
}

namespace {

struct Chunk {
  std::string type;
  size_t offset = 0;
  size_t length = 0;
};

}  // namespace

static bool is_whole(const Chunk& chunk, const ByteReader& read) {
  const size_t kPiece = size_t{1} << 18;
  uint32_t crc = crc32(chunk.type);
  std::string piece;
  for (size_t done = 0; done < chunk.length; done += piece.size()) {
    piece.resize(std::min(kPiece, chunk.length - done));
    if (!read(chunk.offset + 8 + done, piece.data(), piece.size())) return false;
    crc = crc32(piece, crc);
  }
  std::string stored(4, '\0');
  return read(chunk.offset + 8 + chunk.length, stored.data(), 4) && get_number(stored, 0, 4) == crc;
}

// The slit rig's mark (ods/stitch/rig_mark.h).
static bool is_rig_mark(const Chunk& chunk, const ByteReader& read) {
  constexpr std::string_view kKeyword{"ods:rig\0", 8};
  constexpr size_t kLongest = 1 << 16;
  std::string keyword(kKeyword.size(), '\0');
  if (chunk.type != "tEXt" || chunk.length < keyword.size() || chunk.length > kLongest) return false;
  return read(chunk.offset + 8, keyword.data(), keyword.size()) && keyword == kKeyword && is_whole(chunk, read);
}

std::optional<std::vector<FileRange>> essential_png(size_t file_size, const ByteReader& read) {
  const size_t kSignature = 8, kFrame = 12;
  std::vector<FileRange> parts{{0, kSignature}};
  bool has_pixels = false;
  for (size_t at = kSignature; at + kFrame <= file_size;) {
    std::string start(8, '\0');
    if (!read(at, start.data(), start.size())) return std::nullopt;
    const Chunk chunk{start.substr(4), at, get_number(start, 0, 4)};
    if (chunk.length > file_size - at - kFrame) return std::nullopt;
    if (at == kSignature) {
      std::string header(kHeaderBytes, '\0');
      if (chunk.type != "IHDR" || chunk.length != kHeaderBytes) return std::nullopt;
      if (!read(at + 8, header.data(), header.size()) || !has_sane_size(header)) return std::nullopt;
    }
    const std::string& type = chunk.type;
    has_pixels = has_pixels || type == "IDAT";
    const bool is_mark = is_rig_mark(chunk, read);
    if (is_mark || type == "IHDR" || type == "PLTE" || type == "tRNS" || type == "IDAT" || type == "IEND") {
      if (!is_mark && !is_whole(chunk, read)) return std::nullopt;
      if (parts.back().offset + parts.back().size != at) parts.push_back({at, 0});
      parts.back().size += chunk.length + kFrame;
    }
    at += chunk.length + kFrame;
    if (type == "IEND") return has_pixels ? std::optional(parts) : std::nullopt;
  }
  return std::nullopt;
}

FileParts::FileParts(ByteReader file, std::vector<FileRange> parts) : file_(std::move(file)), parts_(std::move(parts)) {
  for (const FileRange& part : parts_) {
    starts_.push_back(size_);
    size_ += part.size;
  }
}

size_t FileParts::read(size_t offset, void* to, size_t size) const {
  size_t done = 0;
  while (done < size && offset + done < size_) {
    const auto next = std::upper_bound(starts_.begin(), starts_.end(), offset + done);
    const size_t i = static_cast<size_t>(next - starts_.begin()) - 1;
    const size_t skip = offset + done - starts_[i], count = std::min(size - done, parts_[i].size - skip);
    if (!file_(parts_[i].offset + skip, static_cast<char*>(to) + done, count)) break;
    done += count;
  }
  return done;
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/codec/exr_rows.h"

#include <OpenEXR/openexr.h>
#include <fmt/format.h>
#include <libdeflate.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "ods/base/error.h"

namespace ods {

namespace {

// --- undoing ZIP's preprocessing ------------------------------------------------------------------------------------

// A SIMD register. Both g++ and clang support this attribute.
using Lanes = uint8_t __attribute__((vector_size(16)));

// Every byte is stored as its difference from the previous one, plus 128.
void add_up(uint8_t* bytes, size_t count) {
  const Lanes zero{}, offset = zero + uint8_t{128};
  Lanes before = offset;
  size_t i = 0;
  for (; i + sizeof(Lanes) <= count; i += sizeof(Lanes)) {
    Lanes sum;
    std::memcpy(&sum, bytes + i, sizeof sum);
    sum += offset;
    sum += __builtin_shufflevector(zero, sum, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30);
    sum += __builtin_shufflevector(zero, sum, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29);
    sum += __builtin_shufflevector(zero, sum, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27);
    sum += __builtin_shufflevector(zero, sum, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23);
    sum += before;
    std::memcpy(bytes + i, &sum, sizeof sum);
    before = zero + sum[15];
  }
  for (uint8_t last = before[0]; i < count; i++) bytes[i] = last = static_cast<uint8_t>(bytes[i] + last + 128);
}

// Lanes at even positions are stored before those at odd ones.
void interleave(const uint8_t* bytes, size_t count, uint8_t* to) {
  const uint8_t *even = bytes, *odd = bytes + (count + 1) / 2;
  for (size_t i = 0; i < count / 2; i++) to[2 * i] = even[i], to[2 * i + 1] = odd[i];
  if (count % 2 == 1) to[count - 1] = even[count / 2];
}

struct Inflater {
  libdeflate_decompressor* state = libdeflate_alloc_decompressor();
  std::vector<uint8_t> bytes;
  Inflater() = default;
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { libdeflate_free_decompressor(state); }
};

exr_result_t unpack_zip(exr_decode_pipeline_t* decode) {
  thread_local Inflater inflater;
  const size_t packed = decode->chunk.packed_size, size = decode->chunk.unpacked_size;
  uint8_t* to = static_cast<uint8_t*>(decode->unpacked_buffer);
  if (packed == size) {  // stored uncompressed, because it would have grown
    std::memcpy(to, decode->packed_buffer, size);
    return EXR_ERR_SUCCESS;
  }
  inflater.bytes.resize(size);
  if (!inflater.state || libdeflate_zlib_decompress(inflater.state, decode->packed_buffer, packed,
                                                    inflater.bytes.data(), size, nullptr) != LIBDEFLATE_SUCCESS) {
    return EXR_ERR_CORRUPT_CHUNK;
  }
  add_up(inflater.bytes.data(), size);
  interleave(inflater.bytes.data(), size, to);
  return EXR_ERR_SUCCESS;
}

// --- files ----------------------------------------------------------------------------------------------------------

void ignore_message(exr_const_context_t, exr_result_t, const char*) {}

constexpr int64_t kWidest = int64_t{1} << 20;
constexpr uint64_t kLargestChunk = uint64_t{1} << 28;  // bytes, unpacked

// Its buffers are reused for the next chunk: new ones for each chunk cost as much as decompression, in page faults.
struct Pipeline {
  exr_decode_pipeline_t decode{};  // all zeros, as EXR_DECODE_PIPELINE_INITIALIZER
  exr_const_context_t file;
  bool is_started = false;
  explicit Pipeline(exr_const_context_t of) : file(of) {}
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;
  ~Pipeline() { exr_decoding_destroy(file, &decode); }

  exr_result_t start(const exr_chunk_info_t& chunk) {
    if (is_started) return exr_decoding_update(file, 0, &chunk, &decode);
    is_started = true;
    return exr_decoding_initialize(file, 0, &chunk, &decode);
  }
};

}  // namespace

struct ExrRows::State {
  std::string path;
  exr_context_t file = nullptr;
  int width = 0;
  int top = 0;                  // the first row in the file's coordinates
  int chunk_rows = 1;           // rows compressed together
  std::vector<int> channels;    // for each channel in the file, the index of the wanted channel; negative if not wanted
  std::vector<size_t> offsets;  // byte offset of each wanted channel in a pixel, and the size of a pixel

  ~State() {
    if (file) exr_finish(&file);
  }
  bool find_channels(const std::vector<std::string>& wanted);
  void read_chunk(Pipeline& pipeline, int row, int begin, int end, size_t channels, std::byte* to) const;
};

bool ExrRows::State::find_channels(const std::vector<std::string>& wanted) {
  const exr_attr_chlist_t* list = nullptr;
  if (exr_get_channels(file, 0, &list) != EXR_ERR_SUCCESS) return false;
  std::vector<size_t> sizes(wanted.size());
  uint64_t bytes = 0;
  for (int i = 0; i < list->num_channels; i++) {
    const exr_attr_chlist_entry_t& entry = list->entries[i];
    if (entry.x_sampling != 1 || entry.y_sampling != 1) return false;
    const auto at = std::find(wanted.begin(), wanted.end(), entry.name.str);
    const size_t size = entry.pixel_type == EXR_PIXEL_HALF ? 2 : 4;
    channels.push_back(at == wanted.end() ? -1 : static_cast<int>(at - wanted.begin()));
    if (at != wanted.end()) sizes[static_cast<size_t>(channels.back())] = size;
    bytes += size;
  }
  offsets = {0};
  for (const size_t size : sizes) offsets.push_back(offsets.back() + size);
  const uint64_t row = bytes * static_cast<uint64_t>(width);
  const bool has_all = std::find(sizes.begin(), sizes.end(), size_t{0}) == sizes.end();
  return has_all && row * static_cast<uint64_t>(chunk_rows) < kLargestChunk;
}

std::unique_ptr<ExrRows> ExrRows::open(const std::string& path, const std::vector<std::string>& channels) {
  auto state = std::make_unique<State>();
  state->path = path;
  exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
  options.error_handler_fn = ignore_message;
  if (exr_start_read(&state->file, path.c_str(), &options) != EXR_ERR_SUCCESS) return nullptr;
  exr_storage_t storage;
  exr_compression_t packing;
  exr_attr_box2i_t window;
  int32_t chunk_rows = 0;
  const auto got = [](exr_result_t result) { return result == EXR_ERR_SUCCESS; };
  if (!got(exr_get_storage(state->file, 0, &storage)) || storage != EXR_STORAGE_SCANLINE ||
      !got(exr_get_compression(state->file, 0, &packing)) ||
      (packing != EXR_COMPRESSION_ZIP && packing != EXR_COMPRESSION_ZIPS) ||
      !got(exr_get_data_window(state->file, 0, &window)) ||
      !got(exr_get_scanlines_per_chunk(state->file, 0, &chunk_rows)) || chunk_rows < 1) {
    return nullptr;
  }
  const int64_t width = int64_t{window.max.x} - window.min.x + 1;
  if (width < 1 || width > kWidest) return nullptr;
  state->width = static_cast<int>(width);
  state->top = window.min.y;
  state->chunk_rows = chunk_rows;
  if (!state->find_channels(channels)) return nullptr;
  return std::unique_ptr<ExrRows>(new ExrRows(std::move(state)));
}

ExrRows::ExrRows(std::unique_ptr<State> state) : state_(std::move(state)) {}
ExrRows::~ExrRows() = default;

// Reads the chunk that starts at a row; if only a part of it is wanted, through a buffer.
void ExrRows::State::read_chunk(Pipeline& pipeline, int row, int begin, int end, size_t wanted, std::byte* to) const {
  const size_t stride = offsets[wanted], row_size = stride * static_cast<size_t>(width);
  const auto failed = [&] {
    throw Error(ErrorKind::kInput, fmt::format("cannot read '{}': its rows from {} on are damaged", path, row));
  };
  exr_chunk_info_t chunk;
  if (exr_read_scanline_chunk_info(file, 0, top + row, &chunk) != EXR_ERR_SUCCESS || chunk.start_y != top + row ||
      pipeline.start(chunk) != EXR_ERR_SUCCESS ||
      static_cast<size_t>(pipeline.decode.channel_count) != channels.size()) {
    failed();
  }
  const bool whole = begin <= row && row + chunk.height <= end;
  std::vector<std::byte> own(whole ? 0 : row_size * static_cast<size_t>(chunk.height));
  std::byte* first = whole ? to + static_cast<size_t>(row - begin) * row_size : own.data();
  for (size_t i = 0; i < channels.size(); i++) {
    exr_coding_channel_info_t& channel = pipeline.decode.channels[i];
    const int index = channels[i];
    channel.decode_to_ptr = nullptr;
    if (index < 0 || static_cast<size_t>(index) >= wanted) continue;
    channel.decode_to_ptr = reinterpret_cast<uint8_t*>(first + offsets[static_cast<size_t>(index)]);
    channel.user_pixel_stride = static_cast<int32_t>(stride);
    channel.user_line_stride = static_cast<int32_t>(row_size);
    channel.user_bytes_per_element = channel.bytes_per_element;
    channel.user_data_type = channel.data_type;
  }
  if (exr_decoding_choose_default_routines(file, 0, &pipeline.decode) != EXR_ERR_SUCCESS) failed();
  pipeline.decode.decompress_fn = unpack_zip;
  if (exr_decoding_run(file, 0, &pipeline.decode) != EXR_ERR_SUCCESS) failed();
  if (whole) return;
  const int from = std::max(begin, row), until = std::min(end, row + chunk.height);
  std::memcpy(to + static_cast<size_t>(from - begin) * row_size, first + static_cast<size_t>(from - row) * row_size,
              static_cast<size_t>(until - from) * row_size);
}

void ExrRows::read(int begin, int end, size_t channels, std::byte* to) const {
  const int rows = state_->chunk_rows;
  tbb::enumerable_thread_specific<Pipeline> pipelines([&] { return Pipeline(state_->file); });
  tbb::parallel_for(begin / rows, (end + rows - 1) / rows,
                    [&](int chunk) { state_->read_chunk(pipelines.local(), chunk * rows, begin, end, channels, to); });
}

}  // namespace ods

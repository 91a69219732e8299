// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cassert>
#include <vector>

#include "ods/base/text.h"
#include "ods/image/codec/encoder.h"
#include "ods/image/image_file.h"

namespace ods {

Error cannot_write(const ByteSink& sink, const std::string& why) {
  return Error(ErrorKind::kOutput, fmt::format("cannot write '{}': {}", sink.path(), library_message(why)));
}

size_t bytes_of_pixel(const FileHeader& header) {
  size_t bytes = 0;
  for (const Channel& channel : header.channels) bytes += bytes_of(channel.sample);
  return bytes;
}

static std::unique_ptr<Encoder> create_encoder(ByteSink& sink, const FileHeader& header) {
  switch (header.format) {
    case FileFormat::kPng:
      return create_png(sink, header);
    case FileFormat::kJpeg:
      return create_jpeg(sink, header);
    case FileFormat::kTiff:
      return create_tiff(sink, header);
    case FileFormat::kWebp:
      return create_webp(sink, header);
    case FileFormat::kHdr:
      return create_hdr(sink, header);
    case FileFormat::kHeif:
      return create_heif(sink, header);
    case FileFormat::kExr:
      break;
  }
  return create_exr(sink, header);
}

// Writes rows in bands: large enough for OpenEXR to compress on all cores, small enough that no second picture is in
// memory. Computes the next band meanwhile, as most formats compress on one core.
void write_image(ByteSink& sink, const FileHeader& header, const RowSource& rows,
                 const std::function<void()>& band_done) {
  assert(header.width > 0 && header.height > 0 && !header.channels.empty());
  const int kBand = 64;
  std::vector<SampleType> samples;
  for (const Channel& channel : header.channels) samples.push_back(channel.sample);
  const size_t width = static_cast<size_t>(header.width), row_size = width * bytes_of_pixel(header);
  std::vector<std::byte> made(row_size * static_cast<size_t>(std::min(kBand, header.height))), written(made.size());
  const auto make = [&](int begin) {
    tbb::parallel_for(begin, std::min(begin + kBand, header.height), [&](int y) {
      std::vector<float> row(width * samples.size());
      rows(y, row);
      pack_floats(samples, row, &made[static_cast<size_t>(y - begin) * row_size]);
    });
    if (band_done) band_done();
  };
  const std::unique_ptr<Encoder> encoder = create_encoder(sink, header);
  make(0);
  for (int begin = 0; begin < header.height; begin += kBand) {
    const int end = std::min(begin + kBand, header.height);
    std::swap(made, written);
    tbb::task_group next;
    if (end < header.height) next.run([&] { make(end); });
    try {
      encoder->write(begin, end, written.data());
    } catch (...) {
      next.cancel();
      next.wait();
      throw;
    }
    next.wait();
  }
  encoder->finish();
}

std::string image_bytes(const std::string& name, const FileHeader& header, const RowSource& rows) {
  MemorySink memory(name);
  write_image(memory, header, rows);
  return memory.take();
}

}  // namespace ods

// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cassert>
#include <vector>

#include "ods/base/text.h"
#include "ods/files/file_input.h"
#include "ods/image/codec/encoder.h"
#include "ods/image/image_file.h"

namespace ods {

Error cannot_write(const AtomicFile& file, const std::string& why) {
  return Error(ErrorKind::kOutput, fmt::format("cannot write '{}': {}", file.path(), library_words(why)));
}

size_t bytes_of_pixel(const FileHeader& header) {
  size_t bytes = 0;
  for (const Channel& channel : header.channels) bytes += bytes_of(channel.sample);
  return bytes;
}

static std::unique_ptr<Encoder> create_encoder(AtomicFile& file, const FileHeader& header) {
  switch (header.format) {
    case FileFormat::kPng:
      return create_png(file, header);
    case FileFormat::kJpeg:
      return create_jpeg(file, header);
    case FileFormat::kTiff:
      return create_tiff(file, header);
    case FileFormat::kWebp:
      return create_webp(file, header);
    case FileFormat::kHdr:
      return create_hdr(file, header);
    case FileFormat::kHeif:
      throw cannot_write(file, "HEIF is only read");
    case FileFormat::kExr:
      break;
  }
  return create_exr(file, header);
}

// Writes rows in bands: large enough for OpenEXR to compress on all cores, small enough that no second picture is in
// memory. Computes the next band meanwhile, because most formats compress on one core.
void write_image(AtomicFile& file, const FileHeader& header, const RowSource& rows,
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
  const std::unique_ptr<Encoder> encoder = create_encoder(file, header);
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

std::string image_bytes(const std::string& path, const FileHeader& header, const RowSource& rows) {
  AtomicFile file(path);
  write_image(file, header, rows);
  file.finish();
  const FileInput bytes(file.temporary());
  return bytes.read(0, bytes.size());
}

}  // namespace ods

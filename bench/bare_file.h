// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The baseline of benchmarks from file to file: only reading and writing the same files.
#pragma once
#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"

struct BareFile {
  ods::FileInfo info;
  std::vector<std::byte> pixels;
};

inline size_t bytes_of_pixel(const ods::FileInfo& info) {
  size_t bytes = 0;
  for (const ods::SampleType sample : info.samples) bytes += ods::bytes_of(sample);
  return bytes;
}

inline BareFile read_bare(const std::string& path) {
  const std::unique_ptr<ods::RowReader> rows = ods::open_rows(path);
  BareFile file{rows->info(), {}};
  const size_t row = bytes_of_pixel(file.info) * static_cast<size_t>(file.info.width);
  file.pixels.resize(row * static_cast<size_t>(file.info.height));
  for (int begin = 0; begin < file.info.height; begin += rows->band_rows()) {
    const int end = std::min(begin + rows->band_rows(), file.info.height);
    rows->read(begin, end, file.info.channels.size(), &file.pixels[row * static_cast<size_t>(begin)]);
  }
  return file;
}

inline void write_bare(const std::string& path, const BareFile& file) {
  ods::AtomicFile to(path);
  ods::FileHeader header;
  header.format = *ods::format_of_path(path);
  header.width = file.info.width, header.height = file.info.height;
  const size_t channels = file.info.channels.size();
  for (size_t c = 0; c < channels; c++) header.channels.push_back({file.info.channels[c], file.info.samples[c]});
  ods::write_image(to, header, [&](int y, std::span<float> row) {
    const std::byte* from = &file.pixels[bytes_of_pixel(file.info) * static_cast<size_t>(y * file.info.width)];
    for (size_t i = 0; i < row.size(); i++) {
      const ods::SampleType sample = file.info.samples[i % channels];
      row[i] = ods::sample_value(sample, from);
      from += ods::bytes_of(sample);
    }
  });
  to.commit();
}
